// Constraints of maps that are eliminated exactly. local_injectivity.h has the conditions that
// every step must satisfy; framework/constraint.h holds points and single unknowns without a mesh.
//
//   builder.add(FixedPoints({{12, {0.1, 0.2}}}));              // a pin in the plane
//   builder.add(AxisAlignment(space, {{12, 0}, {40, 1}}));     // edges along the axes
//   builder.add(SeamlessConstraint(space, map.shared_seams()));
//   builder.add(std::make_shared<const LocalInjectivity>(space, 2 * rest.measure));
//
// QuadraticPenalty (framework/terms/quadratic_penalty.h) makes any of these constraints soft.
#pragma once

#include <memory>
#include <vector>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/constraint.h"
#include "majorant/mesh/seams.h"

namespace majorant {

// Seams that hold exactly: the control points on the two sides of every seam edge agree up to the
// chain's rotation and translation, c = i^k c' + t.
//
//   builder.add(SeamlessConstraint(space, map.shared_seams()));
//
// Equivalent to [MC20] Eq. 15, c_i - c_{i+1} = R^k (c'_i - c'_{i+1}), which omits t. The
// translation is kept as an auxiliary unknown, since eliminating it would tie every control point
// of a chain to those of one edge. It is counted in halves, t = 2 s. A cone satisfies (1 - i^K) c =
// (a sum of translations), and 1 - i^K divides 2, so the cone is an integer combination of
// half-translations.
//
// Elimination then keeps the entries of Z small, unless pins or alignment interfere: in {0, +-1,
// +-2} on cuts that the map needs, in small integers (at most 4 in tests) on any cuts. It
// recognizes redundant rows (around closed chains, at the ends of slits, where chains meet).
// Positions are accurate to a few units in the last place of the map's size.

class SeamlessConstraint final : public Constraint {
 public:
  // space: of any degree, over the faces of the cut surface of `seams`.
  SeamlessConstraint(std::shared_ptr<const BezierTriangleSpace> space,
                     std::shared_ptr<const Seams> seams);
  void append_rows(ConstraintRows& rows) const override;

 private:
  std::shared_ptr<const BezierTriangleSpace> space_;
  std::shared_ptr<const Seams> seams_;
};

// Returns the nodes on the boundary of the uncut surface, sorted: those of the space's boundary
// that lie on an edge that is no seam.
std::vector<Index> boundary_nodes(const BezierTriangleSpace& space, const Seams& seams);

// The distance of x (2 numbers per node) from a seamless map: the largest |(c_i - c_{i+1}) - i^k
// (c'_i - c'_{i+1})| over all seam edges and control points, and its edge.
struct SeamMismatch {
  Index edge = -1;  // of seams.edges(); -1 when the mismatch is zero everywhere
  double distance = 0;
};
SeamMismatch worst_seam_edge(const BezierTriangleSpace& space, const Seams& seams, VecIn x);
double seam_residual(const BezierTriangleSpace& space, const Seams& seams, VecIn x);

// Edges that stay parallel to an axis: u or v is constant along the control points of chosen
// half-edges, such as feature lines and boundaries of maps for quadrangulation.
//
//   builder.add(AxisAlignment(space, {{12, 0}, {40, 1}}));  // u along half-edge 12, v along 40
//
// It can be combined with seams (aligning one side aligns the other) and with hard points. Edges
// that meet and hold the same coordinate share its value.

struct AlignedEdge {
  Index half_edge;  // 3 face + corner, as in surface_mesh.h
  int coordinate;   // 0: u is constant along it, 1: v
};

class AxisAlignment final : public Constraint {
 public:
  // Throws InvalidArgument for a half-edge or coordinate out of range.
  AxisAlignment(std::shared_ptr<const BezierTriangleSpace> space, std::vector<AlignedEdge> edges);
  void append_rows(ConstraintRows& rows) const override;

 private:
  std::shared_ptr<const BezierTriangleSpace> space_;
  std::vector<AlignedEdge> edges_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
