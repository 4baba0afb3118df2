// What the border and the features of a surface, its held edges, ask for before quads are made of
// it: room for the lines that leave them, and a vertex at their corners.
//
//   const RoomySurface roomy = with_room(*mesh, sharp_edges(*mesh, kCornerTurn));
//   const std::vector<char> is_corner = held_corners(roomy.mesh, roomy.is_feature);
//
// Vertices of `mesh` keep their numbers.
#pragma once

#include <map>
#include <vector>

#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/features.h"

namespace majorant {

struct RoomySurface {
  SurfaceMesh mesh;
  std::vector<char> is_feature;      // 3 #F, both sides; empty where there are none
  double border_turn = kCornerTurn;  // degrees, from which on a vertex of the border is a corner
};

// The same surface, where every other edge that joins two vertices of held ones has one more in its
// middle, and a face with three held edges one at its centroid: no face has two held edges, so that
// these may be straight in a map at every vertex. So do the edges of a vertex all of whose
// neighbours are on held edges, such as the middle of a fan: it alone could not hold the cones of
// what they surround. Faces with a rest triangle stay as they are.
// is_feature: as feature_lines() has it (features.h).
RoomySurface with_room(const SurfaceMesh& mesh, const std::vector<char>& is_feature = {});

// Returns the surface with every edge halved and every face cut into four; features, too.
RoomySurface halved(const RoomySurface& surface);

// Returns the surface with a smoother border: vertices that are no corners lie where the border
// turns little. Lengths of edges stay about as they are. Not for positions: quads lie on the border
// as it is.
RoomySurface with_smooth_border(const RoomySurface& surface);

// #V: 1 at vertices of the border where it turns by so many degrees or more.
std::vector<char> border_corners(const SurfaceMesh& mesh, double border_turn = kCornerTurn);
// And at those of features.
std::vector<char> held_corners(const SurfaceMesh& mesh, const std::vector<char>& is_feature,
                               double border_turn = kCornerTurn);

// A point of the border or of a feature line: this part of the way along one of its half-edges, -1
// for other points.
struct BorderPoint {
  Index half_edge = -1;
  double along = 0;
};

// The loops of a border, and the lines of features, by lengths along them. Half-edges of features
// are those of feature_lines().
class BorderLengths {
 public:
  // The surface outlives this.
  explicit BorderLengths(const SurfaceMesh& mesh, const std::vector<char>& is_feature = {});

  // Of the loop or line of a half-edge.
  Index loop_of(Index half_edge) const { return loop_of_[half_edge]; }
  double loop_length(Index half_edge) const;
  bool is_closed(Index half_edge) const { return is_closed_[loop_of_[half_edge]] != 0; }
  // From where its loop begins, below the loop's length.
  double length_at(const BorderPoint& point) const;
  // On the loop of that half-edge, at any length; on a line between its ends.
  BorderPoint point_at(Index half_edge, double length) const;
  // In the file that the surface came from.
  Vector3 position(const BorderPoint& point) const;

 private:
  void add_loop(const std::vector<Index>& half_edges, bool is_closed);

  const SurfaceMesh& mesh_;
  std::vector<std::map<double, Index>> loops_;  // half-edges by the lengths at which they begin
  std::vector<double> loop_length_;
  std::vector<char> is_closed_;  // by loop
  std::vector<Index> loop_of_;   // by half-edge
  std::vector<double> begin_;    // by half-edge
};

// 3 #F: 1 for half-edges of the border, and of features.
std::vector<char> held_flags(const SurfaceMesh& mesh, const std::vector<char>& is_feature = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
