// Rules of the solver of one degree (degree_solver.h): when it softens a start, how deep it
// bisects, how often it refines.
#pragma once

#include <vector>

#include "majorant/framework/newton.h"
#include "majorant/parametrization/maps/map_problem.h"

namespace majorant {

inline constexpr int kDeepestBisection = 13;  // when the depth asked for holds a run back
inline constexpr int kBisectionsDeeper = 4;   // at a time
inline constexpr int kAccuracyRounds = 3;     // of refining the quadrature of a finished run

// Throws Error(Usage), listing what there is, when a term has no such curvature model.
void require_curvature(const DensityTerms& terms, Curvature asked);

NewtonOptions newton_options(Curvature curvature, const StopCheck& stop);

// Whether a limit or Ctrl-C ended a solve.
bool was_stopped(Status status);
// `result` with what ended a run in the middle of something else.
SolveResult stopped(SolveResult result, Directive why);

// Weights of the faces for a step from a start of enormous energy (mean density 1e5 and more: a
// Tutte map with nearly collapsed triangles); empty for others. energy, measure: #F. sqrt is
// concave, so weights 1 / sqrt(density) give a linear majorizer of sqrt: each step on the
// reweighted energy decreases sum A sqrt(density).
Vec soft_weights(const Vec& energy, const Vec& measure);

}  // namespace majorant
