// Feature lines of a surface: the edges along which it is sharp, or others that are given, as lines
// from corner to corner, which edges of quads cover.
//
//   const std::vector<char> is_feature = sharp_edges(*mesh, kCornerTurn);
//   const FeatureLines features = feature_lines(*mesh, is_feature);
//   std::cout << features.lines.size() << " lines\n";
//
// Not for the creases that cuts of an atlas follow: choose_cuts.h weighs those.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// A turn of a border or of a feature, in degrees, from which on its vertex is a corner, where quads
// have one; and the angle between the normals of two faces from which on their edge is sharp.
// Chosen.
inline constexpr double kCornerTurn = 35;

// 3 #F flags, both sides of every edge inside the surface, and of no polygon of its file, whose
// faces' normals differ by so many degrees or more.
std::vector<char> sharp_edges(const SurfaceMesh& mesh, double degrees);

struct FeatureLine {
  std::vector<Index> half_edges;  // each starts where the one before it ends
  double length = 0;              // model units
  bool is_closed = false;         // it ends where it starts
};

struct FeatureLines {
  std::vector<FeatureLine> lines;
  // #V: 1 at their ends, where more than two edges meet, on the border of the surface, and where a
  // line turns by kCornerTurn or more.
  std::vector<char> is_corner;
};

// is_feature: 3 #F flags of edges inside the surface, both sides, or empty: no lines. A line is cut
// at all corners; one without a corner starts at its smallest vertex.
FeatureLines feature_lines(const SurfaceMesh& mesh, const std::vector<char>& is_feature);

// Lines that are short for quads. Dropped: all of them. SharpKept: but those between corners of
// other lines, or on the border, whose faces' normals differ by kSharpTurn or more all along, down
// to half an edge: the sides of steps and teeth of plain solids.
enum class ShortLines { Dropped, SharpKept };
inline constexpr double kSharpTurn = 60;  // degrees; chosen: scans have few such edges

// is_feature without the lines that edges of so many model units cannot follow: those shorter than
// two of them, and those shorter than four with an end where no other line and no border is. What
// is left is judged anew.
std::vector<char> without_short_lines(const SurfaceMesh& mesh, std::vector<char> is_feature,
                                      double edge_length,
                                      ShortLines short_lines = ShortLines::Dropped);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
