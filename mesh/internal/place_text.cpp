#include "majorant/mesh/internal/place_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace majorant {

std::string place_text(std::string_view of_what, Index count,
                       const std::vector<std::array<Index, 2>>& places) {
  if (places.empty()) return {};
  constexpr std::size_t kShown = 5;
  const std::size_t shown = std::min(kShown, places.size());
  std::string text = fmt::format(" ({}", of_what);
  for (std::size_t k = 0; k < shown; ++k) {
    const auto& [a, b] = places[k];
    text += b < 0 ? fmt::format(" {}", a + 1) : fmt::format(" ({}, {})", a + 1, b + 1);
    if (k + 1 < shown) text += ",";
  }
  return text + (to_size(count) > shown ? ", ...)" : ")");
}

std::string described(const FindingText& text, Index count,
                      const std::vector<std::array<Index, 2>>& places) {
  return fmt::format("{} {}", count, count == 1 ? text.one : text.many) +
         place_text(text.place, count, places);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
