#include "majorant/framework/internal/polished_minimum.h"

#include <fmt/format.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/option_check.h"
#include "majorant/framework/internal/sensitivity_refusal.h"
#include "majorant/framework/internal/singular_matrix.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

// An exact Newton step shorter than this part of |y| changes derivatives by less than the error of
// their solves.
constexpr double kPolished = 1e-9;
// A polishing step must be shorter than this part of the last one; quadratic convergence is faster.
constexpr double kContraction = 0.5;
// The number of steps with one factor: two steps take an error e to e^4.
constexpr int kStepsOfAFactor = 3;
// The largest accepted relative residual of the saddle point equations of equalities.
constexpr double kSaddleResidual = 1e-9;

}  // namespace

PolishedMinimum::PolishedMinimum(const Problem& problem, const SolveResult& result,
                                 const SensitivityOptions& options)
    : problem_(problem),
      z_(ProblemParts::elimination(problem_)),
      evaluator_(problem_),
      solver_(options.analysed_solver ? options.analysed_solver
                                      : make_solver("SensitivityOptions", options.linear_solver)),
      options_(options),
      y_(result.y),
      motions_(problem_.size(), 0),
      equalities_(equality_terms(problem_)) {
  require_usable(result);
  if (!equalities_.empty()) estimate_multipliers();
  if (!options_.analysed_solver) solver_->analyze(problem_.pattern());
  polish();
  if (is_singular_)
    refuse_sensitivity(
        "the exact Hessian of the solution is singular: the energy does not see some motion of "
        "the unknowns; hold it by constraints, or name it as null_space");
  x_ = problem_.expand(y_);
  if (const auto violation = evaluator_.violation(x_))
    refuse_sensitivity(fmt::format(
        "the minimum without '{}' violates it: what this checker holds back is no function of "
        "the data",
        violation->checker->name()));
}

void PolishedMinimum::require_usable(const SolveResult& result) const {
  if (partition_of(problem_).ranks().count() > 1)
    throw InvalidArgument("Sensitivity: the problem is that of several processes");
  require_size("Sensitivity: result.y", y_.size(), problem_.size());
  require_finite("Sensitivity: result.y", y_);
  if (options_.polishing_steps < 0)
    throw InvalidArgument("SensitivityOptions: polishing_steps is negative");
  if (result.status == Status::Failed || result.status == Status::Infeasible)
    refuse_sensitivity("there is no solution: " + result.message);
  if (!result.blocking.empty())
    refuse_sensitivity(fmt::format(
        "a checker holds the result back (at element {}): it is no function of the data there",
        result.blocking.front()));
  for (const TermId id : problem_.terms())
    if (!problem_.term(id).supports(Curvature::Exact))
      refuse_sensitivity(fmt::format("term '{}' has no exact Hessian", problem_.term(id).name()));
}

// Computes the motions at y_, orthonormal, and as many unknowns that hold them.
void PolishedMinimum::find_motions() {
  if (!options_.null_space) return;
  const Eigen::MatrixXd motions = options_.null_space(problem_, y_);
  require_size("SensitivityOptions: null_space", static_cast<Index>(motions.rows()),
               problem_.size());
  if (!motions.allFinite()) throw InvalidArgument("SensitivityOptions: null_space is not finite");
  motions_.resize(motions.rows(), 0);
  stopped_.clear();
  if (motions.size() == 0) return;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> rows(motions.transpose());
  for (Index k = 0; k < rows.rank(); ++k) stopped_.push_back(rows.colsPermutation().indices()[k]);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> columns(motions);
  motions_ = columns.householderQ() *
             Eigen::MatrixXd::Identity(motions.rows(), static_cast<Index>(columns.rank()));
}

PolishedMinimum::Factor PolishedMinimum::factorize() {
  find_motions();
  if (!equalities_.empty()) {
    // With these multipliers the augmented Lagrangian has the gradient of E + multipliers g and,
    // apart from A^T R A, its curvature.
    rows_.emplace(problem_, equalities_, problem_.expand(y_));
    const Vec beside = multipliers_ - penalties_.cwiseProduct(rows_->values());
    problem_ = problem_.with(equality_changes(problem_, equalities_, {beside, penalties_}));
    evaluator_.reset(problem_);
  }
  Vec values;
  energy_ = evaluator_.linearize(y_, Curvature::Exact, gradient_, values);
  if (!std::isfinite(energy_) || !values.allFinite() || !gradient_.allFinite())
    return Factor::NotFinite;
  const double stiffness = mean_diagonal(problem_.pattern(), values);
  for (const Index unknown : stopped_)
    values[problem_.pattern().diagonal_slot(unknown)] += stiffness;
  if (solver_->factorize(values, 0) != FactorStatus::Ok) return Factor::Indefinite;
  is_singular_ = is_singular(*solver_, problem_.pattern(), values);
  return Factor::Definite;
}

void PolishedMinimum::require_definite(Factor factor) {
  if (factor == Factor::NotFinite)
    refuse_sensitivity("the energy or its derivatives are not finite at the solution");
  if (factor == Factor::Indefinite)
    refuse_sensitivity(
        "the exact Hessian of the solution is indefinite: it is a saddle, no minimum, or the "
        "energy does not see some motion of the unknowns (hold it, or name it as null_space)");
}

// Takes exact Newton steps until the present factor is that of the minimum.
void PolishedMinimum::polish() {
  if (problem_.size() == 0) {
    energy_ = evaluator_.value(y_);
    return;
  }
  require_definite(factorize());
  double last = std::numeric_limits<double>::infinity();
  for (int k = 0;; ++k) {
    const auto [step, more, _] =
        solve_held(-gradient_, equalities_.empty() ? Vec() : Vec(-rows_->values()));
    const double length = step.norm(), size = y_.norm();
    error_ = size > 0 ? length / size : length;
    if (k == options_.polishing_steps || error_ <= kPolished || !(length <= kContraction * last))
      return;
    last = length;
    const Vec before = y_, multipliers_before = multipliers_;
    const double error_before = error_;
    if (equalities_.empty()) {
      descend(step);
    } else {
      y_ += step;
      multipliers_ += more;
    }
    const Factor found = factorize();
    if (found == Factor::NotFinite) {  // too far: the last point is the estimate
      y_ = before;
      multipliers_ = multipliers_before;
      require_definite(factorize());
      error_ = error_before;
      return;
    }
    require_definite(found);
  }
}

// Takes steps with the present factor as long as they contract. first: the first step.
void PolishedMinimum::descend(const Vec& first) {
  y_ += first;
  double last = first.norm();
  for (int k = 1; k < kStepsOfAFactor && last > kPolished * y_.norm(); ++k) {
    Vec gradient;
    if (!std::isfinite(evaluator_.gradient(y_, gradient)) || !gradient.allFinite()) return;
    const Vec step = -solve(gradient);
    if (!(step.norm() <= kContraction * last)) return;
    last = step.norm();
    y_ += step;
  }
}

Vec PolishedMinimum::solve(Vec r) {
  if (problem_.size() == 0) return Vec();
  Vec p;
  if (motions_.cols() > 0) r -= motions_ * (motions_.transpose() * r).eval();
  solver_->solve(r, p);
  if (motions_.cols() > 0) p -= motions_ * (motions_.transpose() * p).eval();
  return p;
}

SaddlePoint PolishedMinimum::solve_held(const Vec& r, const Vec& s) {
  if (!rows_) return {solve(r), Vec(), 0};
  SaddlePoint at =
      solve_with_equalities([this](const Vec& b) { return solve(b); }, z_, *rows_, penalties_, r,
                            s.size() > 0 ? s : Vec(Vec::Zero(rows_->count())));
  if (!(at.residual <= kSaddleResidual))
    refuse_sensitivity(
        fmt::format("the equalities, such as {}, contradict the change, or depend on each "
                    "other but for rounding",
                    rows_->name(0)));
  return at;
}

void PolishedMinimum::estimate_multipliers() {
  const EqualityState state = equality_state(problem_, equalities_);
  penalties_ = state.penalties;
  multipliers_ =
      state.multipliers +
      penalties_.cwiseProduct(EqualityRows(problem_, equalities_, problem_.expand(y_)).values());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
