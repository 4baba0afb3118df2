#include "majorant/framework/sensitivity.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <mutex>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/held_rows.h"
#include "majorant/framework/internal/polished_minimum.h"
#include "majorant/framework/internal/sensitivity_refusal.h"
#include "majorant/framework/internal/singular_matrix.h"
#include "majorant/framework/internal/term_derivatives.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/residual_term.h"

namespace majorant {
namespace {

// A larger part of a change's gradient along the null space is no rounding error.
constexpr double kAlongNullSpace = 1e-6;
// The rounding error of a sum of elements' gradients, relative to these.
constexpr double kRounding = 1e-10;

}  // namespace

class Sensitivity::Parts {
 public:
  Parts(const Problem& problem, const SolveResult& result, SensitivityOptions options)
      : options_(std::move(options)),
        minimum_(problem, result, options_),
        z_(ProblemParts::elimination(minimum_.problem())),
        terms_(minimum_.problem(), minimum_.y(), minimum_.x()),
        rows_(minimum_.problem(), minimum_.x()) {
    set_gauge();
  }

  Vec forward(const Change& change) {
    const std::lock_guard lock(mutex_);
    Vec full = Vec::Zero(problem().full_size()), rhs = Vec::Zero(problem().size()), fixed;
    double rounding = 0;  // by cancellation: a single term's gradient is 0 at the minimum
    if (change.right_hand_sides.size() > 0) {
      fixed = rows_.moved(change.right_hand_sides);
      full += rows_.curvature_of(fixed);
    }
    if (change.gradient.size() > 0) {
      require_size("Sensitivity: gradient", change.gradient.size(), problem().full_size());
      require_finite("Sensitivity: gradient", change.gradient);
      full += change.gradient;
    }
    for (const auto& [id, change_of] : change.weights) {
      require_finite("Sensitivity: weights", Vec::Constant(1, change_of));
      full += change_of * terms_.gradient(id);
      rounding += kRounding * std::abs(change_of) * terms_.gradients_norm(id);
    }
    for (const auto& [id, change_of] : change.element_weights)
      terms_.add_element_weights(id, change_of, full);
    for (const auto& [id, change_of] : change.parameters)
      terms_.add_parameters(id, change_of, full, rhs);
    Vec reduced;
    z_.restrict_gradient(full, reduced);
    rhs += reduced;
    Vec moved;  // the change of the equalities by fixed unknowns
    if (minimum_.equalities() && fixed.size() > 0) moved = -minimum_.equalities()->times(fixed);
    if (const double along = (minimum_.motions().transpose() * rhs).norm();
        along > kAlongNullSpace * rhs.norm() + rounding)
      refuse_sensitivity(
          "the change moves the solution along the null space, where it has no minimum");
    const Vec dy = minimum_.solve_held(-rhs, moved).p;
    Vec dx;
    z_.expand_direction(dy, dx);
    if (fixed.size() > 0) dx += fixed;
    if (gauge_.size() > 0) dx -= full_motions_ * gauge_of_motions_.solve(gauge_ * dx);
    return dx;
  }

  Derivative adjoint(Vec slope) {
    const std::lock_guard lock(mutex_);
    require_size("Sensitivity::adjoint: the slope", slope.size(), problem().full_size());
    require_finite("Sensitivity::adjoint: the slope", slope);
    if (gauge_.size() > 0)
      slope -= gauge_.transpose() * transposed_gauge_.solve(full_motions_.transpose() * slope);
    Vec reduced;
    z_.restrict_gradient(slope, reduced);
    const auto [u, q, _] = minimum_.solve_held(reduced, Vec());
    if (minimum_.equalities()) slope -= minimum_.equalities()->transposed_times(q);
    Derivative d;
    z_.expand_direction(u, d.adjoint_state);
    const Vec& ux = d.adjoint_state;
    for (const TermId id : problem().terms()) {
      d.weights.push_back(-terms_.gradient(id).dot(ux));
      d.element_weights.push_back(terms_.by_element_weights(id, ux));
      d.parameters.push_back(terms_.by_parameters(id, u, ux));
    }
    d.right_hand_sides = rows_.multipliers(slope, ux);
    return d;
  }

  double bias(const std::vector<TermId>& barriers) {
    Change away;
    for (const TermId id : barriers) away.weights.emplace_back(id, -problem().state(id).weight);
    const double distance = forward(away).norm(), size = point().norm();
    return size > 0 ? distance / size : distance;
  }

  Index row_count() const { return rows_.count(); }
  const Vec& point() const { return minimum_.x(); }
  double energy() const { return minimum_.energy(); }
  double error() const { return minimum_.error(); }

 private:
  const Problem& problem() const { return minimum_.problem(); }

  void set_gauge() {
    if (!options_.gauge) return;
    gauge_ = options_.gauge(problem(), minimum_.y());
    const auto count = static_cast<Index>(minimum_.motions().cols());
    if (gauge_.rows() != count || gauge_.cols() != problem().full_size() || !gauge_.allFinite())
      throw InvalidArgument(fmt::format(
          "SensitivityOptions: the gauge has {} rows of {} numbers, {} of {} finite ones hold the "
          "null space",
          gauge_.rows(), gauge_.cols(), count, problem().full_size()));
    if (count == 0) return;
    full_motions_.resize(problem().full_size(), count);
    Vec moved;
    for (Index k = 0; k < count; ++k) {
      z_.expand_direction(minimum_.motions().col(k), moved);
      full_motions_.col(k) = moved;
    }
    gauge_of_motions_.compute(gauge_ * full_motions_);
    transposed_gauge_.compute((gauge_ * full_motions_).transpose());
    if (!gauge_of_motions_.isInvertible())
      throw InvalidArgument("SensitivityOptions: the gauge leaves a motion of the null space free");
  }

  std::mutex mutex_;
  SensitivityOptions options_;
  PolishedMinimum minimum_;
  const Elimination& z_;
  TermDerivatives terms_;
  HeldRows rows_;
  Eigen::MatrixXd gauge_, full_motions_;
  Eigen::FullPivLU<Eigen::MatrixXd> gauge_of_motions_, transposed_gauge_;
};

Sensitivity::Sensitivity(const Problem& problem, const SolveResult& result,
                         SensitivityOptions options)
    : parts_(std::make_unique<Parts>(problem, result, std::move(options))) {}
Sensitivity::~Sensitivity() = default;
Sensitivity::Sensitivity(Sensitivity&&) noexcept = default;
Sensitivity& Sensitivity::operator=(Sensitivity&&) noexcept = default;

Index Sensitivity::row_count() const { return parts_->row_count(); }
const Vec& Sensitivity::point() const { return parts_->point(); }
double Sensitivity::energy() const { return parts_->energy(); }
double Sensitivity::error() const { return parts_->error(); }
double Sensitivity::bias(const std::vector<TermId>& barriers) const {
  return parts_->bias(barriers);
}

Vec Sensitivity::forward(const Change& change) const { return parts_->forward(change); }

Eigen::MatrixXd Sensitivity::forward(const std::vector<Change>& changes) const {
  Eigen::MatrixXd all(point().size(), static_cast<Index>(changes.size()));
  for (Index k = 0; k < all.cols(); ++k) all.col(k) = forward(changes[to_size(k)]);
  return all;
}

Sensitivity::Derivative Sensitivity::adjoint(const Vec& slope) const {
  return parts_->adjoint(slope);
}

std::vector<Sensitivity::Derivative> Sensitivity::adjoint(const Eigen::MatrixXd& slopes) const {
  std::vector<Derivative> all;
  for (Index k = 0; k < slopes.cols(); ++k) all.push_back(adjoint(Vec(slopes.col(k))));
  return all;
}

Eigen::MatrixXd covariance(const Problem& problem, const SolveResult& result,
                           const std::vector<Index>& unknowns) {
  const auto unsupported = [](const std::string& why) {
    throw Error(ErrorKind::Unsupported, "covariance: " + why);
  };
  if (partition_of(problem).ranks().count() > 1)
    throw InvalidArgument("covariance: the problem is that of several processes");
  require_size("covariance: result.y", result.y.size(), problem.size());
  for (const TermId id : problem.terms())
    if (!dynamic_cast<const ResidualTerm*>(&problem.term(id)))
      unsupported(fmt::format("term '{}' is no sum of squares", problem.term(id).name()));
  std::vector<DirectSolver::SparseColumn> columns;
  for (const Index i : unknowns) {
    if (i < 0 || i >= problem.full_size())
      throw InvalidArgument(fmt::format("covariance: unknown {} of {}", i, problem.full_size()));
    DirectSolver::SparseColumn& column = columns.emplace_back();
    for (const auto& e : ProblemParts::elimination(problem).row(i))
      column.emplace_back(e.reduced, e.coefficient);
    std::sort(column.begin(), column.end());
  }
  Vec gradient, values;
  Evaluator(problem).linearize(result.y, Curvature::Projected, gradient, values);
  const std::unique_ptr<DirectSolver> solver = make_direct_solver();
  solver->analyze(problem.pattern());
  if (!values.allFinite() || solver->factorize(values, 0) != FactorStatus::Ok ||
      is_singular(*solver, problem.pattern(), values))
    unsupported(
        "J^T J is singular: the residuals do not determine all unknowns; hold the others by "
        "constraints");
  return solver->inverse_products(problem.size(), columns);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
