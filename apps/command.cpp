#include "apps/command.h"

#include <fmt/format.h>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/arguments/option_table.h"
#include "apps/parts.h"
#include "majorant/apps/jobs/petsc_fallback.h"
#include "majorant/framework/linear_solver.h"

namespace majorant::app {

std::string version_line() {
  return fmt::format("majorant {} ({}{})", MAJORANT_VERSION, vector_instructions(),
                     has_gpl_parts() ? "" : ", without GPL parts");
}

void CommonOptions::add_to(CLI::App& verb) {
  begin_group(verb, OptionGroup::General);
  verb.get_help_ptr()->group(verb.option_defaults()->get_group());
  verb.set_version_flag("-V,--version", version_line(), "print the version");
  add_options(
      verb, OptionGroup::General,
      {{"--threads",
        &threads,
        "number of threads (default: all cores that the process may use; majorant-mpi: 1)",
        {.check = whole_number(1, 1024)}},
       {"-q,--quiet", &quiet, "print no progress"},
       {"-v,--verbose", &verbose, "print a line per iteration", {.excludes = {"--quiet"}}},
       {"--report", &report, "write a JSON report to FILE, or to stdout for -", {.type = "FILE"}},
       {"--format",
        &format,
        "format of standard input and output, where a file is -: obj; or obj,glb for input and "
        "output",
        {.type = "EXT"}},
       {"--force", &force,
        "let an output replace a file that is read, or a mesh that majorant did not write"},
       {"--strict", &strict,
        "refuse a mesh file if something in it would be left out or repaired"}});
}

void CommonOptions::add_petsc_to(CLI::App& verb) {
  const auto fault = [](const std::string& text) {
    try {
      petsc_words(text);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  add_options(verb, OptionGroup::Solver,
              {{"--petsc-options",
                &petsc_options,
                "options for PETSc, where a run uses it: \"-ksp_monitor -info\"; option files and "
                "variables are ignored",
                {.type = "TEXT", .check = checked_by(fault)}}});
}

Strictness CommonOptions::strictness(Strictness least) const {
  return strict ? Strictness::Everything : least;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
