#include "majorant/framework/barrier_minimizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/barrier_path.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/error.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/internal/colored_batches.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"

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

// The violation of bounds (violation.h) is minimized, and with it whatever else the problem has, of
// a weight that falls with the margin asked for: the penalty method of [NW06] Sec. 17.1.

// The room, relative to that of a bound or to 1, that the first round asks for: what bounds are
// relaxed by, too.
constexpr double kFirstMargin = 0.1;
// The factor of the margin from one round to the next.
constexpr double kMarginFall = 0.1;
// The last margin is 1e-9: less is not told from none.
constexpr int kMostRounds = 9;
// The relative change of a violation that is none, and the part of it that a margin may be, where
// it is called a minimum.
constexpr double kUnchanged = 0.01;
// The relative difference of two Hessians that is rounding.
constexpr double kHessianRounding = 1e-9;

constexpr const char* kNoProof = "; that is no proof that there is none, start inside";

// The bound that a point violates most, by how much, and where.
struct LargestViolation {
  const BarrierChecker* bound = nullptr;
  double amount = 0;
  std::string place;
};

std::string place_of(const EnergyTerm& term, Index element) {
  const ElementDofs& dofs = term.element_dofs();
  if (dofs.local_size() == 1) return fmt::format("unknown {}", dofs.nodes(element, 0));
  return fmt::format("element {}, which begins with unknown {}", element,
                     dofs.block * dofs.nodes(element, 0));
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
    if (!enter() || !has_start()) return std::move(result_);
    result_.energy = measure().energy;
    const double first = m_ > 0 ? options_.first_gap * scale() / m_ : 0;
    follow_barrier({first, options_.fall}, [this](double mu) { return minimize(mu); });
    return std::move(result_);
  }

 private:
  bool has_start() {
    if (check_start(stepper_.evaluator(), result_)) return true;
    if (bounds_.bounds().size() < barriers_.size())
      result_.message +=
          ": Bounds::interior() moves a start inside, BarrierMinimizer::of_bounds() leads it";
    return false;
  }

  double scale() const { return std::max(1.0, std::abs(result_.energy)); }

  int iterations_left() const {
    return options_.newton.stopping.max_iterations - static_cast<int>(result_.iterations.size());
  }

  bool is_barrier(TermId id) const {
    return std::find(barriers_.begin(), barriers_.end(), id) != barriers_.end();
  }

  // E and B here.
  BarrierPhase measure() const {
    const Vec x = problem_.expand(result_.y);
    BarrierPhase phase;
    for (const TermId id : problem_.terms())
      (is_barrier(id) ? phase.barrier : phase.energy) += term_energy(problem_, id, x);
    return phase;
  }

  // Leads the start to where the bounds are met.
  bool enter() {
    require_size("the start y", result_.y.size(), problem_.size());
    require_finite("the start y", result_.y);
    const Vec start = problem_.expand(result_.y);
    if (!bounds_.violated(start)) return true;
    result_.energy = measure().energy;
    const bool inside = measures_all(start) ? minimize_violation() : tighten();
    stepper_.reset(problem_);
    return inside;
  }

  bool went_on() const {
    return result_.status == Status::Converged || result_.status == Status::Stalled;
  }

  static const ViolationMeasure* measure_of(const BarrierChecker& bound) {
    return dynamic_cast<const ViolationMeasure*>(&bound);
  }

  bool measures_all(VecIn x) const {
    return std::all_of(bounds_.bounds().begin(), bounds_.bounds().end(), [&](const auto& bound) {
      return measure_of(*bound) || bound->check(x).feasible;
    });
  }

  // Leads inside by minima of the violation of all bounds that have a measure, met ones too: a
  // barrier of little weight lets a point creep along its bound. Others hold on the way.
  bool minimize_violation() {
    const double scale = this->scale(), mu = options_.first_gap * scale / m_;
    double before = std::numeric_limits<double>::infinity();
    bool no_room = false;
    LargestViolation left;
    for (int k = 0; k < kMostRounds && !no_room; ++k) {
      const double margin = kFirstMargin / std::pow(1 / kMarginFall, k);
      // The energy moves the minimum out by about half its weight times the multiplier of the
      // bound, which is less than the margin from some round on.
      const double weight = margin * margin / kFirstMargin / scale;
      stepper_.reset(with_violations(margin, {weight, mu}));
      if (k == 0 && !check_start(stepper_.evaluator(), result_)) return false;
      descend({}, stepper_.evaluator().value(result_.y));
      left = largest_violation();
      if (left.bound && went_on()) {
        no_room = result_.status == Status::Converged && margin <= kUnchanged * left.amount &&
                  left.amount >= (1 - kUnchanged) * before && is_convex_here();
        before = left.amount;
        continue;
      }
      result_.energy = measure().energy;
      if (left.bound) result_.message += "; the point violates " + words_of(left);
      return !left.bound && went_on();
    }
    const std::string where = words_of(left) + held_back_by(*left.bound);
    if (no_room)
      refuse(*left.bound, Status::Infeasible,
             "no point meets the bounds, or none nearby if they are not convex: their smallest "
             "violation is that of " +
                 where);
    else
      refuse(*left.bound, Status::Stalled,
             "no point was found that meets the bounds: the last one violates " + where + kNoProof);
    return false;
  }

  static std::string words_of(const LargestViolation& v) {
    return fmt::format("'{}' by {:.3g} at {}", v.bound->name(), v.amount, v.place);
  }

  // Leads inside by relaxed bounds that are tightened, which needs no measure.
  bool tighten() {
    const auto point = [this] { return problem_.expand(result_.y); };
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
      return went_on();
    };
    const Entry entry = enter_bounds(bounds_, rules, point, descend);
    if (entry == Entry::Inside) return true;
    if (entry == Entry::Outside) {
      const BarrierChecker& violated = *bounds_.violated(point());
      refuse(violated, Status::Stalled,
             fmt::format("no point was found that meets the bound '{}'{}{}", violated.name(),
                         held_back_by(violated), kNoProof));
    }
    result_.energy = measure().energy;
    const BarrierChecker* const violated = bounds_.violated(point());
    if (violated && entry != Entry::Outside)
      result_.message += fmt::format("; the point violates '{}'", violated->name());
    return false;
  }

  // The way inside has ended without one.
  void refuse(const BarrierChecker& violated, Status status, std::string why) {
    result_.status = status;
    result_.message = std::move(why);
    result_.blocking = violated.check(problem_.expand(result_.y)).blocking;
    result_.energy = measure().energy;
  }

  // What else limits the point: other bounds that it violates, else the checker that it is nearest
  // to.
  std::string held_back_by(const BarrierChecker& violated) const {
    const Vec x = problem_.expand(result_.y);
    const FeasibilityChecker* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& checker : problem_.checkers()) {
      const double margin = checker.get() == &violated ? least : checker->check(x).margin;
      if (!(margin < least)) continue;
      least = margin;
      nearest = checker.get();
    }
    return nearest ? fmt::format(", held back by '{}'", nearest->name()) : "";
  }

  LargestViolation largest_violation() const {
    const Vec x = problem_.expand(result_.y);
    LargestViolation largest;
    for (const auto& bound : bounds_.bounds()) {
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

  // True where the stepper's problem, without the energy, has a Hessian whose parts are all
  // semidefinite.
  bool is_convex_here() const {
    TermChanges changes;
    for (const TermId id : problem_.terms()) {
      if (is_barrier(id)) continue;
      changes.emplace_back(id, problem_.state(id));
      changes.back().second.weight = 0;
    }
    const Problem problem = stepper_.evaluator().problem().with(std::move(changes));
    if (!problem.supports(Curvature::Exact) || !problem.supports(Curvature::Projected))
      return false;
    Evaluator evaluator(problem);
    Vec gradient, exact, projected;
    evaluator.linearize(result_.y, Curvature::Exact, gradient, exact);
    evaluator.linearize(result_.y, Curvature::Projected, gradient, projected);
    return (exact - projected).norm() <= kHessianRounding * projected.norm();
  }

  struct RestWeights {
    double energy, barrier;  // that of a barrier is the product of both
  };
  // The problem with the violation in place of the bounds that have one, and these weights for the
  // rest.
  Problem with_violations(double margin, const RestWeights& rest) const {
    std::vector<std::pair<TermId, std::shared_ptr<const EnergyTerm>>> terms;
    auto checkers = problem_.checkers();
    std::vector<TermId> measured;
    for (std::size_t k = 0; k < bounds_.bounds().size(); ++k) {
      const auto& bound = bounds_.bounds()[k];
      if (!measure_of(*bound)) continue;
      measured.push_back(barriers_[k]);
      terms.emplace_back(barriers_[k], measure_of(*bound)->violation(margin));
      std::erase(checkers, bound);
    }
    TermChanges changes;
    for (const TermId id : problem_.terms()) {
      if (std::find(measured.begin(), measured.end(), id) != measured.end()) continue;
      changes.emplace_back(id, problem_.state(id));
      changes.back().second.weight *= rest.energy * (is_barrier(id) ? rest.barrier : 1);
    }
    return problem_.exchanged(terms, std::move(checkers)).with(std::move(changes));
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

  PathEnd minimize(double mu) {
    const bool last = m_ * mu <= options_.tolerance * scale();
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
    if (last) return PathEnd::Arrived;
    return went_on() ? PathEnd::None : PathEnd::Ended;
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
