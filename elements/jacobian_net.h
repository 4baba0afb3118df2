// The Bernstein coefficients of the Jacobian of a map on Bezier triangles.
//
//   const JacobianNet net = jacobian_net(*space, rest);
//   const Vec stretch = largest_stretch(net, x);           // of each coefficient
//   const double bound = stretch.maxCoeff();               // sigma_max <= bound on all of the map
//
// J of a map of degree n has degree n - 1 on every triangle, and its coefficients are the Jacobians
// of affine triangles: n times the differences of three neighbouring control points. J at any point
// is a convex combination of the coefficients of its face, so what is convex in J and holds at all
// of them holds everywhere: |J|, sigma_max, x^T J y. For n <= 2 the largest of them is attained at
// a corner; beyond, it overestimates, the less the smaller the faces and the more J is alike.
//
// The triangles are a space of degree 1 on the nodes of the map, so that any density can be put on
// coefficients as on a map (make_energy): that is how a bound gets a barrier
// (docs/elements.md). Not for lower bounds of det J, which is not convex: ElementSpace has
// certify().
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

// The triangles alone: #F n (n+1)/2 by 3 nodes.
Cells control_triangles(const BezierTriangleSpace& space);

// rest: constant on every face, #F of them; else throws InvalidArgument.
JacobianNet jacobian_net(const BezierTriangleSpace& space, const RestShapes& rest);

// Coefficient t of J for control points x, 2 numbers per node: J = coefficient * rest directions.
Eigen::Matrix2d jacobian_coefficient(const JacobianNet& net, Index t, VecIn x);

// Upper bounds of the largest singular value of each coefficient, rounding errors included.
Vec largest_stretch(const JacobianNet& net, VecIn x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
