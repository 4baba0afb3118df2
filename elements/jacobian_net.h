// The Bernstein coefficients of the Jacobian of a map on Bezier triangles.
//
//   const JacobianNet net = jacobian_net(*space, rest);
//   const Vec stretch = largest_stretch(net, x);           // of each coefficient
//   const double bound = stretch.maxCoeff();               // sigma_max <= bound on all of the map
//
// J of a map of degree n has degree n - 1 on every triangle. Its coefficients are the Jacobians of
// affine triangles: n times the differences of three neighbouring control points. J at any point is
// a convex combination of the coefficients of its face. So a bound of a convex function of J, such
// as |J|, sigma_max or x^T J y, holds everywhere if it holds at all coefficients. For n <= 2 the
// largest value is attained at a corner. For larger n it overestimates, by less on smaller faces
// and for less variable J.
//
// The triangles are a space of degree 1 on the nodes of the map, so any density can be applied to
// coefficients as to a map (make_energy); a bound gets its barrier in this way (docs/elements.md).
// Lower bounds of det J, which is not convex, come from ElementSpace::certify().
#pragma once

#include <memory>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"

namespace majorant {

struct JacobianNet {
  // #F n (n+1)/2 triangles, those of face f from per_face f on. Vertices are nodes of the map.
  std::shared_ptr<const BezierTriangleSpace> triangles;
  RestShapes rest;  // of the triangles; those of a face share its measure
  int per_face = 1;
};

// Returns the triangles alone: #F n (n+1)/2 by 3 nodes.
Cells control_triangles(const BezierTriangleSpace& space);

// rest: one constant shape for every face; else throws InvalidArgument.
JacobianNet jacobian_net(const BezierTriangleSpace& space, const RestShapes& rest);

// Returns coefficient t of J for control points x, 2 numbers per node: J = coefficient * rest
// directions.
Eigen::Matrix2d jacobian_coefficient(const JacobianNet& net, Index t, VecIn x);

// Returns upper bounds of the largest singular value of each coefficient, rounding errors included.
Vec largest_stretch(const JacobianNet& net, VecIn x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
