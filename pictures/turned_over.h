// Cells of a map that are turned over, as pictures show them: in one colour, over all others, and
// counted in their legends.
//
//   const std::vector<Index> over = turned_over_cells(read_map("by_others.obj"));
//   std::cout << turned_over_words(over.size());   // "17 triangles turned over"
//
// A cell without an area on the surface has no side there: it is turned over where it is negative
// in the plane, and counted by itself.
#pragma once

#include <string>
#include <vector>

#include "majorant/maps/map_file.h"

namespace majorant {

// The cells at one of whose extreme_samples() det J is not positive; of cells without an area on
// the surface, those that are negative in the plane. Rising. For eyes: what is proven is
// certify/map_proof.h.
std::vector<Index> turned_over_cells(const MapFile& map);
// The cells that have no area on the surface, 0 or too small for a distortion. Rising.
std::vector<Index> cells_without_area(const MapFile& map);

std::string turned_over_words(std::size_t count);
// "1 face has no area", "3 faces have no area".
std::string without_area_words(std::size_t count);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
