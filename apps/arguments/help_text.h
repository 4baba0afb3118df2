// What `majorant --help` and `majorant VERB --help` print: options in groups, in two columns,
// wrapped to the width of the terminal.
//
//   CLI::App app;
//   app.formatter(std::make_shared<HelpFormatter>());
//   std::string size;
//   begin_group(verb, OptionGroup::Pictures);    // of the options that follow
//   verb.add_option("--size", size, "PNG: width and height in pixels")->type_name("W,H");
//
// An option without a name for its value gets one: its choices, or N or X for a number. Ranges of
// numbers stand behind the text.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Formatter.hpp>
#include <string>

namespace majorant::app {

// In the order of the help.
enum class OptionGroup { Files, Map, Constraints, Charts, Solver, Pictures, General };

// Begins a group of options: those that are added to the verb from now on.
void begin_group(CLI::App& verb, OptionGroup group);

// The value of an option as help names it: "FILE", "free|fixed", "N, from 1 to 8". Empty for flags.
std::string value_words(const CLI::Option& option);

// What the program is, its verbs, and what follows them: for a command line without words.
std::string overview(const CLI::App& app, const std::string& rest);

class HelpFormatter final : public CLI::FormatterBase {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
