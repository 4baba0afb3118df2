// The exit code, the status word of the report and the line of a run that ends without a result.
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

// The exit codes. docs/interface.md documents them; they do not change.
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
// Returns the exit code of a report's status: kSuccess for "converged", kInvalid for "invalid".
ExitCode exit_code(std::string_view status);

struct Failure {
  ExitCode code = kInternal;
  std::string status, message;
  std::string line;  // the message and a remedy
};
// Describes an exception that ends a run. The pointer must not be null.
Failure failure_of(const std::exception_ptr& exception);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
