#include "majorant/framework/ceres_minimizer.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <cmath>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/error.h"
#include "majorant/framework/internal/diagnosis.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/stepper.h"
#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

using CeresSolver = ceres::GradientProblemSolver;

// The function and the callback share this.
struct Run {
  Run(const Problem& problem, const CeresOptions& o, RunObserver* observes)
      : evaluator(problem), options(o), observer(observes) {}

  // Ceres accepted y; step: multiple of its direction.
  void accept(const Vec& y, double step) {
    IterationRecord r;
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
  // Returns whether result.y is stationary as far as Ceres was asked for.
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
  bool cut_short = false;       // `refused` as of the last accepted step
  bool started = false;         // Ceres evaluated the start
  Directive directive = Directive::Continue;
  std::exception_ptr error;  // of the caller's code
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

// A gradient step has to gain this part of the energy at the start for a point not to be a minimum.
// It is above the rounding of energies that are sums over thousands of elements.
constexpr double kLeastGain = 1e-12;

// Returns whether some step along the negative gradient gains `least`, from where the linear model
// of the energy reaches 0 down to the rounding of y.
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
  if (!(o.scale > 0) || !std::isfinite(o.scale))
    throw InvalidArgument("CeresOptions: scale must be positive");
  return c;
}

Status status_of(ceres::TerminationType type, Run& run) {
  if (type == ceres::NO_CONVERGENCE) return Status::MaxIterations;
  if (run.directive != Directive::Continue) return stopped_status(run.directive);
  if (type == ceres::FAILURE && !run.started) return Status::Failed;
  if (run.is_flat()) return Status::Converged;
  return type == ceres::CONVERGENCE && !run.cut_short ? Status::Converged : Status::Stalled;
}

}  // namespace

SolveResult CeresMinimizer::minimize(const Problem& problem, Vec y0, RunObserver* observer) const {
  if (!partition_of(problem).is_whole())
    throw InvalidArgument(
        "CeresMinimizer: the problem is that of several processes, Ceres knows one; use "
        "NewtonMinimizer");
  CeresSolver::Options options = ceres_options(options_);
  Run run(problem, options_, observer);
  run.result.y = std::move(y0);
  if (!check_start(run.evaluator, run.result)) return std::move(run.result);
  const double least = kLeastGain * std::abs(run.result.energy);
  if (problem.size() == 0) {
    run.result.status = Status::Converged;
    run.result.message = "no unknowns";
    return std::move(run.result);
  }
  Vec y = run.result.y;
  Callback callback(run, y);
  options.callbacks.push_back(&callback);
  const ceres::GradientProblem function(new Function(run));  // owned by it
  CeresSolver::Summary summary;
  ceres::Solve(options, function, y.data(), &summary);
  if (run.error) std::rethrow_exception(run.error);
  // Ceres calls back after its convergence tests: the last step is still to be told. Where there
  // is none a search found nothing, which Ceres takes for a function that changes little.
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
  // Ceres takes an energy that falls as far as doubles go for converged, or gives up.
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
