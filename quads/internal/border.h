// The border and the feature lines of a surface, which hold vertices of quads: their corners, and
// points on them by arc length.
//
//   const std::vector<char> is_feature(3 * mesh->face_count(), 0);
//   const BorderLengths lengths(*mesh, is_feature);
//   const Index half_edge = 0;   // of the border
//   const Vector3 middle =
//       lengths.position(lengths.point_at(half_edge, lengths.loop_length(half_edge) / 2));
#pragma once

#include <map>
#include <vector>

#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/features.h"

namespace majorant {

// Returns the degrees between two directions.
double turn_between(const Vector3& in, const Vector3& out);

// Returns #V flags: 1 at vertices of the border where it turns by at least `border_turn` degrees.
std::vector<char> border_corners(const SurfaceMesh& mesh, double border_turn = kCornerTurn);
// Returns border_corners(), and 1 at corners of features.
std::vector<char> held_corners(const SurfaceMesh& mesh, const std::vector<char>& is_feature,
                               double border_turn = kCornerTurn);

// A point of the border or of a feature line, at a fraction of the length of a half-edge; -1 for
// other points.
struct BorderPoint {
  Index half_edge = -1;
  double along = 0;
};

// Arc lengths along the loops of a border and the lines of features. Half-edges of features are
// those of feature_lines().
class BorderLengths {
 public:
  // The surface must outlive this.
  explicit BorderLengths(const SurfaceMesh& mesh, const std::vector<char>& is_feature = {});

  // Returns the loop or line of a half-edge.
  Index loop_of(Index half_edge) const { return loop_of_[half_edge]; }
  double loop_length(Index half_edge) const;
  bool is_closed(Index half_edge) const { return is_closed_[loop_of_[half_edge]] != 0; }
  // Returns the length from the start of the loop, below the loop's length.
  double length_at(const BorderPoint& point) const;
  // Returns the point at any length on the loop of that half-edge; on a line, the length is limited
  // to its ends.
  BorderPoint point_at(Index half_edge, double length) const;
  // Returns the position in the file that the surface came from.
  Vector3 position(const BorderPoint& point) const;

 private:
  void add_loop(const std::vector<Index>& half_edges, bool is_closed);

  const SurfaceMesh& mesh_;
  std::vector<std::map<double, Index>> loops_;  // half-edges by the length at their start
  std::vector<double> loop_length_;
  std::vector<char> is_closed_;  // by loop
  std::vector<Index> loop_of_;   // by half-edge
  std::vector<double> begin_;    // by half-edge
};

// Returns 3 #F flags: 1 for half-edges of the border and of features.
std::vector<char> held_flags(const SurfaceMesh& mesh, const std::vector<char>& is_feature = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
