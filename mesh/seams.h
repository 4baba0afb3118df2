// Seams: how the sides of a cut surface fit together. With seams a map can be seamless, whatever
// its positions.
//
//   for (const SeamEdge& seam : map.seams().edges()) std::cout << seam.turns << "\n";
//   for (const Cone& cone : map.seams().cones()) std::cout << cone.vertex << "\n";
//
// A surface is cut open to be mapped. Across a seam edge the two images of the edge agree up to a
// rotation by a multiple of 90 degrees and a translation,
//     c = i^k c' + t          (c = u + i v on one side, c' on the other; method.md section 8),
// with one k (`turns`) and one t for every chain: a maximal run of seam edges between nodes. A node
// is a vertex with one seam edge, three or more, or two with different turns, or a vertex of the
// boundary. A vertex whose angles sum to a multiple of 90 degrees other than 360 is a cone; its
// index is (4 - quarter turns) / 4. [MC20] Sec. 7.
//
// Not for charts whose sides need not fit: choose_cuts() (parametrization/seams/choose_cuts.h)
// flags half-edges, and cutting along them gives a mesh without seams.
#pragma once

#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// The mismatch along a seam edge, relative to the mean length of edges in uv, above which
// coordinates are not seamless. Files with 6 digits stay well below it.
inline constexpr double kSeamTolerance = 1e-3;

// Half-edge 3 f + k runs from corner k of face f to corner k + 1 (mod 3), as in SurfaceMesh.
struct SeamEdge {
  Index side, opposite;  // half-edges of the cut surface, in opposite directions
  int turns;             // k in 0..3: uv on `side` = i^k uv on `opposite` + t
  Index chain = -1;
};

struct Cone {
  Index vertex;       // of the uncut surface
  int quarter_turns;  // sum of its angles / 90 degrees
};

class Seams {
 public:
  Seams() = default;  // a surface that is not cut
  // cut_faces: #F by 3 vertices of the cut surface; surface_vertex: for each of them the vertex of
  // the uncut surface; edges: every seam edge once, `chain` is ignored; quarter_turns: per vertex
  // of the uncut surface, 0 on its boundary. Edges are reversed (k -> -k) as needed, so that all
  // edges of a chain have the same turns.
  Seams(const Cells& cut_faces, std::vector<Index> surface_vertex, std::vector<SeamEdge> edges,
        std::vector<int> quarter_turns);

  bool empty() const { return edges_.empty(); }
  // True without seams and cones, as for any plain map. (A cone of 720 degrees needs no seam.)
  bool trivial() const { return empty() && cones().empty(); }
  const std::vector<SeamEdge>& edges() const { return edges_; }
  Index chain_count() const { return chain_count_; }
  // Vertices of the uncut surface, by vertex of the cut one; empty if nothing is cut.
  const std::vector<Index>& surface_vertex() const { return surface_vertex_; }
  // Per vertex of the uncut surface: 0 at its boundary, 4 if it is no cone.
  const std::vector<int>& quarter_turns() const { return quarter_turns_; }
  std::vector<Cone> cones() const;

 private:
  void find_chains(const Cells& cut_faces);

  std::vector<Index> surface_vertex_;
  std::vector<SeamEdge> edges_;
  std::vector<int> quarter_turns_;
  Index chain_count_ = 0;
};

// Returns i^turns (u, v), exactly, for any integer.
Vector2 rotated(const Vector2& uv, int turns);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
