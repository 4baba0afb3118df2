// majorant: the command. One file for each verb; docs/interface.md has exit codes and file formats.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <cstring>
#include <exception>
#include <sstream>

#include "apps/arguments/command_line.h"
#include "apps/arguments/help_text.h"
#include "apps/arguments/standard_streams.h"
#include "apps/command.h"
#include "apps/failure.h"
#include "apps/parts.h"
#include "apps/process.h"
#include "apps/streams.h"

namespace majorant::app {

namespace {

const std::string kExamples =
    "Examples:\n"
    "  majorant scan.obj flat.obj                                  texture coordinates\n"
    "  majorant parametrize disk.obj -o disk.vtu -o disk.html --degree 3\n"
    "  majorant check disk.vtu --surface disk.obj                  proves the result again\n";

int run(int argc, char** argv) {
  CLI::App app{
      "majorant: low-distortion, injective, piecewise polynomial maps of surfaces onto the "
      "plane",
      "majorant"};
  const std::vector<std::string> given = {argv + 1, argv + argc};
  app.formatter(std::make_shared<HelpFormatter>(help_length(given)));
  begin_group(app, OptionGroup::General);
  app.set_help_flag("-h,--help", "print this help; VERB -h: the options used most");
  app.get_help_ptr()->group(app.option_defaults()->get_group());
  app.set_version_flag("-V,--version", version_line(), "print the version");
  app.add_flag_callback(
      "--licenses", [] { throw CLI::CallForVersion(licences(), 0); },
      "print the licences of what this program is made of");
  app.require_subcommand(1);
  app.footer(
      kExamples +
      "\n"
      "Exit codes: 0 valid, 1 usage or an output that cannot be written, 2 unreadable input,\n"
      "            3 unsupported input or too little memory, 4 stopped by a limit or a signal,\n"
      "            5 invalid result, 6 internal error.");
  Action action;
  add_parametrize(app, &action);
  add_unwrap(app, &action);
  add_seamless(app, &action);
  add_deform(app, &action);
  add_check(app, &action);
  add_compare(app, &action);
  add_convert(app, &action);
  add_bake(app, &action);
  add_quads(app, &action);
  add_info(app, &action);
  add_mesh(app, &action);
  if (argc == 1) {
    print_page(overview(
        app, kExamples + "\n`majorant VERB -h` lists the options used most, `majorant VERB --help` "
                         "all.\n"));
    return kSuccess;
  }
  std::vector<std::string> words = completed_words(app, with_standard_streams(given));
  std::reverse(words.begin(), words.end());  // the parser takes words in reverse order
  try {
    app.parse(words);
    require_values(app);
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) {  // help or version
      std::ostringstream text;
      app.exit(e, text, text);
      print_page(text.str());
      return kSuccess;
    }
    say("majorant: {}\n", usage_message(app, e));
    return kUsage;
  }
  return action();
}

int run_safely(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (...) {
    const Failure failure = failure_of(std::current_exception());
    say("majorant: {}\n", failure.line);
    return failure.code;
  }
}

}  // namespace
}  // namespace majorant::app

int main(int argc, char** argv) {
  using namespace majorant::app;
  prepare_process();
  const int code = run_safely(argc, argv);
  const int lost = data_error();
  if (lost == 0) return code;
  say("majorant: cannot write to standard output: {}\n", std::strerror(lost));
  return code == kSuccess || code == kLimit ? kUsage : code;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
