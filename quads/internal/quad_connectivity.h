// The quads of a T-mesh and a quantization, by numbers of vertices alone.
//
//   const std::vector<Index> edges(t_mesh.arcs.size(), 0);   // by arc, as Quantization has them
//   QuadConnectivity quads(t_mesh, edges);
//   if (quads.joining_arcs().empty()) std::cout << quads.quads_of(0).size() << " quads\n";
//
// A patch of p and q edges becomes p q quads, so Q = sum over patches of p q. Arcs of no edges join
// their nodes, patches of no width their long sides. Where all arcs have edges nothing is joined,
// and the quads are a mesh of the surface by construction: V - E + Q is its Euler characteristic.
// What is joined has one cone, or one stretch of the border or of features with one corner, at
// most.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "majorant/mesh/union_find.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

class QuadConnectivity {
 public:
  // Both outlive this. edges: by arc, as Quantization has them.
  QuadConnectivity(const TMesh& mesh, const std::vector<Index>& edges);

  // Returns arcs to give an edge more. Where two cones, corners or parts of held lines are one
  // vertex, so that they may come apart: the longest of the arcs without edges that join them;
  // where a loop of the border or a feature line around has few edges: one of its arcs. Empty where
  // there is none.
  std::vector<Index> joining_arcs();
  // Returns arcs to give an edge more, for quads with one vertex twice and edges with more than two
  // quads: of the arcs without edges at such a vertex the longest; where there are none, that with
  // the longest edges around the patch.
  std::vector<Index> arcs_of_bad_quads();

  // Returns the number of vertices, before any are joined.
  Index vertex_count() const { return vertex_count_; }
  // Returns the one vertex that stands for all that a vertex is joined with.
  Index joined(Index vertex) { return same_.find(vertex); }
  // Returns the vertex after so many edges of the half-arc.
  Index vertex_on(Index half_arc, Index step) const;
  // Returns the vertices on arcs of the border and of features.
  std::vector<Index> vertices_of_held() const;
  // Returns the first vertex strictly inside of a patch; they are numbered row by row.
  Index first_in_patch(std::size_t patch) const { return first_in_patch_[patch]; }
  // Returns the quads of a patch, row by row, before any vertices are joined.
  std::vector<std::array<Index, 4>> quads_of(std::size_t patch) const;

 private:
  std::vector<Index> vertices_of_side(const std::vector<Index>& side) const;
  void join();
  std::vector<char> joins_too_much();
  std::vector<Index> arcs_that_join(const std::vector<char>& is_joined);
  std::vector<Index> arcs_of_short_borders() const;

  const TMesh& mesh_;
  const std::vector<Index>& edges_;
  std::vector<Index> first_on_arc_, first_in_patch_;  // vertices strictly inside of arcs, patches
  Index vertex_count_ = 0;                            // before any are joined
  UnionFind same_, same_on_held_;                     // joined; those by arcs of held lines alone
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
