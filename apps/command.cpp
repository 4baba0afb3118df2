#include "apps/command.h"

#include <fmt/format.h>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/parts.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/results/solver_ladder.h"

namespace majorant::app {

ExitCode exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::Usage:
      return kUsage;
    case ErrorKind::Unreadable:
      return kUnreadable;
    case ErrorKind::Unsupported:
    case ErrorKind::Infeasible:
      return kUnsupported;
    case ErrorKind::Invalid:
      return kInvalid;
  }
  return kInternal;
}

ExitCode exit_code(Status status) {
  switch (status) {
    case Status::Converged:
      return kSuccess;
    case Status::MaxIterations:
    case Status::TimeLimit:
    case Status::Interrupted:
    case Status::Stalled:
      return kLimit;
    case Status::Infeasible:
      return kUnsupported;
    case Status::Failed:
      return kInvalid;
  }
  return kInternal;
}

std::string version_line() {
  return fmt::format("majorant {} ({}{})", MAJORANT_VERSION, vector_instructions(),
                     has_gpl_parts() ? "" : ", without GPL parts");
}

void CommonOptions::add_to(CLI::App& verb) {
  begin_group(verb, OptionGroup::General);
  verb.get_help_ptr()->group(verb.option_defaults()->get_group());
  verb.set_version_flag("-V,--version", version_line(), "print the version");
  verb.add_option("--threads", threads,
                  "threads (default: all cores that the process may use; majorant-mpi: 1)")
      ->check(whole_number(1, 1024));
  auto* q = verb.add_flag("-q,--quiet", quiet, "no progress");
  verb.add_flag("-v,--verbose", verbose, "a line per iteration")->excludes(q);
  verb.add_option("--report", report, "write a JSON report to FILE, - for stdout")
      ->type_name("FILE");
  verb.add_flag("--force", force, "an output may replace a file that is read");
  verb.add_flag("--strict", strict,
                "refuse a mesh file of which something would be left out or repaired");
}

void CommonOptions::add_petsc_to(CLI::App& verb) {
  begin_group(verb, OptionGroup::Solver);
  verb.add_option("--petsc-options", petsc_options,
                  "words for PETSc, where a run uses it: \"-ksp_monitor -info\"; it obeys no "
                  "options file and no variable")
      ->type_name("TEXT")
      ->check(CLI::Validator(
          [](const std::string& text) {
            try {
              petsc_words(text);
            } catch (const Error& e) {
              return std::string(e.what());
            }
            return std::string();
          },
          ""));
}

Strictness CommonOptions::strictness(Strictness least) const {
  return strict ? Strictness::Everything : least;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
