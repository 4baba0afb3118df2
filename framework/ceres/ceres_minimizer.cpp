#include "majorant/framework/ceres_minimizer.h"

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/internal/diagnosis.h"
#include "majorant/framework/internal/one_blas_thread.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"
#include "majorant/framework/residual_term.h"
#include "majorant/framework/stepper.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

using CeresSolver = ceres::GradientProblemSolver;

// The state of a run, which the function and the callback share.
struct Run {
  Run(const Problem& problem, const CeresOptions& o, RunObserver* observes)
      : evaluator(problem), options(o), observer(observes) {}

  // Records a point y that Ceres accepted. step: a multiple of Ceres' direction.
  void accept(const Vec& y, double step, IterationRecord r = {}) {
    r.iteration = static_cast<int>(result.iterations.size()) + 1;
    r.energy = evaluator.value(y);
    r.relative_decrease = relative_to(result.energy, result.energy - r.energy);
    r.step = step;
    r.gradient_norm = gradient_norm;
    r.trials = std::exchange(trials, 0);
    r.seconds.line_search = watch.restart();
    result.energy = r.energy;
    result.y = y;
    result.iterations.push_back(r);
    cut_short = std::exchange(refused, false);
    result.blocking = cut_short ? blocking : std::vector<Index>();
    directive = observed(observer, r, y);
  }
  // After an exception or a stop every trial point is refused, until Ceres gives up.
  bool is_over() const { return error || directive != Directive::Continue; }
  void keep_error(std::exception_ptr thrown) const { error = std::move(thrown); }
  // Returns whether result.y is stationary to the gradient tolerance of the options.
  bool is_flat() {
    Vec gradient;
    evaluator.gradient(result.y, gradient);
    return options.scale * gradient.lpNorm<Eigen::Infinity>() <= options.gradient_tolerance;
  }

  Evaluator evaluator;
  const CeresOptions& options;
  RunObserver* observer;
  SolveResult result;
  double gradient_norm = 0;  // at result.y
  int trials = 0;
  bool refused = false;         // a checker refused a trial point since the last accept()
  std::vector<Index> blocking;  // elements of the last refusal
  bool cut_short = false;       // `refused` at the last accepted step
  bool started = false;         // Ceres evaluated the start
  Directive directive = Directive::Continue;
  mutable std::exception_ptr error;  // of the caller's code
  Stopwatch watch;
};

class Function final : public ceres::FirstOrderFunction {
 public:
  explicit Function(Run& run) : run_(run) {}
  int NumParameters() const override { return run_.evaluator.problem().size(); }

  // No exception may pass through Ceres.
  bool Evaluate(const double* parameters, double* cost, double* gradient) const override {
    if (run_.is_over()) return false;
    try {
      return evaluate(parameters, cost, gradient);
    } catch (const Stopped& stopped) {
      run_.directive = stopped.why();
    } catch (...) {
      run_.error = std::current_exception();
    }
    return false;
  }

 private:
  bool evaluate(const double* parameters, double* cost, double* gradient) const {
    run_.options.stop.poll();
    const Problem& problem = run_.evaluator.problem();
    const Eigen::Map<const Vec> y(parameters, problem.size());
    ++run_.trials;
    if (!y.allFinite()) return false;
    const double energy = run_.evaluator.value(y, run_.options.stop);
    if (!std::isfinite(energy)) return false;
    const Vec x = problem.expand(y);
    if (auto violation = run_.evaluator.violation(x)) {
      run_.refused = true;
      run_.blocking = std::move(violation->verdict.blocking);
      return false;
    }
    *cost = run_.options.scale * energy;
    if (!gradient) return true;
    Vec g;
    run_.evaluator.gradient(y, g, run_.options.stop);
    Eigen::Map<Vec>(gradient, g.size()) = run_.options.scale * g;
    return g.allFinite();
  }

  Run& run_;
};

class Callback final : public ceres::IterationCallback {
 public:
  Callback(Run& run, const Vec& y) : run_(run), y_(y) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    try {
      if (run_.started) run_.accept(y_, s.step_size);
    } catch (...) {
      run_.error = std::current_exception();
    }
    run_.started = true;
    run_.trials = 0;
    run_.gradient_norm = s.gradient_norm / run_.options.scale;
    return run_.is_over() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  Run& run_;
  const Vec& y_;
};

// A point is a minimum unless a gradient step gains more than this part of the energy at the start.
// The value exceeds the rounding of energies that are sums over thousands of elements.
constexpr double kLeastGain = 1e-12;

// Returns whether a step along the negative gradient gains `least`. The steps tried range from the
// zero of the energy's linear model down to the rounding of y.
bool gains_along_gradient(Evaluator& evaluator, const Vec& y, double energy, double least) {
  Vec gradient;
  evaluator.gradient(y, gradient);
  double step = std::abs(energy) / gradient.squaredNorm();
  for (Vec trial; std::isfinite(step); step /= 2) {
    trial = y - step * gradient;
    if (trial == y) return false;
    if (evaluator.value(trial) < energy - least) return true;
  }
  return false;
}

void require_scale(const CeresOptions& o) {
  if (!(o.scale > 0) || !std::isfinite(o.scale))
    throw InvalidArgument("CeresOptions: scale must be positive");
}

CeresSolver::Options ceres_options(const CeresOptions& o) {
  CeresSolver::Options c;
  c.line_search_direction_type =
      o.method == CeresOptions::Method::Lbfgs ? ceres::LBFGS : ceres::NONLINEAR_CONJUGATE_GRADIENT;
  c.nonlinear_conjugate_gradient_type = ceres::POLAK_RIBIERE;
  c.max_lbfgs_rank = o.history;
  c.use_approximate_eigenvalue_bfgs_scaling = true;
  c.min_line_search_step_size = 1e-20;  // relative to the largest entry of the direction
  c.max_num_line_search_step_size_iterations = 60;
  c.max_num_iterations = o.max_iterations;
  c.function_tolerance = o.function_tolerance;
  c.gradient_tolerance = o.gradient_tolerance;
  c.parameter_tolerance = o.parameter_tolerance;
  c.logging_type = ceres::SILENT;
  c.update_state_every_iteration = true;
  std::string why;
  if (!c.IsValid(&why)) throw InvalidArgument("CeresOptions: " + why);
  require_scale(o);
  return c;
}

Status status_of(ceres::TerminationType type, Run& run) {
  if (type == ceres::NO_CONVERGENCE) return Status::MaxIterations;
  if (run.directive != Directive::Continue) return stopped_status(run.directive);
  if (type == ceres::FAILURE && !run.started) return Status::Failed;
  if (run.is_flat()) return Status::Converged;
  return type == ceres::CONVERGENCE && !run.cut_short ? Status::Converged : Status::Stalled;
}

// ------------------------------------------------------------------ least squares
// The unknowns y in blocks, one for each node. Ceres orders and assembles by blocks.
class Blocks {
 public:
  explicit Blocks(const SparsePattern& pattern) : block_(to_size(pattern.size)) {
    for (Index i = 0; i < pattern.size; ++i) {
      const bool begins = i == 0 || pattern.block_of.empty() ||
                          pattern.block_of[to_size(i)] != pattern.block_of[to_size(i - 1)];
      if (begins) starts_.push_back(i);
      block_[to_size(i)] = static_cast<Index>(starts_.size()) - 1;
    }
    starts_.push_back(pattern.size);
  }
  Index count() const { return static_cast<Index>(starts_.size()) - 1; }
  Index of(Index unknown) const { return block_[to_size(unknown)]; }
  Index start(Index block) const { return starts_[to_size(block)]; }
  int size(Index block) const { return static_cast<int>(start(block + 1) - start(block)); }

 private:
  std::vector<Index> starts_, block_;
};

// The point that Ceres evaluates, in full unknowns, and whether it is feasible.
struct Point {
  Vec x;
  bool is_usable = false;
};

// The residuals of one element, times a factor, as functions of the blocks on which they depend.
class ElementCost final : public ceres::CostFunction {
 public:
  ElementCost(const Problem& problem, TermId id, Index element, const Blocks& blocks, const Vec& x0,
              double factor, const Run& run, const Point& point)
      : term_(dynamic_cast<const ResidualTerm&>(problem.term(id))),
        state_(problem.state(id)),
        element_(element),
        factor_(factor),
        run_(run),
        point_(point) {
    const ElementDofs& dofs = problem.term(id).element_dofs();
    const Elimination& elimination = ProblemParts::elimination(problem);
    for (Index k = 0, local = 0; k < dofs.nodes.cols(); ++k)
      for (int c = 0; c < dofs.block; ++c, ++local)
        for (const auto& entry : elimination.row(dofs.block * dofs.nodes(element, k) + c)) {
          const Index block = blocks.of(entry.reduced);
          const auto found = std::find(blocks_.begin(), blocks_.end(), block);
          const auto place = static_cast<Index>(found - blocks_.begin());
          if (found == blocks_.end()) {
            blocks_.push_back(block);
            mutable_parameter_block_sizes()->push_back(blocks.size(block));
          }
          entries_.push_back(
              {local, place, entry.reduced - blocks.start(block), entry.coefficient});
        }
    Vec residuals;
    term_.residuals(x0, element, state_, residuals, nullptr);
    set_num_residuals(static_cast<int>(residuals.size()));
  }

  const std::vector<Index>& blocks() const { return blocks_; }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (!point_.is_usable || run_.is_over()) return false;
    Vec r;
    RowMatrix J;
    try {
      term_.residuals(point_.x, element_, state_, r, jacobians ? &J : nullptr);
    } catch (...) {
      run_.keep_error(std::current_exception());
      return false;
    }
    if (r.size() != num_residuals() || !r.allFinite()) return false;
    Eigen::Map<Vec>(residuals, r.size()) = factor_ * r;
    if (!jacobians) return true;
    const auto& sizes = parameter_block_sizes();
    for (std::size_t b = 0; b < sizes.size(); ++b)
      if (jacobians[b]) std::fill_n(jacobians[b], r.size() * sizes[b], 0.0);
    for (const Entry& entry : entries_) {
      double* const to = jacobians[entry.block];
      for (Index i = 0; to && i < r.size(); ++i)
        to[i * sizes[to_size(entry.block)] + entry.column] +=
            factor_ * entry.coefficient * J(i, entry.local);
    }
    return J.allFinite();
  }

 private:
  // The derivative of the element's unknown `local` with respect to an unknown of a block.
  struct Entry {
    Index local, block, column;
    double coefficient;
  };
  const ResidualTerm& term_;
  const TermState& state_;
  Index element_;
  double factor_;
  const Run& run_;
  const Point& point_;
  std::vector<Index> blocks_;
  std::vector<Entry> entries_;
};

// The loss rho of a term, times the weight of an element.
class WeightedLoss final : public ceres::LossFunction {
 public:
  WeightedLoss(const ResidualTerm& term, double weight) : term_(term), weight_(weight) {}
  void Evaluate(double s, double rho[3]) const override {
    const std::array<double, 3> own = term_.loss(s);
    for (std::size_t k = 0; k < 3; ++k) rho[k] = weight_ * own[k];
  }

 private:
  const ResidualTerm& term_;
  double weight_;
};

// Returns whether rho(s) = s for all s: a weight is then a factor of the residuals.
bool has_no_loss(const ResidualTerm& term) {
  for (const double s : {0.0, 1.0, 1e300})
    if (term.loss(s) != std::array<double, 3>{s, 1, 0}) return false;
  return true;
}

// Ceres announces every point before it asks for residuals there.
class Announced final : public ceres::EvaluationCallback {
 public:
  Announced(Run& run, const Vec& y, Point& point) : run_(run), y_(y), point_(point) {}
  void PrepareForEvaluation(bool, bool is_new) override {
    if (run_.is_over()) return;
    if (is_new) ++run_.trials;
    try {
      run_.options.stop.poll();
      if (is_new) visit();
    } catch (const Stopped& stopped) {
      run_.directive = stopped.why();
    } catch (...) {
      run_.error = std::current_exception();
    }
  }

 private:
  void visit() {
    point_.is_usable = y_.allFinite();
    if (!point_.is_usable) return;
    point_.x = run_.evaluator.problem().expand(y_);
    if (auto violation = run_.evaluator.violation(point_.x)) {
      point_.is_usable = false;
      run_.refused = true;
      run_.blocking = std::move(violation->verdict.blocking);
    }
  }
  Run& run_;
  const Vec& y_;
  Point& point_;
};

class TrustRegionCallback final : public ceres::IterationCallback {
 public:
  TrustRegionCallback(Run& run, const Vec& y) : run_(run), y_(y) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& s) override {
    try {
      if (run_.started) ++steps_;
      if (run_.started && s.step_is_successful) {
        IterationRecord r;
        r.shift = 1 / radius_;
        r.factorizations = std::exchange(steps_, 0);
        run_.accept(y_, 1, r);
      }
    } catch (...) {
      run_.error = std::current_exception();
    }
    if (!run_.started) run_.trials = 0;
    run_.started = true;
    radius_ = s.trust_region_radius;
    if (s.step_is_successful || s.iteration == 0)
      run_.gradient_norm = s.gradient_norm / run_.options.scale;
    return run_.is_over() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  Run& run_;
  const Vec& y_;
  int steps_ = 0;  // computed since the last accepted one
  double radius_ = 1;
};

ceres::Solver::Options trust_region_options(const CeresOptions& o) {
  ceres::Solver::Options c;
  c.minimizer_type = ceres::TRUST_REGION;
  c.trust_region_strategy_type =
      o.method == CeresOptions::Method::Dogleg ? ceres::DOGLEG : ceres::LEVENBERG_MARQUARDT;
  c.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  c.max_num_consecutive_invalid_steps = 50;  // outside a domain the region shrinks until a step is
                                             // inside
  c.max_num_iterations = o.max_iterations;
  c.function_tolerance = o.function_tolerance;
  c.gradient_tolerance = o.gradient_tolerance;
  c.parameter_tolerance = o.parameter_tolerance;
  c.logging_type = ceres::SILENT;
  c.update_state_every_iteration = true;
  c.num_threads = 1;
  std::string why;
  if (!c.IsValid(&why)) throw InvalidArgument("CeresOptions: " + why);
  require_scale(o);
  return c;
}

void require_squares(const Problem& problem) {
  for (const TermId id : problem.terms())
    if (!dynamic_cast<const ResidualTerm*>(&problem.term(id)))
      throw InvalidArgument(
          "CeresMinimizer: term '" + std::string(problem.term(id).name()) +
          "' is no sum of squares, which Levenberg-Marquardt and dogleg are for: make it by "
          "make_least_squares(), or choose another method");
}

void add_residuals(const Problem& problem, TermId id, const Blocks& blocks, const Vec& x0,
                   double scale, Vec& y, const Run& run, const Point& point, ceres::Problem& to) {
  const TermState& state = problem.state(id);
  const auto& term = dynamic_cast<const ResidualTerm&>(problem.term(id));
  const bool is_plain = has_no_loss(term);
  for (Index e = 0; e < problem.term(id).element_dofs().element_count(); ++e) {
    const double own = state.element_weight.size() > 0 ? state.element_weight[e] : 1;
    const double weight = scale * state.weight * own;
    if (weight == 0) continue;
    auto cost = std::make_unique<ElementCost>(problem, id, e, blocks, x0,
                                              is_plain ? std::sqrt(weight) : 1, run, point);
    if (cost->num_residuals() == 0 || cost->blocks().empty()) continue;
    std::vector<double*> parameters;
    for (const Index block : cost->blocks()) parameters.push_back(y.data() + blocks.start(block));
    to.AddResidualBlock(cost.release(), is_plain ? nullptr : new WeightedLoss(term, weight),
                        parameters);
  }
}

// Solves from run.result.y; the outcome is in run.
ceres::TerminationType solve_squares(const CeresOptions& settings, Run& run) {
  const Problem& problem = run.evaluator.problem();
  ceres::Solver::Options options = trust_region_options(settings);
  Vec y = run.result.y;
  Point point;
  Announced announced(run, y, point);
  ceres::Problem::Options ownership;
  ownership.evaluation_callback = &announced;
  ceres::Problem squares(ownership);
  const Blocks blocks(problem.pattern());
  for (Index b = 0; b < blocks.count(); ++b)
    squares.AddParameterBlock(y.data() + blocks.start(b), blocks.size(b));
  for (const TermId id : problem.terms())
    add_residuals(problem, id, blocks, problem.expand(y), settings.scale, y, run, point, squares);
  TrustRegionCallback callback(run, y);
  options.callbacks.push_back(&callback);
  ceres::Solver::Summary summary;
  {
    const OneBlasThread alone;  // sparse factorizations use CHOLMOD
    ceres::Solve(options, &squares, &summary);
  }
  if (run.error) std::rethrow_exception(run.error);
  // Ceres tests convergence before its callback, so the last step may be missing (as below).
  if (summary.termination_type == ceres::CONVERGENCE && y != run.result.y) run.accept(y, 1);
  if (run.refused) {
    run.cut_short = true;
    run.result.blocking = run.blocking;
  }
  run.result.message = summary.message;
  return summary.termination_type;
}

}  // namespace

SolveResult CeresMinimizer::minimize(const Problem& problem, Vec y0, RunObserver* observer) const {
  if (!partition_of(problem).is_whole())
    throw InvalidArgument(
        "CeresMinimizer: the problem is that of several processes, Ceres knows one; use "
        "NewtonMinimizer");
  const bool is_trust_region = options_.method == CeresOptions::Method::LevenbergMarquardt ||
                               options_.method == CeresOptions::Method::Dogleg;
  CeresSolver::Options options;
  if (is_trust_region) {
    require_squares(problem);
    trust_region_options(options_);
  } else {
    options = ceres_options(options_);
  }
  Run run(problem, options_, observer);
  run.result.y = std::move(y0);
  if (!check_start(run.evaluator, run.result)) return std::move(run.result);
  const double least = kLeastGain * std::abs(run.result.energy);
  if (problem.size() == 0) {
    run.result.status = Status::Converged;
    run.result.message = "no unknowns";
    return std::move(run.result);
  }
  if (is_trust_region) {
    run.result.status = status_of(solve_squares(options_, run), run);
    return std::move(run.result);
  }
  Vec y = run.result.y;
  Callback callback(run, y);
  options.callbacks.push_back(&callback);
  const ceres::GradientProblem function(new Function(run));  // owned by it
  CeresSolver::Summary summary;
  ceres::Solve(options, function, y.data(), &summary);
  if (run.error) std::rethrow_exception(run.error);
  // Ceres tests convergence before its callback, so the last step may be missing. If there was no
  // step, the search found nothing, and Ceres reports it as a function that changes little.
  const bool moved = y != run.result.y;
  if (summary.termination_type == ceres::CONVERGENCE && moved)
    run.accept(y, summary.iterations.empty() ? 0 : summary.iterations.back().step_size);
  if (run.refused) run.result.blocking = run.blocking;
  run.result.status = status_of(summary.termination_type, run);
  run.result.message = summary.message;
  if (run.result.status == Status::Converged && !moved && !run.is_flat() &&
      gains_along_gradient(run.evaluator, run.result.y, run.result.energy, least)) {
    run.result.status = Status::Stalled;
    run.result.message = "the last line search ended where it began";
  }
  // Ceres either reports convergence for an energy without a lower bound, or gives up.
  if (run.directive == Directive::Continue)
    if (std::string why = unbounded_along_gradient(run.evaluator, run.result.y, run.result.energy);
        !why.empty()) {
      run.result.status = Status::Failed;
      run.result.message = std::move(why);
    }
  return std::move(run.result);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
