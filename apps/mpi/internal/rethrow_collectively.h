// Makes a failure of one rank a failure of all, so that no rank continues alone. Files of a
// distributed map then appear completely or not at all.
//
//     std::exception_ptr failure;
//     try { ... } catch (...) { failure = std::current_exception(); }
//     rethrow_collectively(ranks, failure);   // goes on, or throws, everywhere
#pragma once

#include <exception>

#include "majorant/framework/partition.h"

namespace majorant {

// Marks a failure that rank 0 reports.
struct ReportedByFirstRank : std::exception {
  const char* what() const noexcept override { return "rank 0 reports the failure"; }
};

// Collective. If ranks failed, rank 0 throws what the lowest of them threw: an Error of its kind
// and message, std::bad_alloc, or std::runtime_error with the message of any other exception. The
// other ranks throw ReportedByFirstRank.
void rethrow_collectively(const Ranks& ranks, const std::exception_ptr& failure);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
