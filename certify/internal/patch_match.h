// A patch of a surface, and the cells with the same edges around them.
//
// The corners of one polygon with n - 2 triangles over them are a triangulation of it; otherwise
// both must lie in one plane, all triangles turned the same way and with the same area in all.
#pragma once

#include <span>
#include <string>

#include "majorant/certify/internal/surface_match.h"

namespace majorant {

struct CellPatch {
  std::span<const Index> faces;  // polygons of the surface
  std::span<const Index> cells;
};

// The surface, its cells, and which vertices of it these have.
struct PatchContext {
  const ShownCells& cells;
  const PolygonMesh& surface;
  const std::vector<Index>& surface_vertex;  // NamedVertices::of_cells
  double close;                              // match_distance()
};

// Counts the faces of the patch; returns what is wrong with it, or nothing.
std::string compare_patch(const PatchContext& context, const CellPatch& patch, SurfaceMatch& match);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
