#include "apps/arguments/number_check.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace majorant::app {
namespace {

template <class Holds>
CLI::Validator number_check(const char* type, double most, const Holds& holds) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double number = 0;
        if (!CLI::detail::lexical_cast(text, number) || !std::isfinite(number) || !holds(number))
          return fmt::format("'{}' is not a {} number", text, type);
        return number <= most ? std::string() : fmt::format("'{}' is more than {:g}", text, most);
      },
      type);
}

}  // namespace

CLI::Validator positive_number(double most) {
  return number_check("positive", most, [](double number) { return number > 0; });
}

CLI::Validator non_negative_number(double most) {
  return number_check("non-negative", most, [](double number) { return number >= 0; });
}

CLI::Validator whole_number(int least, int most) {
  const std::string range = most == std::numeric_limits<int>::max()
                                ? fmt::format("from {} on", least)
                                : fmt::format("from {} to {}", least, most);
  return CLI::Validator(
      [=](std::string& text) {
        int number = 0;
        const bool is_good = CLI::detail::lexical_cast(text, number) && least <= number &&
                             number <= most &&
                             text.find_first_not_of("+-0123456789") == std::string::npos;
        return is_good ? std::string() : fmt::format("'{}' is not a whole number {}", text, range);
      },
      range);
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
