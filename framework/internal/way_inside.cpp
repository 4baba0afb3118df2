#include "majorant/framework/internal/way_inside.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/element_values.h"
#include "majorant/framework/internal/colored_batches.h"
#include "majorant/framework/internal/equality_rows.h"

namespace majorant {
namespace {

// The room that the first round requires, relative to the limit of a bound or to 1. Bounds are
// relaxed by the same.
constexpr double kFirstMargin = 0.1;
// The factor of the margin from one round to the next.
constexpr double kMarginFall = 0.1;
// The last margin is 1e-9; rounding hides a smaller one.
constexpr int kMostRounds = 9;
// A violation counts as unchanged below this relative change. At a minimum of a violation, the
// margin may be at most this part of it.
constexpr double kUnchanged = 0.01;
// The relative difference of two Hessians that counts as rounding.
constexpr double kHessianRounding = 1e-9;

// After this many steps of a round, or changes of the pieces of a violation, relaxed bounds are
// tried, from the start and from the present point. Each trial multiplies the steps by kStepsRise.
// After kMostTrials trials a round may take any number of steps.
constexpr int kFirstSteps = 50;
constexpr int kStepsRise = 2;
constexpr int kMostTrials = 4;

constexpr const char* kNoProof = "; that is no proof that there is none, start inside";

// The bound that a point violates most, by how much, and where.
struct LargestViolation {
  const BarrierChecker* bound = nullptr;
  double amount = 0;
  std::string place;
};

std::string words_of(const LargestViolation& v) {
  return fmt::format("'{}' by {:.3g} at {}", v.bound->name(), v.amount, v.place);
}

const ViolationMeasure* measure_of(const BarrierChecker& bound) {
  return dynamic_cast<const ViolationMeasure*>(&bound);
}

bool measures_all(const BarrierRun& run, VecIn x) {
  const auto& bounds = run.bounds.bounds();
  return std::all_of(bounds.begin(), bounds.end(), [&](const auto& bound) {
    return measure_of(*bound) || bound->check(x).feasible;
  });
}

LargestViolation largest_violation(const BarrierRun& run) {
  const Vec x = run.problem.point();
  LargestViolation largest;
  for (const auto& bound : run.bounds.bounds()) {
    if (bound->check(x).feasible) continue;
    const auto term = measure_of(*bound)->violation(0);
    const Vec squares = element_values(*term, {}, ColoredBatches(term->element_dofs(), {}), x);
    Index element = 0;
    const double amount = std::sqrt(squares.maxCoeff(&element));
    if (!largest.bound || amount > largest.amount)
      largest = {bound.get(), amount, place_of(*term, element)};
  }
  return largest;
}

// Names the other limits of the point: violated bounds, or else the nearest checker.
std::string held_back_by(const BarrierRun& run, const BarrierChecker& violated) {
  const FeasibilityChecker* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  const auto look_at = [&](const FeasibilityChecker& checker, VecIn x) {
    const double margin = checker.check(x).margin;
    if (!(margin < least)) return;
    least = margin;
    nearest = &checker;
  };
  const Vec point = run.problem.point();
  const auto& bounds = run.bounds.bounds();
  for (const auto& bound : bounds)
    if (bound.get() != &violated) look_at(*bound, point);
  const Problem& problem = run.problem.evaluator().problem();
  const Vec x = problem.expand(run.problem.y());
  for (const auto& checker : problem.checkers())
    if (std::none_of(bounds.begin(), bounds.end(),
                     [&](const auto& bound) { return bound->name() == checker->name(); }))
      look_at(*checker, x);
  return nearest ? fmt::format(", held back by '{}'", nearest->name()) : "";
}

void refuse(BarrierRun& run, const BarrierChecker& violated, Status status, std::string why) {
  run.refuse(status, std::move(why));
  run.result.blocking = violated.check(run.problem.point()).blocking;
}

// Returns whether the violation in the present problem, without the energy, has a Hessian whose
// parts are all semidefinite.
bool is_convex_here(BarrierRun& run) {
  const std::vector<TermId> barriers = run.problem.barriers();
  const Problem& present = run.problem.evaluator().problem();
  TermChanges changes;
  for (const TermId id : present.terms())
    if (std::find(barriers.begin(), barriers.end(), id) == barriers.end())
      changes.emplace_back(id, TermChange{.weight = 0});
  const Problem problem = present.with(std::move(changes));
  if (!problem.supports(Curvature::Exact) || !problem.supports(Curvature::Projected)) return false;
  const Vec y = run.problem.y();
  Evaluator evaluator(problem);
  Vec gradient, exact, projected;
  evaluator.linearize(y, Curvature::Exact, gradient, exact);
  evaluator.linearize(y, Curvature::Projected, gradient, projected);
  return (exact - projected).norm() <= kHessianRounding * projected.norm();
}

struct RestWeights {
  double energy, barrier;  // the weight of a barrier is the product of both
};
// Returns the stage with violations in place of the bounds that measure theirs, and these weights.
BarrierStage with_violations(const BarrierRun& run, double margin, const RestWeights& rest) {
  BarrierStage stage = run.of_bounds(rest.energy * rest.barrier);
  stage.energy = rest.energy;
  for (std::size_t k = 0; k < stage.bounds.size(); ++k)
    if (const ViolationMeasure* const measure = measure_of(*run.bounds.bounds()[k]))
      stage.bounds[k] = {nullptr, measure->violation(margin), 1};
  return stage;
}

// Returns the stage that replaces the bounds.
BarrierStage relaxed(const BarrierRun& run, double mu) {
  BarrierStage stage = run.of_bounds(mu);
  for (std::size_t k = 0; k < stage.bounds.size(); ++k)
    stage.bounds[k] = {run.bounds.held()[k], run.bounds.barriers()[k], mu};
  return stage;
}

enum class Way { Inside, Outside, Slow };

// Minimizes the violation of all bounds that measure it, also of those that hold: a barrier of
// small weight lets a point creep along its bound. Other bounds hold on the way. The result is slow
// if a round has taken most_steps, as a point does that zigzags along an edge of the violation.
Way minimize_violation(BarrierRun& run, int most_steps) {
  const double scale = run.energy_scale();
  const double mu = run.first_weight(with_violations(run, kFirstMargin, {1, 1}));
  double before = std::numeric_limits<double>::infinity();
  bool no_room = false;
  LargestViolation left;
  for (int k = 0; k < kMostRounds && !no_room; ++k) {
    const double margin = kFirstMargin / std::pow(1 / kMarginFall, k);
    // The energy moves the minimum out by about half its weight times the multiplier of the bound.
    // From some round on this is less than the margin.
    const double weight = margin * margin / kFirstMargin / scale;
    const BarrierStage stage = with_violations(run, margin, {weight, mu});
    if (k == 0 && !run.starts(stage)) return Way::Outside;
    if (k > 0) run.problem.enter(stage);
    if (run.descend({}, most_steps) >= most_steps && run.result.status == Status::MaxIterations)
      return Way::Slow;
    left = largest_violation(run);
    if (left.bound && run.went_on()) {
      no_room = run.result.status == Status::Converged && margin <= kUnchanged * left.amount &&
                left.amount >= (1 - kUnchanged) * before && is_convex_here(run);
      before = left.amount;
      continue;
    }
    run.result.energy = run.problem.energies().energy;
    if (left.bound) run.result.message += "; the point violates " + words_of(left);
    return !left.bound && run.went_on() ? Way::Inside : Way::Outside;
  }
  const std::string where = words_of(left) + held_back_by(run, *left.bound);
  if (no_room)
    refuse(run, *left.bound, Status::Infeasible,
           "no point meets the bounds, or none nearby if they are not convex: their smallest "
           "violation is that of " +
               where);
  else
    refuse(run, *left.bound, Status::Stalled,
           "no point was found that meets the bounds: the last one violates " + where + kNoProof);
  return Way::Outside;
}

// Tightens relaxed bounds, which needs no measure. Returns the weight of the last barriers.
std::optional<double> tighten(BarrierRun& run) {
  const auto point = [&] { return run.problem.point(); };
  double mu = 0, weight = 0;
  const auto descend = [&](double factor) {
    const bool is_first = mu == 0;
    if (is_first) mu = run.first_weight(relaxed(run, 1));
    weight = factor * mu;
    const BarrierStage stage = relaxed(run, weight);
    if (is_first && !run.starts(stage)) return false;
    if (!is_first) run.problem.enter(stage);
    run.descend(brief_rules(0, run.options.entry.tolerance));
    return run.went_on();
  };
  const Entry entry = enter_bounds(run.bounds, run.options.entry, point, descend);
  if (entry == Entry::Inside) return weight;
  if (entry == Entry::Outside) {
    const BarrierChecker& violated = *run.bounds.violated(point());
    refuse(run, violated, Status::Stalled,
           fmt::format("no point was found that meets the bound '{}'{}{}", violated.name(),
                       held_back_by(run, violated), kNoProof));
  }
  run.result.energy = run.problem.energies().energy;
  const BarrierChecker* const violated = run.bounds.violated(point());
  if (violated && entry != Entry::Outside)
    run.result.message += fmt::format("; the point violates '{}'", violated->name());
  return {};
}

}  // namespace

std::optional<double> lead_inside(BarrierRun& run) {
  const Vec start = run.problem.point();
  if (!run.bounds.violated(start)) return 0.0;
  run.result.energy = run.problem.energies().energy;
  if (!measures_all(run, start)) return tighten(run);
  const BarrierProblem::Place first = run.problem.place();
  int most_steps = kFirstSteps;
  for (int k = 0; k < kMostTrials; ++k, most_steps *= kStepsRise) {
    const Way way = minimize_violation(run, most_steps);
    if (way == Way::Inside) return 0.0;
    if (way == Way::Outside) return {};
    std::vector<BarrierProblem::Place> starts{run.problem.place()};
    if (k == 0) starts.insert(starts.begin(), first);
    for (const BarrierProblem::Place& place : starts) {
      run.problem.return_to(place);
      run.result.energy = run.problem.energies().energy;
      if (const std::optional<double> weight = tighten(run)) return weight;
      if (run.result.status != Status::Stalled) return {};
    }
  }
  if (minimize_violation(run, std::numeric_limits<int>::max()) == Way::Inside) return 0.0;
  return {};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
