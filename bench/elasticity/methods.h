// The minimizers that the suite compares, and their counts by its rules.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cases.h"
#include "majorant/framework/minimizer.h"

namespace majorant::elasticity {

// Plain curvature filters, and two methods of this library: Blend changes over to the exact Hessian
// near the minimum, Shifted always uses the exact Hessian.
enum class Method {
  Clamp,           // negative eigenvalues set to 0, at every quadrature point
  Absolute,        // negative eigenvalues set to their absolute values
  Adaptive,        // [CLJLZ24]: absolute or clamped, depending on the last step
  Majorizer,       // the least convex majorizer, method.md section 5
  PaperMajorizer,  // composite majorization [SPSHL17] in the form of [MC20]
  Reweighted,      // SLIM's proxy [RPPSH17]
  Lbfgs,           // in the metric of the Hessian at the start
  Shifted,         // the exact Hessian, shifted if it is not definite
  Blend,           // the defaults of NewtonOptions
};
inline constexpr Method kMethods[] = {Method::Clamp,     Method::Absolute,       Method::Adaptive,
                                      Method::Majorizer, Method::PaperMajorizer, Method::Reweighted,
                                      Method::Lbfgs,     Method::Shifted,        Method::Blend};
std::string method_name(Method method);

// iterations: steps until the largest entry of the gradient is below the tolerance.
struct Counts {
  bool is_reached = false;
  int iterations = 0, factorizations = 0, solves = 0;
  double cpu_seconds = 0, energy = 0, gradient = 0;
  std::string status;
  Vec y;
};

// Returns whether the terms of the problem have the method's model of curvature.
bool supports(const Problem& problem, Method method);
Counts run(const Case& c, Method method, double tolerance, int max_iterations);

}  // namespace majorant::elasticity

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
