// The choice of a second-order model by its name, for command lines and scripts.
//
//   SolveOptions options;
//   options.curvature = Curvature::Majorizer;            // a model of curvature.h
//   options.curvature = *curvature_choice("adaptive");   // the projection by the last step
//
// Not for terms, which get a BlendedCurvature (curvature.h).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/curvature.h"

namespace majorant {

// The choice of the projection by the last step [CLJLZ24]: absolute eigenvalues (2) keep directions
// short where the quadratic model is wrong, clamped ones (1) are faster where it is right. The
// model is right where the ratio of the actual decrease to the one that it predicts is near 1.
struct AdaptiveProjectionRules {
  // The next projection is 1 up to this |ratio - 1|, and 2 beyond; 0: NewtonOptions::projection is
  // kept. `adaptive` uses 0.1, which is not tuned.
  double tolerance = 0;
};

// A model, with the options of Newton's method that belong to it (newton.h).
struct CurvatureChoice {
  CurvatureChoice(Curvature curvature = Curvature::Projected) : model(curvature) {}
  // The curvature of a single evaluation.
  BlendedCurvature blend() const {
    return model == Curvature::Projected ? BlendedCurvature::projected(projection)
                                         : BlendedCurvature(model);
  }

  Curvature model;
  double projection = 1;
  AdaptiveProjectionRules adaptive = {};
};

// Returns the names of all choices: those of curvature_name(), "absolute" and "adaptive".
std::vector<std::string> curvature_choices();
// Returns the choice with that name, or none.
std::optional<CurvatureChoice> curvature_choice(std::string_view name);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
