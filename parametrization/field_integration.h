// From a combed cross field to a seamless map that follows it, injective or not.
#pragma once

#include "majorant/parametrization/bezier_map.h"
#include "majorant/parametrization/cross_field.h"
#include "majorant/parametrization/seamless_start.h"

namespace majorant {

// The piecewise linear map of least int |grad u - X|^2 + |grad v - Y|^2 whose seams have the
// transitions of `field`: X, Y are branches 0 and 1 of every face, of length 1. A sparse linear
// solve; seams hold exactly. field: combed along is_cut (3 #F), turns 0 elsewhere. The result may
// have inverted triangles (untangle.h). Throws Error(Infeasible) when the linear system is
// singular.
BezierMap integrate_field(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                          const CrossField& field);

}  // namespace majorant
