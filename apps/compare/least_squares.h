// Symmetric Dirichlet as nonlinear least squares, minimized by Ceres' Levenberg-Marquardt. This
// formulation shares neither derivatives, assembly nor solver with the library, so that both can be
// compared. NewtonMinimizer is faster.
//
//     |J|^2 + |J^-1|^2 is a sum of eight squares at every quadrature point: the residuals are
//     sqrt(w A / area) times the entries of J and of J^-1.
//
//   LeastSquaresMinimizer lm(space, rest, rule, {});
//   SolveResult r = lm.minimize(problem, y0, observer);
#pragma once

#include <memory>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/framework/minimizer.h"

namespace majorant {

struct LeastSquaresOptions {
  // The limit of iterations, see StoppingRules.
  int max_iterations = 1000;
  // |cost decrease| / cost, and the largest gradient entry. The meaning is that of
  // StoppingRules::decrement. Smaller values are below the rounding errors of the energy.
  double function_tolerance = 1e-12;
  double gradient_tolerance = 1e-12;
  // |step| / |x|; the default is about 100 unit roundoffs.
  double parameter_tolerance = 1e-14;
  StopCheck stop = {};  // polled at every residual block
};

class LeastSquaresMinimizer final : public Minimizer {
 public:
  // rest: constant shapes. Throws InvalidArgument if they are curved.
  LeastSquaresMinimizer(std::shared_ptr<const BezierTriangleSpace> space, RestShapes rest,
                        Quadrature rule, LeastSquaresOptions options);

  // Minimizes the mean symmetric Dirichlet energy with this rule, whatever the terms of `problem`
  // are. Only the fixed unknowns and the checkers of the problem are used. Ceres does not certify
  // paths: a step that leaves the feasible set ends the solve with Stalled, at the last feasible
  // point. Throws InvalidArgument if constraints do more than fix unknowns.
  SolveResult minimize(const Problem& problem, Vec y0, RunObserver* observer) const override;

 private:
  std::shared_ptr<const BezierTriangleSpace> space_;
  RestShapes rest_;
  Quadrature rule_;
  LeastSquaresOptions options_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
