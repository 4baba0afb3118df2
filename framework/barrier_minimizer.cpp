#include "majorant/framework/barrier_minimizer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/barrier_path.h"
#include "majorant/framework/equality_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/augmented_lagrangian.h"
#include "majorant/framework/internal/barrier_run.h"
#include "majorant/framework/internal/fixed_barrier_problem.h"
#include "majorant/framework/internal/way_inside.h"
#include "majorant/framework/moving_chart.h"

namespace majorant {
namespace {

// The maximum number of descents that begin anew with larger penalties because the energy has no
// minimum with the present ones. Eight descents raise the penalties by 10^8.
constexpr int kMostBeginnings = 8;
// The maximum number of phases of a run with equalities; multipliers that settle need fewer.
constexpr int kMostEqualityPhases = 100;
// A phase is slow from this many steps on; each slow phase doubles that number. Far from the
// minimum Newton's method needs about one step for each mu by which the energy has to fall.
constexpr int kSlowSteps = 30, kSlowRise = 2;
// After a slow phase the barriers weigh at least this part of its gain, and this part of the cost
// of the equalities' penalties.
constexpr double kPhaseGainPart = 0.1, kPenaltyPart = 0.1;
// If the last step of a phase promised a decrease of more than kUncentred m mu, the phase has not
// come near its minimum: a curved bound cut the step short. The weight goes back at most
// kMostUncentred times for this reason.
constexpr double kUncentred = 1;
constexpr int kMostUncentred = 10;
// The maximum number of falls of the weight that one phase takes back.
constexpr int kMostRises = 8;
// The number of falls of the weight when a run begins anew.
constexpr int kFallsAnew = 3;

// The outer loop: phases in which the weights of barriers fall and multipliers settle. The weight
// rises again if the barriers are too weak for the decrease that a phase has to make.
class Phases {
 public:
  explicit Phases(BarrierRun& run) : run_(run), equalities_(run) {}

  BarrierResult go() {
    run_.result.multipliers = equalities_.multipliers();
    const std::optional<double> entry_weight = lead_inside(run_);
    if (!entry_weight || !has_start()) return std::move(run_.result);
    run_.result.energy = run_.problem.energies().energy;
    if (equalities_.has_rows() && !equalities_.begin()) return std::move(run_.result);
    start_ = run_.problem.place();
    // A weight that was too small on the way inside also holds points at the bounds on the path.
    first_weight_ = std::max(run_.first_weight(run_.of_bounds(1)), *entry_weight);
    BarrierResult& result = run_.result;
    result.end = PathEnd::None;
    for (int k = 0; k < run_.options.most_phases && result.end == PathEnd::None; ++k)
      result.end = minimize(weight());
    if (result.end == PathEnd::None) {
      result.status = Status::Stalled;
      result.message = fmt::format(
          "inside the bounds, but after {} weights of their barriers the energy still falls by "
          "{:.1e}",
          result.phases.size(), left());
    }
    if (result.status == Status::Converged && run_.options.newton.tests_minimum && may_move())
      equalities_.test_minimum();
    result.multipliers = equalities_.multipliers();
    result.violation = equalities_.violation();
    result.states = states();
    return std::move(result);
  }

 private:
  bool has_start() {
    if (run_.starts(run_.of_bounds(1))) return true;
    if (run_.bounds.bounds().size() < run_.problem.barriers().size())
      run_.result.message +=
          ": Bounds::interior() moves a start inside, BarrierMinimizer::of_bounds() leads it";
    return false;
  }

  // Returns the estimated excess of E over its minimum, by the last decrease; 0 before the first
  // one.
  double left() const {
    if (settled_.size() < 2) return 0;
    const auto last = settled_.rbegin();
    const double fall = run_.options.fall;
    return (last[1] - last[0]) * fall / (1 - fall);
  }

  // Returns the weight of the barriers after falls_ falls; exact if 1 / fall is an integer.
  double weight() const { return first_weight_ / std::pow(1 / run_.options.fall, falls_); }

  // Returns the number of falls after which m mu is below `cost`, rounded down.
  int falls_to(double cost) const {
    if (!(cost > 0)) return std::numeric_limits<int>::max();
    const double ratio = run_.barrier_size * first_weight_ / cost;
    return static_cast<int>(std::floor(std::log(ratio) / std::log(1 / run_.options.fall)));
  }

  PathEnd minimize(double mu) {
    BarrierResult& result = run_.result;
    const BarrierOptions& options = run_.options;
    most_falls_ = std::max(most_falls_, falls_);
    if (!result.phases.empty())
      run_.barrier_size = run_.problem.barrier_size(run_.of_bounds(mu), result.phases);
    const double m = run_.barrier_size;
    const bool last = m * mu <= options.tolerance * run_.energy_scale();
    BarrierPhase phase;
    phase.iterations = descend(mu, last);
    BarrierEnergies here = run_.problem.energies();
    result.energy = phase.energy = here.energy;
    phase.barrier = here.barrier;
    phase.mu = mu;
    phase.gap = m * mu;
    phase.status = result.status;
    result.phases.push_back(phase);
    if (is_slow_ || (is_uncentred(mu) && uncentred_++ < kMostUncentred)) {
      go_back();
      return PathEnd::None;
    }
    if (result.status == Status::Failed && !last && begin_anew()) return PathEnd::None;
    if (!run_.went_on()) return PathEnd::Ended;
    if (!meets_equalities(last)) {
      hold(last);
      return result.end;
    }
    ++falls_;
    settled_.push_back(result.energy);
    if (equalities_.has_rows() && m > 0 && settled_.size() < 2) return PathEnd::None;
    // If E has risen, the phase before had not come near its minimum, and left() is no estimate.
    const bool arrived = last && !(std::abs(left()) > options.tolerance * run_.energy_scale());
    if (arrived && result.status == Status::Converged && is_uncentred(mu)) {
      result.status = Status::Stalled;
      result.message = fmt::format(
          "inside the bounds, but the last step promised {:.1e} and was cut short: a bound is "
          "curved, or nearly nothing is inside",
          result.newton_decrement);
    }
    return arrived ? PathEnd::Arrived : PathEnd::None;
  }

  // Returns true if the predicted decrease of the last step is large relative to the barriers.
  bool is_uncentred(double mu) const {
    return may_move() && run_.went_on() && mu > 0 &&
           run_.result.newton_decrement > std::max(kUncentred * run_.barrier_size * mu,
                                                   run_.options.tolerance * run_.energy_scale());
  }

  // Raises the weight of the barriers after a slow phase, until E has to fall by a small part of
  // it.
  void go_back() {
    if (is_slow_) slow_steps_ *= kSlowRise;
    gain_ = std::max(gain_, run_.result.newton_decrement);
    settled_.clear();
    falls_ = std::clamp(falls_to(kPhaseGainPart * gain_), falls_ - kMostRises, falls_ - 1);
  }

  bool may_move() const { return run_.problem.may_move(); }

  // Begins anew with barriers that weigh less than any before, because E + mu B has no minimum (E
  // is flat, for example, and -log falls without end).
  bool begin_anew() {
    if (equalities_.has_rows() || !may_move()) return false;
    run_.return_to(start_);
    settled_.clear();
    falls_ = most_falls_ += kFallsAnew;
    return true;
  }

  // While multipliers move, the weight of the barriers rises with the penalties, by one fall in
  // each phase. It does not rise beside a violation that stays, because the minimum of barriers and
  // penalties does not move if both rise.
  void hold(bool last) {
    const int next = last ? falls_ : falls_ + 1;
    if (run_.barrier_size > 0)
      falls_ = std::clamp(falls_to(kPenaltyPart * equalities_.penalty_energy()),
                          equalities_.is_idle() ? falls_ : falls_ - 1, next);
  }

  // Runs one phase and returns the number of its steps.
  int descend(double mu, bool last) {
    const BarrierOptions& options = run_.options;
    const BarrierProblem::Place start = run_.problem.place();
    int steps = 0;
    for (int k = 0; k < kMostBeginnings; ++k) {
      run_.problem.enter(equalities_.stage(mu));
      StoppingRules rules = options.newton.stopping;
      // A phase begins near its minimum, except for the first phase of equalities alone.
      if (mu > 0 || !run_.result.phases.empty()) rules.scale = EnergyScale::Value;
      if (equalities_.has_rows()) {
        const double energy = std::abs(run_.problem.evaluator().value(run_.problem.y()));
        largest_energy_ = std::max(largest_energy_, energy);
        rules.energy_scale = largest_energy_;
        const double enough = relative_to(energy, options.centred * equalities_.penalty_energy());
        is_brief_ = last && enough > rules.relative_decrease;
        if (is_brief_) rules.relative_decrease = enough;
      }
      if (!last) {
        const double energy = run_.problem.evaluator().value(run_.problem.y());
        rules = brief_rules(
            0, relative_to(energy, options.centred * (may_move() ? 1 : run_.barrier_size) * mu));
      }
      const bool may_be_slow = run_.barrier_size * mu > 0;
      const int most = may_be_slow ? slow_steps_ : std::numeric_limits<int>::max();
      const double start_energy = may_be_slow ? run_.problem.evaluator().value(start.y) : 0;
      const int taken = run_.descend(rules, most);
      is_slow_ = taken == most && run_.result.status == Status::MaxIterations;
      gain_ = start_energy - run_.result.energy;
      steps += taken;
      if (run_.result.status != Status::Failed || !equalities_.has_rows()) break;
      equalities_.raise_penalties();
      run_.return_to(start);
    }
    return steps;
  }

  // Returns whether the path may go on to the next weight. If not, result.end is set if the path
  // has ended.
  bool meets_equalities(bool last) {
    if (!equalities_.has_rows()) return true;
    BarrierResult& result = run_.result;
    const auto progress = equalities_.after_phase(last, !is_brief_);
    BarrierPhase& phase = result.phases.back();
    phase.violation = equalities_.violation();
    result.end = progress == AugmentedLagrangian::Progress::Ended ? PathEnd::Ended : PathEnd::None;
    if (result.end == PathEnd::Ended) return false;
    result.energy = phase.energy = run_.problem.energies().energy;
    if (progress == AugmentedLagrangian::Progress::Met) return true;
    if (static_cast<int>(result.phases.size()) >= kMostEqualityPhases) {
      run_.refuse(Status::Stalled,
                  fmt::format("after {} phases the equalities are still violated by {:.1e}",
                              result.phases.size(), equalities_.violation()));
      result.end = PathEnd::Ended;
    }
    return false;
  }

  // Returns the states of barriers and equalities in the last phase.
  TermChanges states() const {
    const Problem& problem = run_.problem.evaluator().problem();
    TermChanges changes;
    for (const TermId id : run_.problem.barriers()) changes.emplace_back(id, problem.state(id));
    for (auto& change : equalities_.stage(0).equalities) changes.push_back(std::move(change));
    return changes;
  }

  BarrierRun& run_;
  AugmentedLagrangian equalities_;
  std::vector<double> settled_;  // E at each weight at which the equalities held
  double largest_energy_ = 0;    // the largest E at the begin of a phase with equalities
  bool is_brief_ = false;        // the phase ended before the energy had settled
  double first_weight_ = 0;
  int falls_ = 0, most_falls_ = 0;  // of the weight of the barriers
  BarrierProblem::Place start_;     // of the first phase
  int slow_steps_ = kSlowSteps;     // of a phase that counts as slow
  bool is_slow_ = false;            // the last phase was
  double gain_ = 0;                 // what it has gained
  int uncentred_ = 0;               // phases that went back without being slow
};

void require_valid(const BarrierOptions& options) {
  const auto in_unit_interval = [](double value) { return value > 0 && value < 1; };
  if (!in_unit_interval(options.fall) || !(options.tolerance > 0) || !(options.first_gap > 0) ||
      !(options.equality_tolerance > 0))
    throw InvalidArgument(
        "BarrierOptions: fall must be in (0, 1), tolerance, equality_tolerance and first_gap "
        "positive");
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
  MovingChart none;
  return run(problem, none, std::move(y0), observer);
}

BarrierResult BarrierMinimizer::run(const Problem& problem, MovingChart& chart, Vec y0,
                                    RunObserver* observer) const {
  for (auto id = barriers_.begin(); id != barriers_.end(); ++id) {
    if (static_cast<std::size_t>(*id) >= problem.terms().size() ||
        std::find(barriers_.begin(), id, *id) != id)
      throw InvalidArgument("BarrierMinimizer: a barrier is no term of the problem, or twice");
    if (dynamic_cast<const EqualityTerm*>(&problem.term(*id)))
      throw InvalidArgument(fmt::format("BarrierMinimizer: '{}' is an equality, no barrier",
                                        problem.term(*id).name()));
  }
  const MovingChart::Checkers checkers = chart.checkers(problem);
  for (const HeldBound& b : bounds_)
    if (std::find(checkers.begin(), checkers.end(), b.bound) == checkers.end())
      throw InvalidArgument(fmt::format(
          "BarrierMinimizer: the bound '{}' is none of the problem's checkers", b.bound->name()));
  BarrierProblem::Bounds bounds;
  for (const HeldBound& b : bounds_) bounds.push_back(b.bound);
  FixedBarrierProblem fixed(problem, chart, barriers_, std::move(bounds), options_.newton,
                            std::move(y0), observer);
  // The last phase is minimized as well as its barriers are small.
  BarrierOptions options = options_;
  double& decrease = options.newton.stopping.relative_decrease;
  decrease = std::min(decrease, options.tolerance);
  return BarrierMinimizer::run(fixed, options);
}

BarrierResult BarrierMinimizer::run(BarrierProblem& problem, const BarrierOptions& options) {
  require_valid(options);
  BarrierRun state(problem, options);
  return Phases(state).go();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
