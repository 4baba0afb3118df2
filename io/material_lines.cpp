#include "majorant/io/material_lines.h"

#include <algorithm>
#include <array>

#include "majorant/io/internal/text_cursor.h"

namespace majorant {
namespace {

constexpr std::string_view kSpaces = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

// Takes an option and its values from the beginning of `rest`: two values of -mm, one to three
// numbers of -o, -s and -t, one of others.
MaterialImage::Option take_option(std::string_view& rest) {
  constexpr std::size_t kMaxNumbers = 3;
  const auto take_word = [&] {
    const auto [word, after] = split_keyword(rest);
    rest = after;
    return word;
  };
  MaterialImage::Option option{take_word(), {}};
  option.values.push_back(take_word());
  if (option.name == "-mm") option.values.push_back(take_word());
  if (option.name != "-o" && option.name != "-s" && option.name != "-t") return option;
  while (option.values.size() < kMaxNumbers) {
    double ignored = 0;
    if (parse_number(split_keyword(rest).first, ignored) != NumberStatus::Good) break;
    option.values.push_back(take_word());
  }
  return option;
}

}  // namespace

std::pair<std::string_view, std::string_view> split_keyword(std::string_view line) {
  line = trimmed(line);
  const std::size_t end = std::min(line.find_first_of(kSpaces), line.size());
  return {line.substr(0, end), trimmed(line.substr(end))};
}

bool is_image_keyword(std::string_view word) {
  constexpr std::array<std::string_view, 5> kOthers{"bump", "norm", "disp", "decal", "refl"};
  return word.starts_with("map_") ||
         std::find(kOthers.begin(), kOthers.end(), word) != kOthers.end();
}

std::optional<MaterialImage> material_image(std::string_view line) {
  auto [keyword, rest] = split_keyword(line);
  if (!is_image_keyword(keyword)) return std::nullopt;
  MaterialImage image{keyword, {}, {}};
  while (rest.starts_with('-')) image.options.push_back(take_option(rest));
  image.name = rest;
  std::replace(image.name.begin(), image.name.end(), '\\', '/');
  return image;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
