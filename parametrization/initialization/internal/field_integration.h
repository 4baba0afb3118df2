// From a combed cross field to a seamless map that follows it, injective or not.
#pragma once

#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/maps/bezier_map.h"

namespace majorant {

// The piecewise linear map of least int (|grad u - X|^2 + |grad v - Y|^2) / scale^2 whose seams
// have the transitions of `field`: X, Y are branches 0 and 1 of every face, of length `scale`. A
// sparse linear solve; seams hold exactly. field: combed along is_cut (3 #F), turns 0 elsewhere.
// scale: #F, positive; empty: 1. The field of prescribed cones and the scale of the conformal
// metric with these cones fit together but around handles and holes, where the metric may turn by
// other angles. The result may have inverted triangles (untangle.h). Throws Error(Infeasible) when
// the linear system is singular.
BezierMap integrate_field(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                          const CrossField& field, const Vec& scale = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
