#include "majorant/io/material_lines.h"

#include <algorithm>
#include <array>

#include "majorant/io/internal/line_cursor.h"

namespace majorant {
namespace {

constexpr std::string_view kSpaces = " \t\r";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) - begin + 1);
}

// The number of values of an option: two of -mm, one to three numbers of -o, -s and -t, one of
// others.
std::string_view behind_values(std::string_view option, std::string_view rest) {
  constexpr int kMostNumbers = 3;
  rest = split_keyword(rest).second;
  if (option == "-mm") return split_keyword(rest).second;
  if (option != "-o" && option != "-s" && option != "-t") return rest;
  for (int k = 1; k < kMostNumbers; ++k) {
    const auto [word, after] = split_keyword(rest);
    double ignored = 0;
    if (parse_number(word, ignored) != NumberStatus::Good) break;
    rest = after;
  }
  return rest;
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
  while (rest.starts_with('-')) {
    const auto [option, after] = split_keyword(rest);
    image.options.push_back(option);
    rest = behind_values(option, after);
  }
  image.name = rest;
  std::replace(image.name.begin(), image.name.end(), '\\', '/');
  return image;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
