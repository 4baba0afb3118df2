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

// Marks a failure on another rank, which has the message.
struct FailedElsewhere : std::exception {
  const char* what() const noexcept override { return "another rank has failed"; }
};

// Collective. The lowest rank that failed rethrows its exception, the others throw FailedElsewhere.
void rethrow_collectively(const Ranks& ranks, const std::exception_ptr& failure);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
