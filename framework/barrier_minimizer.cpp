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

using Bounds = BarrierProblem::Bounds;

// The bounds themselves, with one weight for all barriers.
BarrierStage of_bounds_themselves(const Bounds& bounds, double mu) {
  BarrierStage stage;
  stage.other_barriers = mu;
  for (const auto& bound : bounds) stage.bounds.push_back({bound, bound->barrier(), mu});
  return stage;
}

const ViolationMeasure* measure_of(const BarrierChecker& bound) {
  return dynamic_cast<const ViolationMeasure*>(&bound);
}

// A problem that stays as it is, but for what stands in place of its bounds.
class FixedProblem final : public BarrierProblem {
 public:
  FixedProblem(const Problem& problem, const std::vector<TermId>& barriers, Bounds bounds,
               const NewtonOptions& options, Vec y0, RunObserver* observer)
      : problem_(problem),
        barriers_(barriers),
        bounds_(std::move(bounds)),
        most_iterations_(options.stopping.max_iterations),
        observer_(observer),
        stepper_(problem, options),
        y_(std::move(y0)) {
    if (!partition_of(problem).is_whole())
      throw InvalidArgument(
          "BarrierMinimizer: the problem is that of several processes, it knows one");
    require_size("the start y", y_.size(), problem_.size());
    require_finite("the start y", y_);
    for (const TermId id : barriers_) m_ += element_weights(problem_, id);
  }

  const Bounds& bounds() const override { return bounds_; }
  Evaluator& evaluator() override { return stepper_.evaluator(); }
  std::vector<TermId> barriers() const override { return barriers_; }
  Vec y() const override { return y_; }
  Vec point() const override { return problem_.expand(y_); }
  double barrier_size(const BarrierStage&, std::span<const BarrierPhase>) const override {
    return m_;
  }

  BarrierEnergies energies() const override {
    const Vec x = problem_.expand(y_);
    BarrierEnergies sum;
    for (const TermId id : problem_.terms())
      (is_barrier(id) ? sum.barrier : sum.energy) += term_energy(problem_, id, x);
    return sum;
  }

  void enter(const BarrierStage& stage) override {
    std::vector<std::pair<TermId, std::shared_ptr<const EnergyTerm>>> terms;
    auto checkers = problem_.checkers();
    for (std::size_t k = 0; k < bounds_.size(); ++k) {
      const BarrierStage::Bound& instead = stage.bounds[k];
      if (instead.checker == bounds_[k]) continue;
      terms.emplace_back(barriers_[k], instead.term);
      if (instead.checker)
        std::replace(checkers.begin(), checkers.end(),
                     std::shared_ptr<const FeasibilityChecker>(bounds_[k]),
                     std::shared_ptr<const FeasibilityChecker>(instead.checker));
      else
        std::erase(checkers, bounds_[k]);
    }
    TermChanges changes;
    for (const TermId id : problem_.terms())
      changes.emplace_back(id,
                           TermChange{.weight = problem_.state(id).weight * weight_of(id, stage)});
    const Problem problem =
        terms.empty() ? problem_ : problem_.exchanged(terms, std::move(checkers));
    stepper_.reset(problem.with(std::move(changes)));
  }

  SolveResult descend(StoppingRules rules) override {
    rules.max_iterations = std::min(rules.max_iterations, most_iterations_ - taken_);
    Directive directive = Directive::Continue;  // the last answer
    StepObserver numbered([&](const TraceEntry& row, const Vec& y) {
      IterationRecord record = row.record;
      record.iteration += taken_;  // they count through all phases
      return directive = observed(observer_, record, y);
    });
    const double start = stepper_.evaluator().value(y_);
    SolveResult part = stepper_.descend_from(std::move(y_), start, rules, &numbered);
    if (directive != Directive::Continue) {  // also where the phase had ended anyway
      part.status = stopped_status(directive);
      part.message = Stopped(directive).what();
    }
    taken_ += static_cast<int>(part.iterations.size());
    y_ = part.y;
    return part;
  }

 private:
  bool is_barrier(TermId id) const {
    return std::find(barriers_.begin(), barriers_.end(), id) != barriers_.end();
  }

  double weight_of(TermId id, const BarrierStage& stage) const {
    const auto place = static_cast<std::size_t>(std::find(barriers_.begin(), barriers_.end(), id) -
                                                barriers_.begin());
    if (place == barriers_.size()) return stage.energy;
    return place < bounds_.size() ? stage.bounds[place].weight : stage.other_barriers;
  }

  const Problem& problem_;
  const std::vector<TermId>& barriers_;
  const Bounds bounds_;
  const int most_iterations_;
  RunObserver* observer_;
  NewtonStepper stepper_;
  Vec y_;
  double m_ = 0;
  int taken_ = 0;
};

// One run: the phases so far and the point they have reached.
class Phases {
 public:
  Phases(BarrierProblem& problem, const BarrierOptions& options)
      : problem_(problem), bounds_(problem.bounds()), options_(options) {
    result_.y = problem_.y();
  }

  BarrierResult run() {
    if (!enter() || !has_start()) return std::move(result_);
    result_.energy = problem_.energies().energy;
    // What was too weak on the way inside holds a point at the bounds on the path, too.
    const double first = std::max(first_weight(themselves(1)), entry_weight_);
    result_.end = follow_barrier({first, options_.fall, options_.most_phases},
                                 [this](double mu) { return minimize(mu); });
    if (result_.end == PathEnd::None) {
      result_.status = Status::Stalled;
      result_.message = fmt::format(
          "inside the bounds, but after {} weights of their barriers the energy still falls by "
          "{:.1e}",
          result_.phases.size(), left());
    }
    return std::move(result_);
  }

 private:
  BarrierStage themselves(double mu) const { return of_bounds_themselves(bounds_.bounds(), mu); }

  // Whether a stage can begin here.
  bool starts(const BarrierStage& stage) {
    problem_.enter(stage);
    result_.y = problem_.y();
    return check_start(problem_.evaluator(), result_);
  }

  bool has_start() {
    if (starts(themselves(1))) return true;
    if (bounds_.bounds().size() < problem_.barriers().size())
      result_.message +=
          ": Bounds::interior() moves a start inside, BarrierMinimizer::of_bounds() leads it";
    return false;
  }

  double scale() const { return std::max(1.0, std::abs(result_.energy)); }

  // The weight of the first gap; 0: no barrier.
  double first_weight(const BarrierStage& stage) {
    m_ = problem_.barrier_size(stage, {});
    return m_ > 0 ? options_.first_gap * scale() / m_ : 0;
  }

  // Leads the start to where the bounds are met.
  bool enter() {
    const Vec start = problem_.point();
    if (!bounds_.violated(start)) return true;
    result_.energy = problem_.energies().energy;
    return measures_all(start) ? minimize_violation() : tighten();
  }

  bool went_on() const {
    return result_.status == Status::Converged || result_.status == Status::Stalled;
  }

  bool measures_all(VecIn x) const {
    return std::all_of(bounds_.bounds().begin(), bounds_.bounds().end(), [&](const auto& bound) {
      return measure_of(*bound) || bound->check(x).feasible;
    });
  }

  // Leads inside by minima of the violation of all bounds that have a measure, met ones too: a
  // barrier of little weight lets a point creep along its bound. Others hold on the way.
  bool minimize_violation() {
    const double scale = this->scale();
    const double mu = first_weight(with_violations(kFirstMargin, {1, 1}));
    double before = std::numeric_limits<double>::infinity();
    bool no_room = false;
    LargestViolation left;
    for (int k = 0; k < kMostRounds && !no_room; ++k) {
      const double margin = kFirstMargin / std::pow(1 / kMarginFall, k);
      // The energy moves the minimum out by about half its weight times the multiplier of the
      // bound, which is less than the margin from some round on.
      const double weight = margin * margin / kFirstMargin / scale;
      const BarrierStage stage = with_violations(margin, {weight, mu});
      if (k == 0 && !starts(stage)) return false;
      if (k > 0) problem_.enter(stage);
      descend({});
      left = largest_violation();
      if (left.bound && went_on()) {
        no_room = result_.status == Status::Converged && margin <= kUnchanged * left.amount &&
                  left.amount >= (1 - kUnchanged) * before && is_convex_here();
        before = left.amount;
        continue;
      }
      result_.energy = problem_.energies().energy;
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
    const auto point = [this] { return problem_.point(); };
    double mu = 0;
    const auto descend = [&](double factor) {
      const bool is_first = mu == 0;
      if (is_first) mu = first_weight(relaxed(1));
      entry_weight_ = factor * mu;
      const BarrierStage stage = relaxed(entry_weight_);
      if (is_first && !starts(stage)) return false;
      if (!is_first) problem_.enter(stage);
      this->descend(brief_rules(0, options_.entry.tolerance));
      return went_on();
    };
    const Entry entry = enter_bounds(bounds_, options_.entry, point, descend);
    if (entry == Entry::Inside) return true;
    if (entry == Entry::Outside) {
      const BarrierChecker& violated = *bounds_.violated(point());
      refuse(violated, Status::Stalled,
             fmt::format("no point was found that meets the bound '{}'{}{}", violated.name(),
                         held_back_by(violated), kNoProof));
    }
    result_.energy = problem_.energies().energy;
    const BarrierChecker* const violated = bounds_.violated(point());
    if (violated && entry != Entry::Outside)
      result_.message += fmt::format("; the point violates '{}'", violated->name());
    return false;
  }

  // The way inside has ended without one.
  void refuse(const BarrierChecker& violated, Status status, std::string why) {
    result_.status = status;
    result_.message = std::move(why);
    result_.blocking = violated.check(problem_.point()).blocking;
    result_.energy = problem_.energies().energy;
  }

  // What else limits the point: other bounds that it violates, else the checker that it is nearest
  // to.
  std::string held_back_by(const BarrierChecker& violated) {
    const FeasibilityChecker* nearest = nullptr;
    double least = std::numeric_limits<double>::infinity();
    const auto look_at = [&](const FeasibilityChecker& checker, VecIn x) {
      const double margin = checker.check(x).margin;
      if (!(margin < least)) return;
      least = margin;
      nearest = &checker;
    };
    const Vec point = problem_.point();
    const auto& bounds = bounds_.bounds();
    for (const auto& bound : bounds)
      if (bound.get() != &violated) look_at(*bound, point);
    const Problem& problem = problem_.evaluator().problem();
    const Vec x = problem.expand(problem_.y());
    for (const auto& checker : problem.checkers())
      if (std::none_of(bounds.begin(), bounds.end(),
                       [&](const auto& bound) { return bound->name() == checker->name(); }))
        look_at(*checker, x);
    return nearest ? fmt::format(", held back by '{}'", nearest->name()) : "";
  }

  LargestViolation largest_violation() const {
    const Vec x = problem_.point();
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

  // True where the present problem, without the energy, has a Hessian whose parts are all
  // semidefinite.
  bool is_convex_here() {
    const std::vector<TermId> barriers = problem_.barriers();
    const Problem& present = problem_.evaluator().problem();
    TermChanges changes;
    for (const TermId id : present.terms())
      if (std::find(barriers.begin(), barriers.end(), id) == barriers.end())
        changes.emplace_back(id, TermChange{.weight = 0});
    const Problem problem = present.with(std::move(changes));
    if (!problem.supports(Curvature::Exact) || !problem.supports(Curvature::Projected))
      return false;
    Evaluator evaluator(problem);
    Vec gradient, exact, projected;
    const Vec y = problem_.y();
    evaluator.linearize(y, Curvature::Exact, gradient, exact);
    evaluator.linearize(y, Curvature::Projected, gradient, projected);
    return (exact - projected).norm() <= kHessianRounding * projected.norm();
  }

  struct RestWeights {
    double energy, barrier;  // that of a barrier is the product of both
  };
  // The violation in place of the bounds that have one, and these weights for the rest.
  BarrierStage with_violations(double margin, const RestWeights& rest) const {
    BarrierStage stage = themselves(rest.energy * rest.barrier);
    stage.energy = rest.energy;
    for (std::size_t k = 0; k < stage.bounds.size(); ++k)
      if (const ViolationMeasure* const measure = measure_of(*bounds_.bounds()[k]))
        stage.bounds[k] = {nullptr, measure->violation(margin), 1};
    return stage;
  }

  // What is held in place of the bounds.
  BarrierStage relaxed(double mu) const {
    BarrierStage stage = themselves(mu);
    for (std::size_t k = 0; k < stage.bounds.size(); ++k)
      stage.bounds[k] = {bounds_.held()[k], bounds_.barriers()[k], mu};
    return stage;
  }

  // What is left of E above its minimum by the last decrease; 0 before there is one.
  double left() const {
    if (result_.phases.size() < 2) return 0;
    const auto last = result_.phases.rbegin();
    return (last[1].energy - last[0].energy) * options_.fall / (1 - options_.fall);
  }

  PathEnd minimize(double mu) {
    if (!result_.phases.empty()) m_ = problem_.barrier_size(themselves(mu), result_.phases);
    const bool last = m_ * mu <= options_.tolerance * scale();
    problem_.enter(themselves(mu));
    StoppingRules rules = options_.newton.stopping;
    rules.scale = EnergyScale::Value;  // a phase begins near its minimum
    if (!last) {
      const double start = problem_.evaluator().value(problem_.y());
      rules = brief_rules(0, relative_to(start, options_.centred * m_ * mu));
    }
    BarrierPhase phase;
    phase.iterations = descend(rules);
    const BarrierEnergies here = problem_.energies();
    result_.energy = phase.energy = here.energy;
    phase.barrier = here.barrier;
    phase.mu = mu;
    phase.gap = m_ * mu;
    phase.status = result_.status;
    result_.phases.push_back(phase);
    if (!went_on()) return PathEnd::Ended;
    // A rise says that the phase before had not come near its minimum, and nothing of what is left.
    const bool arrived = last && !(std::abs(left()) > options_.tolerance * scale());
    return arrived ? PathEnd::Arrived : PathEnd::None;
  }

  // Descends from where the run is and returns the number of iterations.
  int descend(StoppingRules rules) {
    rules.max_iterations = std::numeric_limits<int>::max();
    return append(problem_.descend(rules));
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

  BarrierProblem& problem_;
  HeldBounds bounds_;
  const BarrierOptions& options_;
  BarrierResult result_;
  double m_ = 0;
  double entry_weight_ = 0;  // the last one of relaxed bounds
};

void require_valid(const BarrierOptions& options) {
  const auto in_unit_interval = [](double value) { return value > 0 && value < 1; };
  if (!in_unit_interval(options.fall) || !(options.tolerance > 0) || !(options.first_gap > 0))
    throw InvalidArgument(
        "BarrierOptions: fall must be in (0, 1), tolerance and first_gap positive");
}

}  // namespace

BarrierMinimizer::BarrierMinimizer(std::vector<TermId> barriers, BarrierOptions options)
    : barriers_(std::move(barriers)), options_(std::move(options)) {
  require_valid(options_);
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
  BarrierProblem::Bounds bounds;
  for (const HeldBound& b : bounds_) bounds.push_back(b.bound);
  FixedProblem fixed(problem, barriers_, std::move(bounds), options_.newton, std::move(y0),
                     observer);
  return Phases(fixed, options_).run();
}

BarrierResult BarrierMinimizer::run(BarrierProblem& problem, const BarrierOptions& options) {
  require_valid(options);
  return Phases(problem, options).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
