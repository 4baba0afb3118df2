// What the border of a surface asks for before quads are made of it: room for the lines that leave
// it, and a vertex at its corners.
//
//   const SurfaceMesh roomy = with_room_at_border(*mesh);
//   const std::vector<char> is_corner = border_corners(roomy);
//
// Vertices of `mesh` keep their numbers.
#pragma once

#include <map>
#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The same surface, where every edge inside that joins two vertices of the border has one more in
// its middle, and a face that is all border one at its centroid: no face has two border edges, so
// that a border may be straight in a map at every vertex. Faces with a rest triangle stay as they
// are.
SurfaceMesh with_room_at_border(const SurfaceMesh& mesh);

// #V: 1 at vertices of the border where it turns by kCornerTurn or more (check_quads.h).
std::vector<char> border_corners(const SurfaceMesh& mesh);

// A point of the border: this part of the way along one of its half-edges, -1 for other points.
struct BorderPoint {
  Index half_edge = -1;
  double along = 0;
};

// The loops of a border by lengths along them.
class BorderLengths {
 public:
  // The surface outlives this.
  explicit BorderLengths(const SurfaceMesh& mesh);

  // Of the loop of a half-edge.
  double loop_length(Index half_edge) const;
  // From where its loop begins, below the loop's length.
  double length_at(const BorderPoint& point) const;
  // On the loop of that half-edge, at any length.
  BorderPoint point_at(Index half_edge, double length) const;
  // In the file that the surface came from.
  Vector3 position(const BorderPoint& point) const;

 private:
  const SurfaceMesh& mesh_;
  std::vector<std::map<double, Index>> loops_;  // half-edges by the lengths at which they begin
  std::vector<double> loop_length_;
  std::vector<Index> loop_of_;  // by half-edge
  std::vector<double> begin_;   // by half-edge
};

// 3 #F: 1 for half-edges of the border.
std::vector<char> border_flags(const SurfaceMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
