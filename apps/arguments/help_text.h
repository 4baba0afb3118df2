// The help of the command: `majorant VERB -h` lists the options used most, `majorant VERB --help`
// all options in groups. Both have two columns and are wrapped to the width of the terminal.
//
//   CLI::App app;
//   app.formatter(std::make_shared<HelpFormatter>(HelpLength::Full));
//   std::string size;
//   begin_group(verb, OptionGroup::Pictures);    // of the options that follow
//   verb.add_option("--size", size, "PNG: width and height in pixels")->type_name("W,H");
//
// An option whose value has no name gets one: its choices, or N or X for a number. A range of
// numbers follows the description.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <vector>

namespace majorant::app {

// The groups of options, in the order of the help.
enum class OptionGroup { Files, Map, Constraints, Charts, Solver, Pictures, General };

// Puts all options that are added to the verb from now on into this group.
void begin_group(CLI::App& verb, OptionGroup group);

// Returns the value of an option as the help names it: "FILE", "free|fixed", "N, from 1 to 8".
// Empty for flags.
std::string value_words(const CLI::Option& option);

// Returns a page for a command line without words: the description of the program, its verbs, and
// `rest`.
std::string overview(const CLI::App& app, const std::string& rest);

// Short: the options used most, for verbs with many options. Full: all options.
enum class HelpLength { Short, Full };

// Returns Short for command lines with -h and without --help.
HelpLength help_length(const std::vector<std::string>& words);

class HelpFormatter final : public CLI::FormatterBase {
 public:
  explicit HelpFormatter(HelpLength length) : length_(length) {}
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override;

 private:
  HelpLength length_;
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
