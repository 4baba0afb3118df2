// The minimum of a problem to rounding, with the factor of the exact Hessian there.
//
//     PolishedMinimum minimum(problem, result, options);
//     const Vec p = minimum.solve_held(r, {}).p;   // H p = r
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/internal/equality_rows.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/sensitivity.h"

namespace majorant {

class PolishedMinimum {
 public:
  // Takes exact Newton steps from the result until the present factor is that of the minimum.
  // Throws the refusals of Sensitivity.
  PolishedMinimum(const Problem& problem, const SolveResult& result,
                  const SensitivityOptions& options);

  const Problem& problem() const { return problem_; }
  const Vec& y() const { return y_; }
  const Vec& x() const { return x_; }  // full unknowns
  double energy() const { return energy_; }
  double error() const { return error_; }  // an estimate of |y - y*| / |y|
  // The motions that the energy does not see, orthonormal columns.
  const Eigen::MatrixXd& motions() const { return motions_; }
  // Null where nothing but linear constraints holds.
  const EqualityRows* equalities() const { return rows_ ? &*rows_ : nullptr; }

  // Solves H p + A^T q = r and A p = s, A the derivative of the equalities; an empty s is 0.
  // Without equalities: H p = r. Motions are left out of r and p.
  SaddlePoint solve_held(const Vec& r, const Vec& s);

 private:
  enum class Factor { Definite, Indefinite, NotFinite };

  void require_usable(const SolveResult& result) const;
  void find_motions();
  Factor factorize();
  static void require_definite(Factor factor);
  void polish();
  void descend(const Vec& first);
  Vec solve(Vec r);
  void estimate_multipliers();

  Problem problem_;
  const Elimination& z_;
  Evaluator evaluator_;
  std::shared_ptr<LinearSolver> solver_;
  const SensitivityOptions& options_;
  Vec y_, x_, gradient_;
  double energy_ = 0, error_ = 0;
  bool is_singular_ = false;    // the factorized matrix
  std::vector<Index> stopped_;  // unknowns that are held against the motions in the factor
  Eigen::MatrixXd motions_;
  std::vector<TermId> equalities_;
  Vec multipliers_, penalties_;       // of all equalities
  std::optional<EqualityRows> rows_;  // at the point of the factor
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
