// What comments say of a map, for formats that know it as comments only: the cones of one with
// seams, and that charts of a layout are missing.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "majorant/maps/map_file.h"

namespace majorant {

// Quarter turns by vertex of the input, from 0; of vertices that the file knows.
std::map<Index, int> cones_of(const MapFile& map);

// The comment above them, and that of one.
inline constexpr std::string_view kConesComment =
    "cones: vertices count from 0; angle = quarter_turns * 90 degrees";
std::string cone_comment(Index vertex, int quarter_turns);
// True where a text is one of these.
bool is_cone_comment(std::string_view text);

// The comment of a layout that lacks charts, since the run was stopped.
inline constexpr std::string_view kPartialLayoutComment =
    "partial layout: faces without texture coordinates are not mapped yet";

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
