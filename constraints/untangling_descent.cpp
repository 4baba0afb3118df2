#include "majorant/constraints/untangling_descent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/newton.h"

namespace majorant {
namespace {

// Passes over the values of eps. The second pass starts from the result of the first, again with a
// large eps.
constexpr int kPasses = 2;
// Values of eps in each pass. eps shrinks by at least half of kSmallestShrink each time, and
// 0.95^100 is 0.6 %.
constexpr int kRounds = 100;
// Upper bound on the Newton steps for one value of eps, which need not converge.
constexpr int kStepsPerRound = 10;
// The relative decrease that ends a round: an order below kSmallestShrink, by which eps changes.
constexpr double kRoundTolerance = 1e-2;
// The least fraction sigma by which eps shrinks [GKKPRS21].
constexpr double kSmallestShrink = 0.1;

class UntanglingDescent {
 public:
  UntanglingDescent(const Problem& problem, const std::vector<TermId>& energies,
                    const std::function<Verdict(VecIn x)>& judge, Vec y,
                    const UntanglingRules& rules, const StopCheck& stop)
      : problem_(problem),
        energies_(energies),
        judge_(judge),
        stop_(stop),
        stepper_(problem, newton_options(stop)),
        y_(std::move(y)),
        rules_(rules) {}

  UntangledPoint run() {
    update();
    for (int round = 0; round < kPasses * kRounds && !point_.verdict.feasible; ++round) {
      if (point_.iterations >= rules_.max_iterations) break;
      if (round % kRounds == 0) eps_ = rules_.first_eps;
      set_eps();
      const double before = stepper_.evaluator().value(y_);
      const double after = descend(before);
      update();
      if (stop_() != Directive::Continue) break;
      shrink(point_.verdict.margin, before, after);
    }
    return std::move(point_);
  }

 private:
  static NewtonOptions newton_options(const StopCheck& stop) {
    NewtonOptions options;
    options.stop = stop;
    options.blend.below = 0;  // no quadratic convergence: eps changes before
    return options;
  }

  void set_eps() {
    TermChanges changes;
    for (const TermId energy : energies_)
      changes.emplace_back(energy, TermChange{.parameters = Vec::Constant(1, eps_)});
    stepper_.reset(problem_.with(std::move(changes)));
  }

  double descend(double energy) {
    StepObserver stopped([&](const TraceEntry&, const Vec&) { return stop_(); });
    SolveResult round = stepper_.descend_from(
        std::move(y_), energy, brief_rules(kStepsPerRound, kRoundTolerance), &stopped);
    y_ = std::move(round.y);
    point_.iterations += static_cast<int>(round.iterations.size());
    return round.energy;
  }

  void update() {
    point_.x = problem_.expand(y_);
    point_.verdict = judge_(point_.x);
  }

  void shrink(double worst, double before, double after) {
    const double sigma = std::max(kSmallestShrink, 1 - after / before);
    const double root = std::sqrt(worst * worst + eps_ * eps_);
    eps_ *= worst < 0 ? 1 - sigma * root / (std::abs(worst) + root) : 1 - sigma;
  }

  const Problem& problem_;
  const std::vector<TermId>& energies_;
  const std::function<Verdict(VecIn x)>& judge_;
  const StopCheck& stop_;
  NewtonStepper stepper_;
  Vec y_;
  const UntanglingRules& rules_;
  double eps_ = 0;
  UntangledPoint point_;
};

}  // namespace

UntangledPoint descend_untangling(const Problem& problem, const std::vector<TermId>& energies,
                                  const std::function<Verdict(VecIn x)>& judge, Vec y,
                                  const UntanglingRules& rules, const StopCheck& stop) {
  return UntanglingDescent(problem, energies, judge, std::move(y), rules, stop).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
