#include "majorant/io/internal/cones_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace majorant {

std::map<Index, int> cones_of(const MapFile& map) {
  std::map<Index, int> cones;
  for (Index p = 0; p < std::min(map.cone.size(), map.input_vertex.size()); ++p)
    if (map.cone[p] != 0 && map.input_vertex[p] >= 0) cones[map.input_vertex[p]] = map.cone[p];
  return cones;
}

std::string cone_comment(Index vertex, int quarter_turns) {
  return fmt::format("cone vertex {} quarter_turns {}", vertex, quarter_turns);
}

bool is_cone_comment(std::string_view text) {
  if (text == kConesComment) return true;
  const std::size_t first = text.find_first_of("0123456789"), last = text.rfind(' ') + 1;
  Index vertex = 0;
  int turns = 0;
  if (first == std::string_view::npos) return false;
  std::from_chars(text.data() + first, text.data() + text.size(), vertex);
  std::from_chars(text.data() + last, text.data() + text.size(), turns);
  return text == cone_comment(vertex, turns);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
