// Options of a verb as rows of a table: names, target of the value, help text.
//
//   double padding = 4;
//   bool no_pack = false;
//   const OptionRules excluding{.excludes = {"--padding"}};
//   add_options(verb, OptionGroup::Charts,
//               {{"--padding", &padding, "pixels between charts", {.check = positive_number()}},
//                {"--no-pack", &no_pack, "leave charts where they are", excluding}});
//
// A row with a bool target is a flag. A list may be given several times. A function target is
// called with the given word, or with "true" for a flag.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/arguments/help_text.h"

namespace majorant::app {

using OptionTarget =
    std::variant<bool*, int*, double*, std::string*, std::optional<int>*, std::optional<long>*,
                 std::optional<double>*, std::vector<std::string>*,
                 std::function<void(const std::string&)>>;

struct OptionRules {
  std::string type = {};  // placeholder of the value in the help: "FILE"; empty: from the check
  std::optional<CLI::Validator> check = {};
  std::string default_word = {};  // value used if the option is given without one; empty: a value
                                  // is required
  bool required = false;
  bool comma_separated = false;         // for lists
  bool is_flag = false;                 // for function targets
  std::vector<std::string> needs = {};  // names of options in earlier rows
  std::vector<std::string> excludes = {};
};

struct OptionRow {
  std::string names;  // "--padding", "-o,--output", or "input" for a positional word
  OptionTarget target;
  std::string help;
  OptionRules rules = {};
};

void add_options(CLI::App& verb, OptionGroup group, const std::vector<OptionRow>& rows);

// Returns a check from a function that returns what is wrong with a word, or an empty string.
CLI::Validator checked_by(std::function<std::string(const std::string&)> fault);

// Parsers of values that several options share. They return nothing for malformed words.
std::optional<double> number_in(const std::string& word);
// Returns the finite numbers between commas; empty if a part is not a number.
std::vector<double> numbers_in(const std::string& word);
// Parses "X,Y,Z": finite, not all zero.
std::optional<std::array<double, 3>> direction_in(const std::string& word);
// Parses whole numbers of pixels from `least` to `most`: "N" for both sides, or "W,H".
std::optional<std::array<int, 2>> size_in(const std::string& word, int least, int most);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
