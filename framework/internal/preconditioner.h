// A factored symmetric positive definite matrix M, the metric of first-order methods: the Hessian
// of a Problem at a point, under a curvature model.
//
//   Preconditioner metric(problem, Curvature::Projected, make_direct_solver());
//   Vec g, p;
//   Evaluator(problem).gradient(y0, g);
//   if (metric.factorize(y0)) metric.solve(-g, p);   // p = -M^-1 g
//
// Factorized once, used for many directions. Newton's method does not need it (newton.h).
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"

namespace majorant {

class Preconditioner {
 public:
  // Analyses the pattern of `problem`. Throws InvalidArgument unless it supports `curvature`.
  Preconditioner(const Problem& problem, Curvature curvature, std::shared_ptr<LinearSolver> solver);

  // Assembles the Hessian at y, size() entries, and factorizes it with the smallest shift that
  // works (factorize_shifted). Returns false if that fails; solve() must not be called then. Throws
  // Stopped.
  bool factorize(VecIn y, const StopCheck& stop = {});
  // Factorizes at the first call alone, and adds the costs of that to `record`; writes curvature
  // and shift to `record` at every call. Returns false if there is no metric.
  bool factorize_once(VecIn y, IterationRecord& record, const StopCheck& stop);
  // The reason why a factorization failed, in words. Collective.
  std::string why_none() const;
  // Computes p = M^-1 r, size() entries each; only after factorize() or factorize_once() returned
  // true.
  void solve(const Vec& r, Vec& p) { solver_->solve(r, p, kPreconditionerTolerance); }

  Curvature curvature() const { return curvature_; }
  double shift() const { return shift_; }  // in M = H + shift I
  const LinearSolver& linear_solver() const { return *solver_; }

 private:
  Evaluator evaluator_;
  Curvature curvature_;
  std::shared_ptr<LinearSolver> solver_;
  Vec gradient_, hessian_;
  double shift_ = 0;
  bool factorized_ = false;
  int factorizations_ = 0, failed_factorizations_ = 0;   // of the last factorize()
  double assemble_seconds_ = 0, factorize_seconds_ = 0;  // of the last factorize()
};

// Returns the problem whose Hessian is the metric: `metric` if there is one, otherwise `problem`.
// Throws InvalidArgument unless both have the same full unknowns and the same Z of x = Z y + c.
const Problem& preconditioner_problem(const Problem& problem, const std::optional<Problem>& metric);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
