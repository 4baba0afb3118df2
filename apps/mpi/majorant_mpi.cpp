// majorant-mpi: the command on several ranks, started by mpirun or srun.
//
//     mpirun -n 8 majorant-mpi parametrize big.ply -o big.pvtu --report run.json
//
// It is a binary of its own, so that `majorant` needs no MPI. Every rank reads the same words; rank
// 0 reads files and speaks. Exit codes are those of `majorant`; a rank that fails ends all.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "apps/arguments/command_line.h"
#include "apps/arguments/help_text.h"
#include "apps/command.h"
#include "apps/failure.h"
#include "apps/linear_solvers.h"
#include "apps/mpi/parts_job.h"
#include "apps/mpi/processes.h"
#include "apps/process.h"
#include "apps/streams.h"
#include "majorant/framework/error.h"

namespace majorant::app {
namespace {

using Ending = std::pair<int, std::string>;  // exit code and text

// Parses the words with CLI11. Returns an ending if nothing is left to do.
std::optional<Ending> parse(std::vector<std::string> words, PartsRequest& request) {
  CLI::App app{"majorant-mpi: maps of surfaces onto the plane, on several processes",
               "majorant-mpi"};
  app.formatter(std::make_shared<HelpFormatter>(HelpLength::Full));
  begin_group(app, OptionGroup::General);
  app.set_help_flag("-h,--help", "print this help");
  app.get_help_ptr()->group(app.option_defaults()->get_group());
  app.set_version_flag("-V,--version", version_line(), "print the version");
  app.require_subcommand(1);
  request.add_to(*app.add_subcommand(
      "parametrize", "map a disk onto the plane, injectively and with low distortion"));
  std::reverse(words.begin(), words.end());
  try {
    app.parse(words);
  } catch (const CLI::ParseError& e) {
    std::ostringstream text;
    if (e.get_exit_code() != 0) return Ending{kUsage, usage_message(app, e)};
    app.exit(e, text, text);
    return Ending{kSuccess, text.str()};
  }
  return {};
}

int run(int argc, char** argv) {
  PartsRequest request;
  std::optional<Ending> ending;
  std::optional<Processes> processes;
  try {
    ending = parse({argv + 1, argv + argc}, request);
    processes.emplace(ending ? std::vector<std::string>()
                             : petsc_words(request.common.petsc_options));
    request.map.choose_degree({});
    if (!ending) request.require_possible();
  } catch (const Error& e) {  // the same on all ranks
    if (is_first_process()) say("majorant-mpi: {}\n", e.what());
    return exit_code(e.kind());
  }
  const bool is_first = processes->ranks()->rank() == 0;
  if (ending) {
    if (is_first && ending->first == kSuccess) print_text(ending->second);
    if (is_first && ending->first != kSuccess) say("majorant-mpi: {}\n", ending->second);
    return ending->first;
  }
  const int code = run_parts(request, *processes);
  if (const auto unused = processes->unused_options();
      is_first && !request.common.quiet && !unused.empty())
    say("majorant-mpi: warning: --petsc-options: PETSc did not use {}\n", fmt::join(unused, ", "));
  return code;
}

}  // namespace
}  // namespace majorant::app

int main(int argc, char** argv) {
  majorant::app::prepare_process();
  return majorant::app::run(argc, argv);
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
