// Sensitivity (framework/sensitivity.h) of solutions some of whose unknowns lie on manifolds.
//
//   ManifoldProblemBuilder builder(3);
//   builder.on(unit_sphere(3), Cells{{0, 1, 2}});
//   const TermId wind = builder.add(linear_term("wind", Vec::Unit(3, 0)), 0.5);
//   builder.add(linear_term("weight", Vec::Unit(3, 2)), 1.0);
//   const ManifoldProblem problem = builder.build();
//   const ManifoldResult result = problem.minimize(Vec::Ones(3));
//   const ManifoldSensitivity s(problem, result);
//   const Vec dx = s.forward({.weights = {{wind, 1.0}}});           // tangent to the sphere
//   const Sensitivity::Derivative d = s.adjoint(Vec::Unit(3, 0));   // d.weights: of x_0
//
// Not for covariances, nor for rest positions of meshes.
#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "majorant/framework/sensitivity.h"
#include "majorant/framework/terms/manifold_problem.h"

namespace majorant {

// Members are those of Sensitivity, with x for its full unknowns.
class ManifoldSensitivity {
 public:
  // Throws as Sensitivity.
  ManifoldSensitivity(const ManifoldProblem& problem, const ManifoldResult& result,
                      SensitivityOptions options = {});
  // With barriers and equalities as they were in the last phase.
  ManifoldSensitivity(const ManifoldProblem& problem, const ManifoldBarrierResult& result,
                      SensitivityOptions options = {});

  Index row_count() const { return sensitivity_.row_count(); }
  const Vec& point() const { return point_; }
  double energy() const { return sensitivity_.energy(); }
  double error() const { return sensitivity_.error(); }
  double bias(const std::vector<TermId>& barriers) const { return sensitivity_.bias(barriers); }
  Vec forward(Sensitivity::Change change) const;
  Sensitivity::Derivative adjoint(const Vec& slope) const;

 private:
  struct OnChart;
  ManifoldSensitivity(const ManifoldProblem& problem, const Vec& x, const SolveResult& result,
                      const TermChanges& states, SensitivityOptions options);
  ManifoldSensitivity(const OnChart& at, SensitivityOptions options);

  Sensitivity sensitivity_;
  Eigen::SparseMatrix<double> slopes_;  // of x by the coordinates
  Vec point_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
