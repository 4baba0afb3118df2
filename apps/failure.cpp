#include "apps/failure.h"

#include <array>
#include <new>
#include <utility>

#include "apps/or_interrupted.h"
#include "apps/refusal_message.h"
#include "majorant/framework/run_record.h"

namespace majorant::app {
namespace {

constexpr std::array<std::pair<std::string_view, ExitCode>, 14> kCodes{{
    {"converged", kSuccess},
    {"valid", kSuccess},
    {"done", kSuccess},
    {"max_iterations", kLimit},
    {"time_limit", kLimit},
    {"interrupted", kLimit},
    {"stalled", kLimit},
    {"infeasible", kUnsupported},
    {"unsupported", kUnsupported},
    {"unreadable", kUnreadable},
    {"usage", kUsage},
    {"invalid", kInvalid},
    {"undecided", kInvalid},
    {"failed", kInvalid},
}};

std::string status_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Usage:
      return "usage";
    case ErrorKind::Unreadable:
      return "unreadable";
    case ErrorKind::Unsupported:
      return "unsupported";
    case ErrorKind::Infeasible:
      return "infeasible";
    case ErrorKind::Invalid:
      return "failed";
  }
  return "internal_error";
}

}  // namespace

ExitCode exit_code(ErrorKind kind) { return exit_code(status_of(kind)); }

ExitCode exit_code(std::string_view status) {
  for (const auto& [name, code] : kCodes)
    if (name == status) return code;
  return kInternal;
}

Failure failure_of(const std::exception_ptr& exception) try {
  std::rethrow_exception(exception);
} catch (const Interrupted& e) {
  const std::string message = e.what();
  return {kInvalid, std::string(status_name(stopped_status(e.why()))), message,
          message + "; nothing is written"};
} catch (const Stopped& e) {
  const std::string message = e.what();
  return {kInvalid, std::string(status_name(stopped_status(e.why()))), message,
          message + "; nothing is written"};
} catch (const Error& e) {
  const std::string message = command_message(e);
  return {exit_code(e.kind()), status_of(e.kind()), message, message};
} catch (const std::bad_alloc&) {
  return {kUnsupported, "unsupported", "out of memory",
          "out of memory; use a lower degree or a smaller mesh, or raise the memory limit"};
} catch (const std::exception& e) {
  return {kInternal, "internal_error", e.what(),
          std::string("internal error: ") + e.what() + "; please report it with the input"};
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
