// Seams that hold exactly: the control points on the two sides of every seam edge agree up to the
// chain's rotation and translation, c = i^k c' + t.
//
//   builder.add(SeamlessConstraint(space, map.shared_seams()));
//
// Equivalent to [MC20] Eq. 15, c_i - c_{i+1} = R^k (c'_i - c'_{i+1}), which says the same without
// t. The translation is kept as an auxiliary unknown: eliminating it would tie every control point
// of a chain to those of one edge. It is counted in halves, t = 2 s, so that a cone, which
// satisfies (1 - i^K) c = (a sum of translations), is an integer combination of half-translations:
// 1 - i^K divides 2. Elimination then keeps the entries of Z in {0, +-1, +-2} on cuts that the map
// needs and in small integers (4 at most in tests) on any, unless pins or alignment interfere.
// Redundant rows (around closed chains, at the ends of slits, where chains meet) are recognized
// there. Positions follow to a few units in the last place of the map's size.
#pragma once

#include <memory>

#include "majorant/elements/bezier_triangle_space.h"
#include "majorant/framework/constraint.h"
#include "majorant/mesh/seams.h"

namespace majorant {

class SeamlessConstraint final : public Constraint {
 public:
  // space: of any degree over the cut surface's faces that `seams` was made for.
  SeamlessConstraint(std::shared_ptr<const BezierTriangleSpace> space,
                     std::shared_ptr<const Seams> seams);
  void append_rows(ConstraintRows& rows) const override;

 private:
  std::shared_ptr<const BezierTriangleSpace> space_;
  std::shared_ptr<const Seams> seams_;
};

// Nodes on the boundary of the uncut surface, sorted: those of the space's boundary that lie on an
// edge that is no seam.
std::vector<Index> boundary_nodes(const BezierTriangleSpace& space, const Seams& seams);

// How far x (2 numbers per node) is from seamless: the largest
// |(c_i - c_{i+1}) - i^k (c'_i - c'_{i+1})| over all seam edges and control points, and where.
struct SeamMismatch {
  Index edge = -1;  // of seams.edges(); -1 when the mismatch is zero everywhere
  double distance = 0;
};
SeamMismatch worst_seam_edge(const BezierTriangleSpace& space, const Seams& seams, VecIn x);
double seam_residual(const BezierTriangleSpace& space, const Seams& seams, VecIn x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
