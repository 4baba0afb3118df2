// A surface, and the faces that repair() makes of its polygons.
#pragma once

#include <algorithm>
#include <vector>

#include "majorant/certify/internal/cell_pool.h"
#include "majorant/certify/internal/triangle_in_space.h"
#include "majorant/mesh/repair.h"

namespace majorant {

struct RepairedFaces {
  const PolygonMesh& surface;
  const RepairedSurface& repaired;
  std::vector<Index> first_at_place;  // by vertex of the surface: the first vertex that is joined
                                      // with it
  std::vector<std::vector<Index>> faces_of;  // by polygon

  // Returns the place of a corner of a polygon.
  Index place(Index polygon, Index corner) const {
    return first_at_place[surface.polygons[polygon][corner]];
  }
  // Returns the corners of its polygon that a face has.
  CellCorners corners(Index face) const {
    const auto row = repaired.polygon_corner.row(face);
    return {row[0], row[1], row[2]};
  }
  Index polygon_of(Index face) const { return repaired.mesh->input_face(face); }
  // Returns whether the corners of a face are in the order of its polygon, not reversed.
  bool is_ascending(Index face) const {
    const auto [a, b, c] = corners(face);
    return (a < b && b < c) || (b < c && c < a) || (c < a && a < b);
  }
  TriangleInSpace triangle(Index face, double close) const {
    const auto& polygon = surface.polygons[polygon_of(face)];
    const auto [a, b, c] = corners(face);
    return {{surface.positions[polygon[a]], surface.positions[polygon[b]],
             surface.positions[polygon[c]]},
            close};
  }
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
