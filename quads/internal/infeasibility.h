// Turns Error(Infeasible) into its message, for attempts that are followed by others.
//
//   const auto attempt = [] { throw Error(ErrorKind::Infeasible, "no quads"); };
//   if (const auto failure = infeasibility(attempt)) std::cerr << *failure << "\n";
#pragma once

#include <optional>
#include <string>

#include "majorant/framework/error.h"

namespace majorant {

// Returns the message of Error(Infeasible) that work() throws, or nothing if it succeeds. Other
// errors pass.
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
