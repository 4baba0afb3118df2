// From a T-mesh and whole numbers of its arcs to quads: connectivity from these alone, then places
// on the surface.
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice);
//   const std::vector<Index> edges(t_mesh.arcs.size(), 0);   // by arc, as Quantization has them
//   ExtractedQuads extracted(lattice, t_mesh, edges);
//   if (extracted.joining_arcs().empty()) polygons = extracted.polygons();
//
// A patch of p and q edges becomes p q quads. Arcs of no edges join their nodes, patches of no
// width their long sides. Where all arcs have edges nothing is joined, and the quads are a mesh of
// the surface by construction. Vertices of the border and of features stay on them: what is joined
// has one cone, or one stretch of these with one corner, at most. Vertices on arcs are spaced
// evenly along them. Inside of a patch vertex (i, j) lies where the line between the points i of
// its lower and upper sides crosses that between the points j of its left and right sides: such
// lines cross once, and those of one family never, so that all quads of a patch are convex in the
// map.
#pragma once

#include <array>
#include <vector>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/union_find.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/smoothing.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

class ExtractedQuads {
 public:
  // All of them outlive this. edges: by arc, as Quantization has them.
  ExtractedQuads(const SeamlessLattice& lattice, const TMesh& mesh,
                 const std::vector<Index>& edges);

  // Arcs to give an edge more. Where two cones, corners or parts of held lines are one vertex, so
  // that they may come apart: the longest of the arcs without edges that join them; where a loop of
  // the border or a feature line around has few edges: one of its arcs. Empty where there is none.
  std::vector<Index> joining_arcs();
  // The same for quads that have one vertex twice, and for edges with more than two quads: of the
  // arcs without edges at such a vertex the longest; where there are none, that with the longest
  // edges around the patch.
  std::vector<Index> arcs_of_bad_quads();
  // The quads, without texture, with positions of the file that the surface came from. Throws
  // Error(Infeasible) where a vertex could not be placed.
  PolygonMesh polygons();
  // Of polygons(), which was called before.
  HeldVertices held_vertices();
  const std::vector<Index>& patches() const { return patch_of_; }  // by quad

 private:
  // A point of the surface, and a direction there, in the chart of a face.
  struct Place {
    Index face;
    LatticePoint at;
    int direction;
  };
  Index vertex_on(Index half_arc, Index step) const;
  std::vector<Index> vertices_of_side(const std::vector<Index>& side) const;
  // Before any vertices are joined, row by row.
  std::vector<std::array<Index, 4>> quads_of(std::size_t patch) const;
  void join();
  std::vector<Index> vertices_of_held() const;
  std::vector<char> joins_too_much();
  std::vector<Index> arcs_that_join(const std::vector<char>& is_joined);
  std::vector<Index> arcs_of_short_borders() const;
  void place_arcs();
  void place_inside(const TPatch& patch, Index first);
  // `place` becomes the point at that vector from it, by its direction as first axis.
  void walk(Place& place, LatticePoint by) const;
  Vector3 position(const Place& place) const;
  BorderPoint held_point(const Place& place) const;

  const SeamlessLattice& lattice_;
  const TMesh& mesh_;
  const std::vector<Index>& edges_;
  std::vector<Index> first_on_arc_, first_in_patch_;  // vertices strictly inside of arcs, patches
  Index vertex_count_ = 0;                            // before any are joined
  UnionFind same_, same_on_held_;                     // joined; those by arcs of held lines alone
  std::vector<std::vector<Place>> places_;            // by arc: of its edges + 1 points
  std::vector<Vector3> positions_;
  std::vector<BorderPoint> on_held_;      // before any are joined
  std::vector<BorderPoint> held_points_;  // of polygons()
  std::vector<Index> number_;             // in polygons(), by name in same_
  std::vector<Index> patch_of_;           // by quad
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
