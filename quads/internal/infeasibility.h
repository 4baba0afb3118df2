// The message of Error(Infeasible), where a piece of work throws it: an attempt has failed, and
// another one follows.
//
//   const auto attempt = [] { throw Error(ErrorKind::Infeasible, "no quads"); };
//   if (const auto failure = infeasibility(attempt)) std::cerr << *failure << "\n";
#pragma once

#include <optional>
#include <string>

#include "majorant/framework/error.h"

namespace majorant {

// Returns nothing where work() throws nothing; rethrows all other errors.
template <class Work>
std::optional<std::string> infeasibility(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::Infeasible) throw;
    return error.what();
  }
  return std::nullopt;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
