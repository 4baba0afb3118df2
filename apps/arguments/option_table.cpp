#include "apps/arguments/option_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace majorant::app {
namespace {

// Adds an option to a verb, according to the type of its target.
struct Adder {
  CLI::App& verb;
  const OptionRow& row;

  CLI::Option* operator()(bool* target) const {
    // Without this, CLI11 reads --quiet=nan as a number and throws an exception of its own.
    return verb.add_flag(row.names, *target, row.help)->disable_flag_override();
  }
  CLI::Option* operator()(std::vector<std::string>* target) const {
    CLI::Option* const option = verb.add_option(row.names, *target, row.help);
    if (row.rules.comma_separated) return option->delimiter(',');
    return option->allow_extra_args(false);
  }
  CLI::Option* operator()(const std::function<void(const std::string&)>& target) const {
    if (row.rules.is_flag)
      return verb
          .add_flag_function(
              row.names, [target](std::int64_t) { target("true"); }, row.help)
          ->disable_flag_override();
    return verb.add_option_function<std::string>(row.names, target, row.help);
  }
  template <class T>
  CLI::Option* operator()(T* target) const {
    return verb.add_option(row.names, *target, row.help);
  }
};

}  // namespace

void add_options(CLI::App& verb, OptionGroup group, const std::vector<OptionRow>& rows) {
  begin_group(verb, group);
  for (const OptionRow& row : rows) {
    CLI::Option* const option = std::visit(Adder{verb, row}, row.target);
    const OptionRules& rules = row.rules;
    if (!rules.type.empty()) option->type_name(rules.type);
    if (!rules.default_word.empty()) option->default_str(rules.default_word)->expected(0, 1);
    if (rules.check) option->check(*rules.check);
    if (rules.required) option->required();
    for (const std::string& other : rules.needs) option->needs(verb.get_option(other));
    for (const std::string& other : rules.excludes) option->excludes(verb.get_option(other));
  }
}

CLI::Validator checked_by(std::function<std::string(const std::string&)> fault) {
  return CLI::Validator([fault = std::move(fault)](std::string& word) { return fault(word); }, "");
}

std::optional<double> number_in(const std::string& word) {
  double number = 0;
  if (!CLI::detail::lexical_cast(word, number)) return std::nullopt;
  return number;
}

std::vector<double> numbers_in(const std::string& word) {
  if (word.ends_with(',')) return {};  // split() drops an empty last part
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(word, ',')) {
    const std::optional<double> number = number_in(part);
    if (!number || !std::isfinite(*number)) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<std::array<double, 3>> direction_in(const std::string& word) {
  const std::vector<double> n = numbers_in(word);
  if (n.size() != 3 || (n[0] == 0 && n[1] == 0 && n[2] == 0)) return std::nullopt;
  return std::array<double, 3>{n[0], n[1], n[2]};
}

std::optional<std::array<int, 2>> size_in(const std::string& word, int least, int most) {
  const std::vector<double> sides = numbers_in(word);
  const auto is_usable = [&](double side) {
    return least <= side && side <= most && side == std::floor(side);
  };
  if (sides.empty() || sides.size() > 2 || !std::all_of(sides.begin(), sides.end(), is_usable))
    return std::nullopt;
  return std::array<int, 2>{static_cast<int>(sides.front()), static_cast<int>(sides.back())};
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
