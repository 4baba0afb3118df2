#include "majorant/framework/barrier_minimizer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

double element_weights(const Problem& problem, TermId id) {
  const TermState& state = problem.state(id);
  const Vec& each = state.element_weight;
  const Index count = problem.term(id).stencils().element_count();
  return state.weight * (each.size() ? each.sum() : static_cast<double>(count));
}

// One run: the phases so far and the point they have reached.
class Phases {
 public:
  Phases(const Problem& problem, const std::vector<TermId>& barriers, const BarrierOptions& options,
         Vec y0, const Observer& observer)
      : problem_(problem),
        barriers_(barriers),
        options_(options),
        observer_(observer),
        stepper_(problem, options.newton) {
    if (!problem.partition().is_whole())
      throw InvalidArgument(
          "BarrierMinimizer: the problem is that of several processes, it knows one");
    result_.y = std::move(y0);
    for (const TermId id : barriers_) m_ += element_weights(problem_, id);
  }

  BarrierResult run() {
    if (!check_start(stepper_.evaluator(), result_)) return std::move(result_);
    result_.energy = measure().energy;
    double mu = m_ > 0 ? options_.first_gap * scale() / m_ : 0;
    for (;; mu *= options_.fall) {
      const bool last = m_ * mu <= options_.tolerance * scale();
      minimize(mu, last);
      const bool held = result_.status == Status::Stalled;
      if (last || (result_.status != Status::Converged && !held)) return std::move(result_);
    }
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

  void minimize(double mu, bool last) {
    TermChanges changes;
    for (const TermId id : barriers_) {
      changes.emplace_back(id, problem_.state(id));
      changes.back().second.weight *= mu;
    }
    stepper_.reset(problem_.with(std::move(changes)));
    const double start = stepper_.evaluator().value(result_.y);
    StoppingRules rules = options_.newton.stopping;
    if (!last) rules = brief_rules(0, relative_to(start, options_.centred * m_ * mu));
    rules.max_iterations = iterations_left();
    Directive directive = Directive::Continue;
    SolveResult part =
        stepper_.descend_from(std::move(result_.y), start, rules, numbered(directive));
    if (directive != Directive::Continue) {  // also where the phase had ended anyway
      part.status = stopped_status(directive);
      part.message = Stopped(directive).what();
    }
    append(std::move(part), mu);
  }

  // Iterations count through all phases. What it said last is kept.
  Observer numbered(Directive& said) {
    if (!observer_) return {};
    return [this, &said, before = static_cast<int>(result_.iterations.size())](
               const IterationRecord& record, const Vec& y) {
      IterationRecord numbered = record;
      numbered.iteration += before;
      return said = observer_(numbered, y);
    };
  }

  void append(SolveResult part, double mu) {
    const auto before = static_cast<int>(result_.iterations.size());
    for (IterationRecord& record : part.iterations) record.iteration += before;
    std::vector<IterationRecord> all = std::move(result_.iterations);
    all.insert(all.end(), part.iterations.begin(), part.iterations.end());
    const auto steps = static_cast<int>(part.iterations.size());
    static_cast<SolveResult&>(result_) = std::move(part);
    result_.iterations = std::move(all);
    BarrierPhase phase = measure();
    result_.energy = phase.energy;
    phase.mu = mu;
    phase.gap = m_ * mu;
    phase.iterations = steps;
    phase.status = result_.status;
    result_.phases.push_back(phase);
  }

  const Problem& problem_;
  const std::vector<TermId>& barriers_;
  const BarrierOptions& options_;
  const Observer& observer_;
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

BarrierResult BarrierMinimizer::run(const Problem& problem, Vec y0,
                                    const Observer& observer) const {
  for (auto id = barriers_.begin(); id != barriers_.end(); ++id)
    if (static_cast<std::size_t>(*id) >= problem.terms().size() ||
        std::find(barriers_.begin(), id, *id) != id)
      throw InvalidArgument("BarrierMinimizer: a barrier is no term of the problem, or twice");
  return Phases(problem, barriers_, options_, std::move(y0), observer).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
