// Compares a patch of a surface with the cells inside the same edges.
//
// n - 2 triangles over the n corners of one polygon are a triangulation of it. Otherwise both must
// lie in one plane, have the same total area, and all triangles must turn the same way.
#pragma once

#include <span>
#include <string>

#include "majorant/certify/internal/surface_match.h"

namespace majorant {

struct CellPatch {
  std::span<const Index> faces;  // polygons of the surface
  std::span<const Index> cells;
};

// The surface, its cells, and the vertices of the surface that the cells have.
struct PatchContext {
  const ShownCells& cells;
  const PolygonMesh& surface;
  const std::vector<Index>& surface_vertex;  // see NamedVertices::of_cells
  double close;                              // see match_distance()
};

// Counts the faces of the patch and returns its fault, or an empty string.
std::string compare_patch(const PatchContext& context, const CellPatch& patch, SurfaceMatch& match);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
