// Options of a verb as rows of a table: what a row is called, where its value goes, what it means.
//
//   double padding = 4;
//   bool no_pack = false;
//   const OptionRules excluding{.excludes = {"--padding"}};
//   add_options(verb, OptionGroup::Charts,
//               {{"--padding", &padding, "pixels between charts", {.check = positive_number()}},
//                {"--no-pack", &no_pack, "leave charts where they are", excluding}});
//
// A row whose value is a bool is a flag. A list may be given several times. A row with a function
// calls it with the word that was given; of a flag that is "true".
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
  std::string type = {};  // what stands for the value in the help: "FILE"; empty: by the check
  std::optional<CLI::Validator> check = {};
  std::string default_word = {};  // the value of the option without one; empty: it needs one
  bool required = false;
  bool comma_separated = false;         // of a list
  bool is_flag = false;                 // of a function
  std::vector<std::string> needs = {};  // other options, of rows before this one
  std::vector<std::string> excludes = {};
};

struct OptionRow {
  std::string names;  // "--padding", "-o,--output", or of a word without a flag "input"
  OptionTarget target;
  std::string help;
  OptionRules rules = {};
};

void add_options(CLI::App& verb, OptionGroup group, const std::vector<OptionRow>& rows);

// A check that says what is wrong with a word; empty: nothing.
CLI::Validator checked_by(std::function<std::string(const std::string&)> fault);

// Words that several options take. Each returns none for what it is not.
std::optional<double> number_in(const std::string& word);
// The finite numbers between commas; empty where a part is no number.
std::vector<double> numbers_in(const std::string& word);
// "X,Y,Z", finite, not 0,0,0.
std::optional<std::array<double, 3>> direction_in(const std::string& word);
// Whole pixels, "N" for both sides or "W,H", each from `least` to `most`.
std::optional<std::array<int, 2>> size_in(const std::string& word, int least, int most);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
