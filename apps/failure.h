// The end of a run that has no result: the exit code, the word of the report's status, and the
// line.
//
//   try {
//     ...
//   } catch (...) {
//     const Failure failure = failure_of(std::current_exception());
//     say("majorant: {}\n", failure.line);
//     return failure.code;
//   }
#pragma once

#include <exception>
#include <string>
#include <string_view>

#include "majorant/framework/error.h"

namespace majorant::app {

// Documented in docs/interface.md; fixed.
enum ExitCode {
  kSuccess = 0,
  kUsage = 1,
  kUnreadable = 2,
  kUnsupported = 3,
  kLimit = 4,
  kInvalid = 5,
  kInternal = 6,
};
ExitCode exit_code(ErrorKind kind);
// The code of a report's status: "converged" is kSuccess, "invalid" is kInvalid.
ExitCode exit_code(std::string_view status);

struct Failure {
  ExitCode code = kInternal;
  std::string status, message;
  std::string line;  // the message, and what to do
};
// Describes an exception that ends a run; not nullptr.
Failure failure_of(const std::exception_ptr& exception);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
