// Quadrature rules: points of a reference element and weights that add to 1.
//
// Points of simplices are barycentric. All triangle rules are symmetric under permutations of the
// corners, so results do not depend on where a face starts. Rules here have positive weights.
#pragma once

#include "majorant/elements/bernstein.h"
#include "majorant/elements/bernstein_basis.h"

namespace majorant {

struct Quadrature {
  // #L by coordinates: 3 or 4 barycentric ones that add to 1, or D of a cube.
  RowMatrix points;
  Vec weights;  // #L, add to 1
  Index size() const { return static_cast<Index>(weights.size()); }
};

// Centroids of the m(m+1)/2 upright triangles of the m-fold subdivision, equal weights; exact for
// linear functions. [MC20] Sec. 8.3 as repaired in method.md E5 (i).
Quadrature lattice_rule(int m);

// Radon's 7 points, exact for degree 5 [Rad48].
Quadrature radon_rule();

// `rule` on each of the m^2 congruent subtriangles.
Quadrature composite_rule(const Quadrature& rule, int m);

// `rule` on the subtriangles of a mesh graded towards the corners: `levels` times, the corner
// subtriangles of the m-fold subdivision are halved.
Quadrature corner_graded_rule(const Quadrature& rule, int m, int levels);

// `rule` scaled by 1 - weight, and the points (a,b,c)/m, a+b+c = m (corners for m = 1) sharing
// `weight`: guard points that let the energy see the element's boundary. method.md N12.
Quadrature guarded_rule(const Quadrature& rule, int m, double weight);

}  // namespace majorant
