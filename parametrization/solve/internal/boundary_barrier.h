// A barrier between parts of the boundary that come near each other, which keeps a map of degree 1
// free of overlaps without further unknowns ([SS15] Sec. 4; the function is that of [LFS20]).
//
//     E_bar(x) = sum over pairs (v, e) of a boundary vertex and a boundary edge
//                reach l b(d^2 / reach^2),    b(s) = -(s - 1)^2 log s for s < 1, else 0
//
// d is the distance of v from e, l the mean length of the boundary edges at v on the surface. The
// reach is a part of the smaller of l and the length of e. An edge and its ends form no pair.
//
// Internal to parametrize().
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/feasibility.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {

// The boundary edges of a map of degree 1 and the lengths that set the reach of its barrier.
class BoundaryEdges {
 public:
  // map: its control points do not matter. scale: factor from lengths of the mesh to those of x.
  BoundaryEdges(const BezierMap& map, double scale);

  Index edge_count() const { return ends_.rows(); }
  const Cells& ends() const { return ends_; }                     // vertices, #edges by 2
  const std::vector<Index>& vertices() const { return vertex_; }  // each once

  // Returns the pairs whose distance at x is at most `factor` times their reach, #P by 3: the
  // vertex, then the ends of the edge. x: 2 numbers per vertex.
  Cells near_pairs(VecIn x, const BarrierReach& reach, double factor = 1) const;
  // Returns the barrier of these pairs.
  std::shared_ptr<const EnergyTerm> barrier(const Cells& pairs, const BarrierReach& reach) const;
  double mean_length() const { return length_.size() > 0 ? length_.mean() : 0; }

 private:
  double of_pair(Index vertex, Index edge, const BarrierReach& reach) const;

  Cells ends_;
  std::vector<Index> vertex_;
  double size_;              // the square root of the area
  Vec length_;               // of edges
  Vec length_at_;            // by vertex: the mean of its boundary edges
  std::vector<Index> edge_;  // by vertex: the boundary edge that begins there; -1: none
};

// Requires that the boundary is simple. Steps end before a vertex passes through an edge; the
// boundary at their end is proven.
class SimpleBoundary final : public FeasibilityChecker {
 public:
  // map: of degree 1; its control points do not matter. A blocking edge is numbered from the number
  // of faces on.
  SimpleBoundary(std::shared_ptr<const BoundaryEdges> edges, BezierMap map);

  std::string_view name() const override { return "the boundary is simple"; }
  Verdict check(VecIn x) const override;
  StepBound max_step(VecIn x, VecIn d, double s) const override;

 private:
  StepBound first_contact(VecIn x, VecIn d, double s) const;

  std::shared_ptr<const BoundaryEdges> edges_;
  BezierMap map_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
