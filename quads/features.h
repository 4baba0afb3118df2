// Feature lines of a surface: its sharp edges, or given edges, as lines from corner to corner.
// Edges of quads cover them.
//
//   const std::vector<char> is_feature = sharp_edges(*mesh, kCornerTurn);
//   const FeatureLines features = feature_lines(*mesh, is_feature);
//   std::cout << features.lines.size() << " lines\n";
//
// Not for creases along which an atlas is cut: see choose_cuts.h.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Degrees. A vertex of a border or a feature line is a corner if the turn there is at least this;
// quads have a vertex at every corner. An edge is sharp if the angle between the normals of its
// faces is at least this. Chosen, not tuned.
inline constexpr double kCornerTurn = 35;

// Returns 3 #F flags of the inner edges whose faces' normals differ by at least `degrees`, on both
// sides. Edges inside of a polygon of the file are excluded.
std::vector<char> sharp_edges(const SurfaceMesh& mesh, double degrees);

struct FeatureLine {
  std::vector<Index> half_edges;  // each starts at the end of the previous one
  double length = 0;              // model units
  bool is_closed = false;         // a loop
};

struct FeatureLines {
  std::vector<FeatureLine> lines;
  // #V: 1 at ends of lines, where more than two edges meet, on the border of the surface, and where
  // a line turns by kCornerTurn or more.
  std::vector<char> is_corner;
};

// Returns the lines of these edges. is_feature: 3 #F flags of inner edges, both sides, or empty: no
// lines. Lines are cut at all corners; a line without a corner starts at its smallest vertex.
FeatureLines feature_lines(const SurfaceMesh& mesh, const std::vector<char>& is_feature);

// The treatment of lines that are short for quads. Dropped: all are dropped. SharpKept: lines of at
// least half an edge length are kept if they end at corners of other lines or on the border and if
// their faces' normals differ by kSharpTurn or more everywhere. Such lines are sides of steps and
// teeth of solids.
enum class ShortLines { Dropped, SharpKept };
inline constexpr double kSharpTurn = 60;  // degrees; scans have few such edges; chosen, not tuned

// Returns is_feature without the lines that quads with edges of this length (model units) cannot
// follow: lines shorter than two edges, and lines shorter than four with an end that is on no other
// line and not on the border. Removing lines is repeated until none is short.
std::vector<char> without_short_lines(const SurfaceMesh& mesh, std::vector<char> is_feature,
                                      double edge_length,
                                      ShortLines short_lines = ShortLines::Dropped);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
