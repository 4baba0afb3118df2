// The line search of all minimizers: stays inside the feasible set and goes towards the minimum of
// the line.
//
//   Evaluator evaluator(problem);
//   Vec g;
//   evaluator.gradient(y0, g);
//   const Vec p = -g;   // a direction of descent
//   const LineSearchOptions how;
//   LineSearch search(evaluator, how, y0, p, evaluator.value(y0), p.dot(p));
//   if (search.find(1.0) == LineSearch::Result::Accepted) y0 += search.step() * p;
//
// An acceptable step comes first (certified, Armijo, halving), then the minimum of the parabola
// through E(0), E'(0) and E(s), as long as that pays. Positive semidefinite models overestimate
// curvature where they clamp it, and barriers flatten quickly, so steps well above 1 are common far
// from a minimum and in linearly converging tails; an evaluation costs a fraction of a
// factorization. Where a barrier is all of the energy, E ~ 1 / (1 + s / 3)^2, the parabola asks for
// s = 1.455 every time although E falls on and on: there the step is doubled instead. No curvature
// (Wolfe) condition: quasi-Newton methods skip pairs instead.
//
// How far a step may go is what the checkers of the problem certify (feasibility.h). Not for
// methods that bring a line search of their own (ceres_minimizer.h).
#pragma once

#include "majorant/framework/feasibility.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"

namespace majorant {

// The part of the predicted decrease that a step must achieve [NW06, Sec. 3.1].
inline constexpr double kArmijo = 1e-4;
// The part that is taken of a step that must not be reached, the largest certified one. Tuned by
// bench/tune.py line_search.boundary_fraction.
inline constexpr double kPartOfLimit = 0.9;

struct LineSearchOptions {
  double armijo = kArmijo;                  // accept s when E(s) <= E(0) + armijo * s * g.p, finite
  double boundary_fraction = kPartOfLimit;  // of the largest certified step, when that is the limit
  // The growth of a step per trial, at most, while the energy asks for more. Tuned by bench/tune.py
  // line_search.largest_growth.
  double largest_growth = 4;
  // Longer or shorter steps that are tried after the first one that is good enough. Tuned by
  // bench/tune.py line_search.most_improvements.
  int most_improvements = 8;
  // In the barrier phase, decrement > barrier_decrement |E(0)|, a step that the parabola would make
  // longer is doubled instead, as long as E falls by the part barrier_gain of it. Tuned by
  // bench/tune.py line_search.barrier_decrement.
  double barrier_decrement = 0.5;
  // Tuned by bench/tune.py line_search.barrier_gain.
  double barrier_gain = 0.1;
  // Give up below: steps of this part of y are lost in its rounding.
  double smallest_step = 1e-14;
};

class LineSearch {
 public:
  // Relative changes of an energy that its evaluations may not tell from rounding: 4500 unit
  // roundoffs; a sum of N terms of one sign loses about sqrt(N) of them.
  static constexpr double kResolution = 5e-13;
  // Along y + s p from a feasible y, all of size(); energy: E(y); decrement: -g.p >= 0, an energy.
  // The arguments must outlive the search, but `stop`. Evaluations poll `stop`, checkers their own.
  LineSearch(Evaluator& evaluator, const LineSearchOptions& options, const Vec& y, const Vec& p,
             double energy, double decrement, StopCheck stop = {});

  enum class Result {
    Accepted,
    Blocked,     // the largest certified step is below smallest_step
    NoDecrease,  // no acceptable step down to smallest_step
  };
  // Tries s = first at first, or what is certified of it.
  Result find(double first);  // Stopped: an abandoned search has found nothing

  double step() const { return best_step_; }      // accepted, 0 if none
  double energy() const { return best_energy_; }  // there
  int trials() const { return trials_; }          // evaluations of the energy
  // The largest certified step <= max(1, first), and what limits it.
  const StepBound& bound() const { return bound_; }
  StepLimit limit() const { return limit_; }  // why no longer step was found, growth apart

 private:
  StepBound certified(double s) const;
  bool accept(double s);
  bool refuse(StepLimit why);
  double target_step() const;
  bool grow(double target);
  bool stride();
  void improve();

  Evaluator& evaluator_;
  const LineSearchOptions& options_;
  const Vec &y_, &p_;
  StopCheck stop_;
  double energy_, decrement_;
  // An increase that is taken for rounding, 0 where the decrement is above kResolution. Below, the
  // step is taken if it does no visible harm, so that gradients can go below sqrt(epsilon).
  double rounding_;
  Vec x_, d_;
  StepBound bound_;
  StepLimit limit_ = StepLimit::None;
  double best_step_ = 0, best_energy_ = 0;
  int trials_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
