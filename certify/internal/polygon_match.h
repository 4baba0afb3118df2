// Finds polygons of a file among those of a surface, as cycles of places.
#pragma once

#include <vector>

#include "majorant/certify/internal/cell_pool.h"
#include "majorant/certify/internal/repaired_faces.h"

namespace majorant {

// Takes the polygons of the file (ShownCells::polygon) that are polygons of the surface, and
// returns flags of these. The chain of its sides identifies a polygon: n - 2 cells over its corners
// whose edges sum to the chain are a triangulation of it.
std::vector<char> take_polygons(const ShownCells& cells, const RepairedFaces& faces,
                                CellPool& pool);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
