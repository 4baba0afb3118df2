// What one rank fails at, all fail at together, so that nobody goes on alone: files of a map in
// parts, which are to appear all or none.
//
//     std::exception_ptr failure;
//     try { ... } catch (...) { failure = std::current_exception(); }
//     rethrow_collectively(ranks, failure);   // goes on, or throws, everywhere
#pragma once

#include <exception>

#include "majorant/framework/partition.h"

namespace majorant {

// Another rank has something to say, this one does not.
struct FailedElsewhere : std::exception {
  const char* what() const noexcept override { return "another rank has failed"; }
};

// Collective. The lowest rank that has failed throws what it has, the others FailedElsewhere.
void rethrow_collectively(const Ranks& ranks, const std::exception_ptr& failure);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
