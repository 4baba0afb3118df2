// Quadrature rules: points of a reference cell and weights that add to 1.
//
//   space->tabulate(exact_rule({3}, 5));            // triangles, quintic polynomials
//   const Quadrature wedge = exact_rule({3, 2}, 5);   // triangle x segment
//
// Terms without a rule of their own use that of their space (ElementSpace::default_rule).
//
// A rule stores its cell, and spaces refuse rules of another one: three columns may be a point of a
// triangle or of a cube. All rules here are symmetric under the symmetries of the cell, so results
// do not depend on where a cell starts, and all weights are positive.
//
// Reported numbers come from measure_map(), which refines its rules until two agree.
#pragma once

#include <string_view>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// A cell, as the number of corners of each factor: {3} triangle, {4} tetrahedron, {2, 2} square.
using Factors = std::vector<int>;

struct Quadrature {
  Factors cell;
  // #L by coordinates, factor by factor: the barycentric ones of a triangle or tetrahedron, which
  // add to 1, and one number in [0, 1] for a segment. A square has (s, t), a wedge 3 + 1 columns.
  RowMatrix points;
  Vec weights;  // #L, add to 1
  Index size() const { return static_cast<Index>(weights.size()); }
};

// Throws InvalidArgument, beginning with `name` (of the space), unless the rule is one of `cell`:
// made for it, points inside, as many weights as points, adding to 1.
void require_cell(const Quadrature& rule, const Factors& cell, std::string_view name);

// Returns the rule with fewest points that is exact for polynomials of this degree in the
// coordinates of every factor of the cell:
//     degree            1   2   3, 4   5   6   7, 8   9, 10   11, 12
//     of a triangle     1   3      6   7  12     16      25       33
//     of a tetrahedron  1   4     14  14  24     46
// and (degree + 2) / 2 Gauss points of a segment, rounded down. Throws InvalidArgument for a
// negative degree, one above highest_exactness(), and a cell of other factors.
Quadrature exact_rule(const Factors& cell, int degree);
// Returns the highest degree of exact_rule(); the largest int if all factors are segments.
int highest_exactness(const Factors& cell);

// Returns the centroids of the m(m+1)/2 upright triangles of the m-fold subdivision, equal weights;
// exact for linear functions. [MC20] Sec. 8.3 as repaired in method.md E5 (i).
Quadrature lattice_rule(int m);

// Returns Radon's 7 points, exact for degree 5 [Rad48]: exact_rule({3}, 5).
Quadrature radon_rule();

// Returns 14 points of the tetrahedron, exact for degree 5 [Wal00]: exact_rule({4}, 5).
Quadrature walkington_rule();

// Returns m Gauss points of the unit segment, exact for degree 2m - 1: a factor for product_rule.
Quadrature gauss_rule(int m);

// Returns the rule of the product of two cells: every point of `a` with every point of `b`.
Quadrature product_rule(const Quadrature& a, const Quadrature& b);

// Returns m by m Gauss points of the unit square, exact for degree 2m - 1 in s and in t.
Quadrature tensor_gauss_rule(int m);

// Returns `rule` on the pieces of the m-fold subdivision of its cell: m segments, m^2 congruent
// triangles, products of the pieces of the factors. Tetrahedra have an m-fold lattice with
// octahedra cut into 8 around their centres, together (m^3 + 2m) / 3 + 8 (m^3 - m) / 6 pieces. The
// exactness of the rule is kept.
Quadrature composite_rule(const Quadrature& rule, int m);

// Returns `rule`, of a triangle, on the subtriangles of a mesh graded towards the corners: the
// corner subtriangles of the m-fold subdivision are halved `levels` times.
Quadrature corner_graded_rule(const Quadrature& rule, int m, int levels);

// The total weight of guard points at the corners: small enough that integrals hardly change, large
// enough for the energy to sample the corners. Tuned by bench/tune.py quadrature.corner_guard.
inline constexpr double kCornerGuard = 1e-3;

// Returns `rule` scaled by 1 - weight, with additional points that share `weight`: the lattice
// points of its cell, whose coordinates are multiples of 1/m (corners for m = 1). They are guard
// points, at which the energy samples the element's boundary. method.md N12.
Quadrature guarded_rule(const Quadrature& rule, int m, double weight);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
