// Quadrature rules: points of a reference element and weights that add to 1.
//
// Points of simplices are barycentric, those of the square are (s, t); the number of columns (3 or
// 4, or 2) says which. All rules are symmetric under the symmetries of the element, so results do
// not depend on where a cell starts, and all weights are positive.
#pragma once

#include "majorant/elements/bernstein.h"
#include "majorant/elements/bernstein_basis.h"

namespace majorant {

struct Quadrature {
  // #L by coordinates: 3 or 4 barycentric ones that add to 1, or (s, t) of the unit square.
  RowMatrix points;
  Vec weights;  // #L, add to 1
  Index size() const { return static_cast<Index>(weights.size()); }
};

// Centroids of the m(m+1)/2 upright triangles of the m-fold subdivision, equal weights; exact for
// linear functions. [MC20] Sec. 8.3 as repaired in method.md E5 (i).
Quadrature lattice_rule(int m);

// Radon's 7 points, exact for degree 5 [Rad48].
Quadrature radon_rule();

// 14 points of the tetrahedron, exact for degree 5 [Wal00].
Quadrature walkington_rule();

// m by m Gauss points of the unit square, exact for degree 2m - 1 in s and in t.
Quadrature tensor_gauss_rule(int m);

// `rule` on the pieces of the m-fold subdivision of its element: m^2 congruent triangles or
// squares. Tetrahedra: m-fold lattice, its octahedra cut into 8 around their centres, together
// (m^3 + 2m) / 3 + 8 (m^3 - m) / 6 pieces. Keeps the exactness of the rule.
Quadrature composite_rule(const Quadrature& rule, int m);

// Triangles: `rule` on the subtriangles of a mesh graded towards the corners: `levels` times, the
// corner subtriangles of the m-fold subdivision are halved.
Quadrature corner_graded_rule(const Quadrature& rule, int m, int levels);

// `rule` scaled by 1 - weight, and the lattice points (a,b,c)/m, a+b+c = m, or (a,b)/m of a square
// (corners for m = 1) sharing `weight`: guard points that let the energy see the element's
// boundary. method.md N12.
Quadrature guarded_rule(const Quadrature& rule, int m, double weight);

}  // namespace majorant
