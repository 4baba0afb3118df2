#include "majorant/parametrization/initialization/untangle.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "majorant/energies/make_energy.h"
#include "majorant/energies/untangling.h"
#include "majorant/energies/vectorized.h"
#include "majorant/framework/newton.h"

namespace majorant {
namespace {

// Over the values of eps: the second one starts where the first got stuck, with a large eps
// again.
constexpr int kPasses = 2;
// Values of eps, each pass: eps shrinks by half of kSmallestShrink at least, 0.95^100 is
// 0.6 %.
constexpr int kRounds = 100;
// Newton steps: eps moves on anyway; bounds the cost of one value.
constexpr int kStepsPerRound = 10;
// Relative decrease that ends a round: an order below kSmallestShrink, by which eps moves.
constexpr double kRoundTolerance = 1e-2;
// Least part by which eps shrinks, sigma: [GKKPRS21].
constexpr double kSmallestShrink = 0.1;

class Untangler {
 public:
  Untangler(const MapSpecification& spec, const std::shared_ptr<const BezierTriangleSpace>& space,
            VecIn start, const RunRecord& record, double first_eps)
      : spec_(untangling(spec)),
        injectivity_(space, 2 * spec.rest.measure),
        map_(map_problem(spec_, space, start, energy_terms(spec_, space, {lattice_rule(1)}),
                         nullptr)),
        stepper_(map_.problem, newton_options(record.start_stop())),
        y_(map_.problem.reduce(start)),
        first_eps_(first_eps > 0 ? first_eps : own_first_eps(spec)) {}

  UntangleResult run(const RunRecord& record) {
    double worst = update();
    for (int round = 0; round < kPasses * kRounds && !result_.inverted.empty(); ++round) {
      if (round % kRounds == 0) eps_ = first_eps_;
      set_eps();
      const double before = stepper_.evaluator().value(y_);
      const double after = descend(before, record.start_stop());
      worst = update();
      if (record.start_stop()() != Directive::Continue) break;
      shrink(worst, before, after);
    }
    return std::move(result_);
  }

 private:
  static MapSpecification untangling(MapSpecification spec) {
    const UntanglingDensity density(1.0);
    spec.energy = {{energy_factory(density, vectorized(density)), 1.0}};
    spec.face_weight.resize(0);
    spec.boundary_angles = BoundaryAngles::Free;
    return spec;
  }

  static double own_first_eps(const MapSpecification& spec) {
    const bool held = spec.boundary == BoundaryCondition::Fixed || spec.pins.size() >= 2;
    return held ? kFirstEpsHeld : kFirstEps;
  }

  static NewtonOptions newton_options(const StopCheck& stop) {
    NewtonOptions options;
    options.stop = stop;
    options.blend.below = 0;  // no tail: eps moves on before
    return options;
  }

  TermId energy() const { return map_.energies.front(); }

  void set_eps() {
    TermState state = map_.problem.state(energy());
    state.parameters = Vec::Constant(1, eps_);
    stepper_.reset(map_.problem.with({{energy(), state}}));
  }

  double descend(double energy, const StopCheck& stop) {
    StepObserver stopped([&](const TraceEntry&, const Vec&) { return stop(); });
    SolveResult round = stepper_.descend_from(
        std::move(y_), energy, brief_rules(kStepsPerRound, kRoundTolerance), &stopped);
    y_ = std::move(round.y);
    result_.iterations += static_cast<int>(round.iterations.size());
    return round.energy;
  }

  // The worst determinant; finds the elements that are left.
  double update() {
    result_.x = map_.problem.expand(y_);
    Verdict verdict = injectivity_.check(result_.x);
    result_.inverted = std::move(verdict.blocking);
    return verdict.margin;
  }

  void shrink(double worst, double before, double after) {
    const double sigma = std::max(kSmallestShrink, 1 - after / before);
    const double root = std::sqrt(worst * worst + eps_ * eps_);
    eps_ *= worst < 0 ? 1 - sigma * root / (std::abs(worst) + root) : 1 - sigma;
  }

  MapSpecification spec_;
  LocalInjectivity injectivity_;
  MapProblem map_;
  NewtonStepper stepper_;
  Vec y_;
  double first_eps_, eps_ = 0;
  UntangleResult result_;
};

}  // namespace

UntangleResult untangle(const MapSpecification& spec,
                        const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                        const RunRecord& record, double first_eps) {
  return Untangler(spec, space, start, record, first_eps).run(record);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
