// A factored symmetric positive definite matrix M that first-order methods measure steps with: the
// Hessian of a Problem at a point, under a curvature model.
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
  // Analyses the pattern of `problem`, which has to support `curvature`, else
  // InvalidArgument.
  Preconditioner(const Problem& problem, Curvature curvature, std::shared_ptr<LinearSolver> solver);

  // Assembles the Hessian at y, size() entries, and factorizes it, shifted as little as it takes
  // (factorize_shifted). false when that fails, then solve() must not be called. Stopped.
  bool factorize(VecIn y, const StopCheck& stop = {});
  // Does so at the first call alone, whose costs `record` gets; curvature and shift it gets at
  // every call. false: there is no metric.
  bool factorize_once(VecIn y, IterationRecord& record, const StopCheck& stop);
  // The reason why a factorization failed, in words. Collective.
  std::string why_none() const;
  // p = M^-1 r, size() entries each; only after one of them returned true.
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
  double assemble_seconds_ = 0, factorize_seconds_ = 0;  // likewise
};

// The problem whose Hessian is the metric: `metric` if there is one, else `problem`. Throws
// InvalidArgument unless both have the same full unknowns and the same Z of x = Z y + c.
const Problem& preconditioner_problem(const Problem& problem, const std::optional<Problem>& metric);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
