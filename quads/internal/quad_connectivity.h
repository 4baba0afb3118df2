// The quads of a T-mesh and a quantization, as numbers of vertices.
//
//   const std::vector<Index> edges(t_mesh.arcs.size(), 0);   // by arc, as Quantization has them
//   QuadConnectivity quads(t_mesh, edges);
//   if (quads.joining_arcs().empty()) std::cout << quads.quads_of(0).size() << " quads\n";
//
// A patch of p and q edges has p q quads, so Q = sum over patches of p q. Arcs without edges join
// their nodes, and patches without width their long sides. If all arcs have edges nothing is
// joined, and the quads form a mesh of the surface by construction: V - E + Q is its Euler
// characteristic. A joined vertex has at most one cone, or one stretch of the border or of features
// with one corner.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "majorant/mesh/union_find.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

class QuadConnectivity {
 public:
  // Both must outlive this. edges: by arc, see Quantization.
  QuadConnectivity(const TMesh& mesh, const std::vector<Index>& edges);

  // Returns arcs that need one more edge; empty if there are none. For each pair of cones, corners
  // or parts of held lines that are one vertex, it is the longest of the arcs without edges that
  // join them. For a border loop or a closed feature line with too few edges, it is one of its
  // arcs.
  std::vector<Index> joining_arcs();
  // Returns arcs that need one more edge because quads have a vertex twice, or edges more than two
  // quads. It is the longest of the arcs without edges at such a vertex; if there are none, the one
  // with the longest edges around the patch.
  std::vector<Index> arcs_of_bad_quads();

  // Returns the number of vertices before any are joined.
  Index vertex_count() const { return vertex_count_; }
  // Returns the representative of all vertices that a vertex is joined with.
  Index joined(Index vertex) { return same_.find(vertex); }
  // Returns the vertex after `step` edges of the half-arc.
  Index vertex_on(Index half_arc, Index step) const;
  // Returns the vertices on arcs of the border and of features.
  std::vector<Index> vertices_of_held() const;
  // Returns the first inner vertex of a patch; inner vertices are numbered row by row.
  Index first_in_patch(std::size_t patch) const { return first_in_patch_[patch]; }
  // Returns the quads of a patch, row by row, before vertices are joined.
  std::vector<std::array<Index, 4>> quads_of(std::size_t patch) const;

 private:
  std::vector<Index> vertices_of_side(const std::vector<Index>& side) const;
  void join();
  std::vector<char> joins_too_much();
  std::vector<Index> arcs_that_join(const std::vector<char>& is_joined);
  std::vector<Index> arcs_of_short_borders() const;

  const TMesh& mesh_;
  const std::vector<Index>& edges_;
  std::vector<Index> first_on_arc_, first_in_patch_;  // inner vertices of arcs, of patches
  Index vertex_count_ = 0;                            // before vertices are joined
  UnionFind same_, same_on_held_;                     // all joins; joins by arcs of held lines only
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
