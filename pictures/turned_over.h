// Cells of a map that are turned over: pictures show them in one colour, over all others, and count
// them in legends.
//
//   const std::vector<Index> over = turned_over_cells(read_map("by_others.obj"));
//   std::cout << turned_over_words(over.size());   // "17 triangles turned over"
//
// A cell without area on the surface has no orientation there. It counts as turned over if it is
// negative in the plane, and is also counted separately.
#pragma once

#include <string>
#include <vector>

#include "majorant/maps/map_file.h"

namespace majorant {

// Returns the cells with det J <= 0 at one of their extreme_samples(), and cells without area on
// the surface that are negative in the plane. Ascending. For display only: certify/map_proof.h has
// the proof.
std::vector<Index> turned_over_cells(const MapFile& map);
// Returns the cells whose area on the surface is 0 or too small for a distortion. Ascending.
std::vector<Index> cells_without_area(const MapFile& map);

std::string turned_over_words(std::size_t count);
// Returns "1 face has no area", "3 faces have no area".
std::string without_area_words(std::size_t count);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
