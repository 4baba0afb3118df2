// What whole numbers for the arcs of a T-mesh say of a map: where its cones and corners lie, and
// what the translations along its seams are, if every arc is to be as long as it has edges.
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice, stop);
//   const std::vector<Index> edges(t_mesh.arcs.size(), 2);   // by arc, as Quantization has them
//   const GridTranslations grid(map, lattice, t_mesh, edges, 0.125);
//   builder.add(grid);                                                  // an integer-grid map
//   builder.add(std::make_shared<const QuadraticPenalty>(grid), 1e3);   // pulled towards one
//
// Lines along arcs are developed from chart to chart, so what they say holds for the paths of the
// T-mesh, not only up to multiples of the edge length. Where a map that satisfies this is reached
// along a path of injective maps, it has the T-mesh that the numbers are of, with these lengths.
#pragma once

#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

// The part that real lengths have in those that are pinned, (1 - kRealPart) n + kRealPart length:
// lines of the motorcycle graph that no edge is between stay apart, in their order, by some 1e4
// steps of the lattice. A millionth of an edge is below what anybody sees.
inline constexpr double kRealPart = 1e-6;

// Edges of the border and of features, and the coordinate that is constant along them.
std::vector<AlignedEdge> held_axes(const SeamlessLattice& lattice);

class GridTranslations final : public Constraint {
 public:
  // map: that of the lattice; edges: by arc; edge_length: model units of the map. Throws
  // Error(Infeasible) where these numbers contradict each other.
  GridTranslations(const BezierMap& map, const SeamlessLattice& lattice, const TMesh& mesh,
                   const std::vector<Index>& edges, double edge_length);

  // Of unknowns of any degree, 2 numbers per node.
  void append_rows(ConstraintRows& rows) const override;
  double edge_length() const { return edge_length_; }
  // Of the map times this factor.
  GridTranslations scaled(double factor) const;

 private:
  // Component c of the point at `side` - i^turns that at `opposite`: nodes.
  struct Translation {
    Index side, opposite;
    int turns, component;
    double value;
  };
  double edge_length_;
  std::vector<FixedUnknown> fixed_;
  std::vector<Translation> translations_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
