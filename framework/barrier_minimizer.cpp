#include "majorant/framework/barrier_minimizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/barrier_path.h"
#include "majorant/framework/error.h"
#include "majorant/framework/partition.h"

namespace majorant {
namespace {

double element_weights(const Problem& problem, TermId id) {
  const TermState& state = problem.state(id);
  const Vec& each = state.element_weight;
  const Index count = problem.term(id).element_dofs().element_count();
  return state.weight * (each.size() ? each.sum() : static_cast<double>(count));
}

HeldBounds held(const std::vector<HeldBound>& bounds) {
  HeldBounds::Bounds all;
  for (const HeldBound& b : bounds) all.push_back(b.bound);
  return HeldBounds(std::move(all));
}

// One run: the phases so far and the point they have reached.
class Phases {
 public:
  Phases(const Problem& problem, const std::vector<TermId>& barriers,
         const std::vector<HeldBound>& bounds, const BarrierOptions& options, Vec y0,
         RunObserver* observer)
      : problem_(problem),
        barriers_(barriers),
        bounds_(held(bounds)),
        options_(options),
        observer_(observer),
        stepper_(problem, options.newton) {
    if (!partition_of(problem).is_whole())
      throw InvalidArgument(
          "BarrierMinimizer: the problem is that of several processes, it knows one");
    result_.y = std::move(y0);
    for (const TermId id : barriers_) m_ += element_weights(problem_, id);
  }

  BarrierResult run() {
    if (!enter() || !check_start(stepper_.evaluator(), result_)) return std::move(result_);
    result_.energy = measure().energy;
    const double first = m_ > 0 ? options_.first_gap * scale() / m_ : 0;
    follow_barrier({first, options_.fall}, [this](double mu) {
      const bool last = m_ * mu <= options_.tolerance * scale();
      minimize(mu, last);
      if (last) return PathEnd::Arrived;
      const bool goes_on = result_.status == Status::Converged || result_.status == Status::Stalled;
      return goes_on ? PathEnd::None : PathEnd::Ended;
    });
    return std::move(result_);
  }

 private:
  double scale() const { return std::max(1.0, std::abs(result_.energy)); }

  int iterations_left() const {
    return options_.newton.stopping.max_iterations - static_cast<int>(result_.iterations.size());
  }

  // E and B here.
  BarrierPhase measure() const {
    const Vec x = problem_.expand(result_.y);
    BarrierPhase phase;
    for (const TermId id : problem_.terms()) {
      const bool is_barrier = std::find(barriers_.begin(), barriers_.end(), id) != barriers_.end();
      (is_barrier ? phase.barrier : phase.energy) += term_energy(problem_, id, x);
    }
    return phase;
  }

  // Leads the start to where the bounds are met.
  bool enter() {
    require_size("the start y", result_.y.size(), problem_.size());
    require_finite("the start y", result_.y);
    const auto point = [this] { return problem_.expand(result_.y); };
    if (!bounds_.violated(point())) return true;
    result_.energy = measure().energy;
    const double mu = options_.first_gap * scale() / m_;
    const BoundEntryRules rules;
    bool checked = false;
    const auto descend = [&](double factor) {
      const Problem relaxed = with_held_bounds();
      stepper_.reset(relaxed);
      if (!checked && !check_start(stepper_.evaluator(), result_)) return false;
      checked = true;
      stepper_.reset(weighted(relaxed, factor * mu));
      this->descend(brief_rules(0, rules.tolerance), stepper_.evaluator().value(result_.y));
      return result_.status == Status::Converged || result_.status == Status::Stalled;
    };
    const Entry entry = enter_bounds(bounds_, rules, point, descend);
    stepper_.reset(problem_);
    if (entry == Entry::Outside) {
      const BarrierChecker& violated = *bounds_.violated(point());
      result_.status = Status::Infeasible;
      result_.message =
          fmt::format("no point was found that meets the bound '{}'", violated.name());
      result_.blocking = violated.check(point()).blocking;
    }
    if (entry != Entry::Inside) result_.energy = measure().energy;
    return entry == Entry::Inside;
  }

  // The problem with what is held in place of the bounds.
  Problem with_held_bounds() const {
    std::vector<std::pair<TermId, std::shared_ptr<const EnergyTerm>>> terms;
    auto checkers = problem_.checkers();
    for (std::size_t k = 0; k < bounds_.bounds().size(); ++k) {
      terms.emplace_back(barriers_[k], bounds_.barriers()[k]);
      for (auto& checker : checkers)
        if (checker == bounds_.bounds()[k]) checker = bounds_.held()[k];
    }
    return problem_.exchanged(terms, std::move(checkers));
  }

  Problem weighted(const Problem& problem, double mu) const {
    TermChanges changes;
    for (const TermId id : barriers_) {
      changes.emplace_back(id, problem.state(id));
      changes.back().second.weight *= mu;
    }
    return problem.with(std::move(changes));
  }

  void minimize(double mu, bool last) {
    stepper_.reset(weighted(problem_, mu));
    const double start = stepper_.evaluator().value(result_.y);
    StoppingRules rules = options_.newton.stopping;
    if (!last) rules = brief_rules(0, relative_to(start, options_.centred * m_ * mu));
    const int steps = descend(rules, start);
    BarrierPhase phase = measure();
    result_.energy = phase.energy;
    phase.mu = mu;
    phase.gap = m_ * mu;
    phase.iterations = steps;
    phase.status = result_.status;
    result_.phases.push_back(phase);
  }

  // Descends from where the run is and returns the number of iterations.
  int descend(StoppingRules rules, double start) {
    rules.max_iterations = iterations_left();
    Directive directive = Directive::Continue;  // the last answer
    StepObserver numbered([&, before = static_cast<int>(result_.iterations.size())](
                              const TraceEntry& row, const Vec& y) {
      IterationRecord record = row.record;
      record.iteration += before;  // they count through all phases
      return directive = observed(observer_, record, y);
    });
    SolveResult part = stepper_.descend_from(std::move(result_.y), start, rules, &numbered);
    if (directive != Directive::Continue) {  // also where the phase had ended anyway
      part.status = stopped_status(directive);
      part.message = Stopped(directive).what();
    }
    return append(std::move(part));
  }

  int append(SolveResult part) {
    const auto before = static_cast<int>(result_.iterations.size());
    for (IterationRecord& record : part.iterations) record.iteration += before;
    std::vector<IterationRecord> all = std::move(result_.iterations);
    all.insert(all.end(), part.iterations.begin(), part.iterations.end());
    const auto steps = static_cast<int>(part.iterations.size());
    static_cast<SolveResult&>(result_) = std::move(part);
    result_.iterations = std::move(all);
    return steps;
  }

  const Problem& problem_;
  const std::vector<TermId>& barriers_;
  HeldBounds bounds_;
  const BarrierOptions& options_;
  RunObserver* observer_;
  NewtonStepper stepper_;
  BarrierResult result_;
  double m_ = 0;
};

}  // namespace

BarrierMinimizer::BarrierMinimizer(std::vector<TermId> barriers, BarrierOptions options)
    : barriers_(std::move(barriers)), options_(std::move(options)) {
  const auto in_unit_interval = [](double value) { return value > 0 && value < 1; };
  if (!in_unit_interval(options_.fall) || !(options_.tolerance > 0) || !(options_.first_gap > 0))
    throw InvalidArgument(
        "BarrierOptions: fall must be in (0, 1), tolerance and first_gap positive");
}

BarrierMinimizer BarrierMinimizer::of_bounds(std::vector<HeldBound> bounds,
                                             std::vector<TermId> more, BarrierOptions options) {
  std::vector<TermId> barriers;
  for (const HeldBound& b : bounds) {
    require_given("BarrierMinimizer::of_bounds: a bound", b.bound);
    barriers.push_back(b.barrier);
  }
  barriers.insert(barriers.end(), more.begin(), more.end());
  BarrierMinimizer minimizer(std::move(barriers), std::move(options));
  minimizer.bounds_ = std::move(bounds);
  return minimizer;
}

BarrierResult BarrierMinimizer::run(const Problem& problem, Vec y0, RunObserver* observer) const {
  for (auto id = barriers_.begin(); id != barriers_.end(); ++id)
    if (static_cast<std::size_t>(*id) >= problem.terms().size() ||
        std::find(barriers_.begin(), id, *id) != id)
      throw InvalidArgument("BarrierMinimizer: a barrier is no term of the problem, or twice");
  for (const HeldBound& b : bounds_) {
    const auto& checkers = problem.checkers();
    if (std::find(checkers.begin(), checkers.end(), b.bound) == checkers.end())
      throw InvalidArgument(fmt::format(
          "BarrierMinimizer: the bound '{}' is none of the problem's checkers", b.bound->name()));
  }
  return Phases(problem, barriers_, bounds_, options_, std::move(y0), observer).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
