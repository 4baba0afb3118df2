// Comments about a map, for formats that have no other place: the cones of a map with seams, and
// missing charts of a layout.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "majorant/maps/map_file.h"

namespace majorant {

// Returns quarter turns by vertex of the input, from 0, for vertices that the file knows.
std::map<Index, int> cones_of(const MapFile& map);

// The comment above the cones, and the comment of a cone.
inline constexpr std::string_view kConesComment =
    "cones: vertices count from 0; angle = quarter_turns * 90 degrees";
std::string cone_comment(Index vertex, int quarter_turns);
// Returns whether a text is one of these comments.
bool is_cone_comment(std::string_view text);

// The comment of a layout that lacks charts because the run was stopped.
inline constexpr std::string_view kPartialLayoutComment =
    "partial layout: faces without texture coordinates are not mapped yet";

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
