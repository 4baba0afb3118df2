// Cells of a map that are turned over, as pictures show them: in one colour, over all others, and
// counted in their legends.
//
//   const std::vector<Index> over = turned_over_cells(read_map("by_others.obj"));
//   std::cout << turned_over_words(over.size());   // "17 triangles turned over"
#pragma once

#include <string>
#include <vector>

#include "majorant/maps/map_file.h"

namespace majorant {

// The cells at one of whose extreme_samples() det J is not positive, those without an area on the
// surface among them; rising. For eyes: what is proven is certify/map_proof.h.
std::vector<Index> turned_over_cells(const MapFile& map);

std::string turned_over_words(std::size_t count);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
