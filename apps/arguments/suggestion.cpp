#include "apps/arguments/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <numeric>
#include <utility>

namespace majorant::app {
namespace {

constexpr std::size_t kShort = 3;  // letters; words up to this length may have one wrong letter,
                                   // longer words two

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

// Returns the number of letters to insert, delete or change. Case is ignored.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);  // distances from the first i letters of `a` to each
                                               // prefix of `b`
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t changed = diagonal + (lower(a[i]) != lower(b[j]));
      diagonal = row[j + 1];
      row[j + 1] = std::min({changed, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& names) {
  std::size_t least = word.size() <= kShort ? 2 : 3;  // smallest distance that is too far
  std::string found;
  for (const std::string& name : names) {
    const std::size_t distance = edit_distance(word, name);
    if (distance < least) std::tie(least, found) = std::pair(distance, name);
  }
  if (least <= 1 || word.empty()) return found;
  const auto longer = std::find_if(names.begin(), names.end(),
                                   [&](const std::string& name) { return name.starts_with(word); });
  return longer == names.end() ? found : *longer;
}

std::string did_you_mean(const std::string& word, const std::vector<std::string>& names) {
  const std::string name = nearest(word, names);
  return name.empty() ? name : fmt::format(" (did you mean '{}'?)", name);
}

CLI::Validator word_or_file(std::vector<std::string> words) {
  return CLI::Validator(
      [words = std::move(words)](std::string& word) {
        std::error_code ignored;
        const bool is_one = std::find(words.begin(), words.end(), word) != words.end();
        const std::string hint = did_you_mean(word, words);
        if (is_one || hint.empty() || std::filesystem::exists(word, ignored)) return std::string();
        return fmt::format("there is no file '{}'{}", word, hint);
      },
      "");
}

CLI::Validator one_of(std::vector<std::string> choices) {
  const std::string list = fmt::format("{{{}}}", fmt::join(choices, ","));
  return CLI::Validator(
      [choices = std::move(choices), list](std::string& word) {
        if (std::find(choices.begin(), choices.end(), word) != choices.end()) return std::string();
        return fmt::format("'{}' is not in {}{}", word, list, did_you_mean(word, choices));
      },
      list);
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
