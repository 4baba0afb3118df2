// Polygons of a file found among those of a surface, as cycles of places.
#pragma once

#include <vector>

#include "majorant/certify/internal/cell_pool.h"
#include "majorant/certify/internal/repaired_faces.h"

namespace majorant {

// Takes the polygons of the file (ShownCells::polygon) that are polygons of the surface, and
// returns flags of these. A polygon is known by the chain of its sides: n - 2 cells over its
// corners whose edges add up to it are a triangulation of it.
std::vector<char> take_polygons(const ShownCells& cells, const RepairedFaces& faces,
                                CellPool& pool);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
