// Constraints on a map from a quantization: the places of its cones and corners and the
// translations along its seams, such that every arc is as long as its number of edges.
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice, stop);
//   const std::vector<Index> edges(t_mesh.arcs.size(), 2);   // by arc, as Quantization has them
//   const GridTranslations grid(map, lattice, t_mesh, edges, 0.125);
//   builder.add(grid);                                                  // an integer-grid map
//   builder.add(std::make_shared<const QuadraticPenalty>(grid), 1e3);   // or softly
//
// Lines along arcs are developed from chart to chart, so that the constraints hold along the paths
// of the T-mesh, not only up to multiples of the edge length. If a map that satisfies them is
// reached along a path of injective maps, it has the quantization's T-mesh with these lengths.
#pragma once

#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

// The weight of real lengths in the pinned lengths, (1 - kRealPart) n + kRealPart length. It keeps
// lines of the motorcycle graph without an edge between them in their order, about 1e4 lattice
// steps apart. A millionth of an edge is invisible.
inline constexpr double kRealPart = 1e-6;

// Returns the edges of the border and of features, with the coordinate that is constant along them.
std::vector<AlignedEdge> held_axes(const SeamlessLattice& lattice);

class GridTranslations final : public Constraint {
 public:
  // map: that of the lattice; edges: by arc; edge_length: in model units of the map. Throws
  // Error(Infeasible) if the numbers contradict each other.
  GridTranslations(const BezierMap& map, const SeamlessLattice& lattice, const TMesh& mesh,
                   const std::vector<Index>& edges, double edge_length);

  // Appends the rows for unknowns of any degree, 2 numbers a node.
  void append_rows(ConstraintRows& rows) const override;
  double edge_length() const { return edge_length_; }
  // Returns the constraints of the map scaled by this factor.
  GridTranslations scaled(double factor) const;

 private:
  // The translation of a seam: component c of the point at `side` minus i^turns times the point at
  // `opposite`, both nodes.
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
