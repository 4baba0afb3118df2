#include "majorant/framework/comparison/internal/race.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <utility>

#include "majorant/framework/comparison/internal/watched_solver.h"
#include "majorant/framework/equality_term.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

constexpr double kOutside = std::numeric_limits<double>::infinity();
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// A point counts if every |g| of its equalities is at most this part of max(1, |g| at the start).
constexpr double kEqualityTolerance = 1e-6;

// A minimum may have this much negative curvature, relative to the mean diagonal: the rounding of
// the Hessian and of its factorization.
constexpr double kSaddle = 1e-8;
// A minimum may also have the negative curvature kRotations |g| / |x|, with g the remaining
// gradient. If the energy is invariant under rotations, their curvature is x.g / |x|^2; the factor
// allows for another centre.
constexpr double kRotations = 3;

bool is_equality(const Problem& problem, TermId id) {
  return dynamic_cast<const EqualityTerm*>(&problem.term(id)) != nullptr;
}

// Returns the problem without barriers, with equalities that only report their g.
Problem energy_alone(const ComparedProblem& compared) {
  TermChanges changes;
  for (const HeldBound& bound : compared.bounds)
    changes.emplace_back(bound.barrier, TermChange{.weight = 0});
  const Problem& problem = compared.problem;
  for (const TermId id : problem.terms()) {
    if (!is_equality(problem, id)) continue;
    Vec shows_g = Vec::Zero(problem.term(id).parameter_count());
    for (Index k = 0; k < shows_g.size(); k += 2) shows_g[k] = 1;
    changes.emplace_back(id, TermChange{.weight = 0, .parameters = std::move(shows_g)});
  }
  return problem.with(std::move(changes));
}

// Measures points in the unknowns that a method reports.
class PointMeasure {
 public:
  PointMeasure(const ComparedProblem& compared, const Vec& y0, const ComparisonOptions& options)
      : compared_(compared),
        options_(options),
        energy_(energy_alone(compared)),
        evaluator_(energy_),
        most_violation_(kEqualityTolerance * std::max(1.0, violation(full(y0)))) {}

  Vec full(const Vec& y) const { return compared_.manifolds ? y : energy_.expand(y); }

  ComparisonPoint at(const Vec& y) {
    ComparisonPoint point;
    const Vec x = full(y);
    PointValue value;
    if (options_.value_of) {
      value = options_.value_of(x);
      point.measure = value.value;
    }
    Vec coordinates = y;
    if (compared_.manifolds) evaluator_.reset(compared_.manifolds->around(x, &coordinates));
    point.energy = value.is_valid && holds(x) ? evaluator_.value(coordinates) : kOutside;
    point.gradient_norm = kUnknown;
    if (std::isfinite(point.energy) && !compared_.holds()) {
      Vec gradient;
      evaluator_.gradient(coordinates, gradient);
      point.gradient_norm = gradient.norm();
    }
    return point;
  }

 private:
  bool holds(const Vec& x) {
    if (compared_.manifolds) return true;  // no checkers beside them
    return violation(x) <= most_violation_ && !evaluator_.violation(x);
  }
  double violation(const Vec& x) const {
    double most = 0;
    if (!compared_.manifolds)
      for (const TermId id : energy_.terms())
        if (is_equality(energy_, id))
          for (const double g : element_values(energy_, id, x)) most = std::max(most, std::abs(g));
    return most;
  }

  const ComparedProblem& compared_;
  const ComparisonOptions& options_;
  Problem energy_;
  Evaluator evaluator_;
  double most_violation_;
};

class PointMeter final : public RunObserver {
 public:
  PointMeter(PointMeasure& measure, const ComparisonOptions& options)
      : measure_(measure), options_(options) {}

  void start(const Vec& y) {
    add(y, 0);
    resumed_ = Clock::now();
  }
  Directive after_step(const TraceEntry& row, const Vec& y) override {
    running_ += seconds_since(resumed_);
    add(y, row.record.step);
    resumed_ = Clock::now();
    return directive(running_);
  }
  // Ends the run at y. y differs from the last step if the method returns to an earlier point.
  void finish(const Vec& y, std::size_t iterations) {
    running_ += seconds_since(resumed_);
    const int steps = std::max(points.back().iteration, static_cast<int>(iterations));
    if (y.size() != last_.size() || y != last_) add(y, kUnknown);
    points.back().seconds = running_;
    points.back().iteration = steps;
  }
  // Returns a check for use between two points. It refers to this object.
  StopCheck stop() const {
    return StopCheck([this] { return directive(running_ + seconds_since(resumed_)); });
  }

  std::vector<ComparisonPoint> points;

 private:
  using Clock = std::chrono::steady_clock;
  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }
  Directive directive(double seconds) const {
    if (const Directive why = options_.stop(); why != Directive::Continue) return why;
    return seconds > options_.time_limit_seconds ? Directive::TimeLimit : Directive::Continue;
  }
  void add(const Vec& y, double step) {
    ComparisonPoint point = measure_.at(y);
    point.iteration = static_cast<int>(points.size());
    point.seconds = running_;
    point.step = step;
    points.push_back(point);
    last_ = y;
  }

  PointMeasure& measure_;
  const ComparisonOptions& options_;
  double running_ = 0;
  Clock::time_point resumed_ = Clock::now();
  Vec last_;
};

// The result of a minimizer, with the final states of a run along barriers.
struct Outcome {
  SolveResult result;
  TermChanges states;
};

Outcome minimized(const Minimizer& minimizer, const ComparedProblem& compared, const Vec& y0,
                  RunObserver& observer) {
  if (const auto* barrier = dynamic_cast<const BarrierMinimizer*>(&minimizer)) {
    BarrierResult result = barrier->run(compared.problem, y0, &observer);
    TermChanges states = result.states;
    return {std::move(result), std::move(states)};
  }
  return {minimizer.minimize(compared.problem, y0, &observer), {}};
}

// Adds up factorizations and seconds by part. A library with its own linear solver reports no
// parts, and its records may include the time of measuring.
void add_up(const SolveResult& result, const SolverUse& use, MethodRun& run) {
  for (const IterationRecord& record : result.iterations) {
    run.factorizations += record.factorizations;
    run.seconds.assemble += record.seconds.assemble;
    run.seconds.line_search += record.seconds.line_search;
  }
  run.seconds.factorize = use.factorize_seconds;
  run.seconds.solve = use.solve_seconds;
  if (use.factorizations > 0)
    run.factorizations = use.factorizations;
  else if (!result.iterations.empty())
    run.seconds = {kUnknown, kUnknown, kUnknown, kUnknown};
}

// Tests whether a run ended at a minimum. travelled: the distance from its start, in full unknowns.
Definite definite_end(const FinishedRun& finished, double travelled, const StopCheck& stop) {
  const Problem& problem = finished.problem;
  if (!problem.supports(Curvature::Exact)) return Definite::NotTested;
  try {
    Vec gradient, hessian;
    Evaluator(problem).linearize(finished.y, Curvature::Exact, gradient, hessian, stop);
    if (hessian.isZero(0)) return Definite::NotTested;  // no sign to test, as for x^4 at 0
    const double size = std::max(finished.run.x.norm(), travelled);
    const double rotations = size > 0 ? kRotations * gradient.norm() / size : 0;
    const auto solver = make_direct_solver();
    solver->analyze(problem.pattern());
    const FactorStatus status = solver->factorize_until(
        stop, hessian, kSaddle * mean_diagonal(problem.pattern(), hessian) + rotations);
    return status == FactorStatus::Ok ? Definite::Yes : Definite::No;
  } catch (const Stopped&) {
  } catch (const std::bad_alloc&) {
  }
  return Definite::NotTested;
}

// Describes the end of a run: its problem, y there, its gradient, and whether it is a minimum.
// start: in full unknowns.
void describe_end(const ComparedProblem& compared, const Outcome& outcome, const Vec& start,
                  const ComparisonOptions& options, FinishedRun& finished) {
  const SolveResult& result = outcome.result;
  finished.problem = compared.manifolds ? compared.manifolds->around(result.y, &finished.y)
                                        : compared.problem.with(outcome.states);
  if (!compared.manifolds) finished.y = result.y;
  const bool is_before_barriers = compared.holds() && outcome.states.empty();
  finished.has_end = std::isfinite(finished.run.points.back().energy) && !is_before_barriers;
  if (!finished.has_end) return;
  Vec gradient;
  Evaluator(finished.problem).gradient(finished.y, gradient);
  finished.gradient_norm = finished.run.points.back().gradient_norm = gradient.norm();
  const bool ended = result.status == Status::Converged || result.status == Status::Stalled;
  if (ended && finished.y.size() > 0)
    finished.run.definite = definite_end(finished, (finished.run.x - start).norm(), options.stop);
}

}  // namespace

FinishedRun race(const ComparisonMethod& method, const ComparedProblem& compared, const Vec& y0,
                 const ComparisonOptions& options) {
  FinishedRun finished{.run = {}, .problem = compared.problem, .y = {}};
  MethodRun& run = finished.run;
  run.method = method.name;
  if (method.obstacle) run.message = method.obstacle(compared);
  if (!run.message.empty()) {
    run.status = kNotApplicable;
    return finished;
  }
  const auto use = std::make_shared<SolverUse>();
  PointMeasure measure(compared, y0, options);
  PointMeter meter(measure, options);
  try {
    const MethodLimits limits{
        .tolerance = options.tolerance,
        .max_iterations = options.max_iterations,
        .stop = meter.stop(),
        .watched = [use](SolverFactory own) { return watched_solver(std::move(own), use); }};
    const std::unique_ptr<Minimizer> minimizer = method.make(compared, limits);
    meter.start(y0);
    const Outcome outcome = minimized(*minimizer, compared, y0, meter);
    const SolveResult& result = outcome.result;
    meter.finish(result.y, result.iterations.size());
    run.points = std::move(meter.points);
    finished.status = result.status;
    run.status = status_name(result.status);
    if (result.status != Status::Converged) run.message = result.message;
    add_up(result, *use, run);
    run.x = measure.full(result.y);
    describe_end(compared, outcome, measure.full(y0), options, finished);
  } catch (const std::bad_alloc&) {
    run.status = "failed";
    run.message = "out of memory";
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::Unsupported) throw;
    run.status = "failed";
    run.message = e.what();
  }
  return finished;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
