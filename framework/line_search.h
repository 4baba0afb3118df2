// The line search of all minimizers. It stays inside the feasible set and approaches the minimum
// along the line.
//
//   Evaluator evaluator(problem);
//   Vec g;
//   evaluator.gradient(y0, g);
//   const Vec p = -g;   // a direction of descent
//   const LineSearchOptions how;
//   LineSearch search(evaluator, how, y0, p, evaluator.value(y0), p.dot(p));
//   if (search.find(1.0) == LineSearch::Result::Accepted) y0 += search.step() * p;
//
// First it finds an acceptable step (certified, Armijo, halving). Then it tries the minimum of the
// parabola through E(0), E'(0) and E(s), as long as that pays: an evaluation costs a fraction of a
// factorization. Steps well above 1 are common far from a minimum and in linearly converging tails,
// because positive semidefinite models overestimate curvature where they clamp it, and barriers
// flatten quickly. For an energy that is a barrier alone, E ~ 1 / (1 + s / 3)^2, the parabola
// always proposes s = 1.455 although E keeps falling; there the step is doubled instead. There is
// no curvature (Wolfe) condition: quasi-Newton methods skip pairs instead.
//
// The checkers of the problem certify the longest step (feasibility.h). Not for methods with a line
// search of their own (ceres_minimizer.h).
#pragma once

#include "majorant/framework/feasibility.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/run_record.h"

namespace majorant {

// The part of the predicted decrease that a step must achieve [NW06, Sec. 3.1].
inline constexpr double kArmijo = 1e-4;
// The part of the largest certified step that is taken, since that step itself must not be reached.
// Tuned by bench/tune.py line_search.boundary_fraction.
inline constexpr double kPartOfLimit = 0.9;

struct LineSearchOptions {
  double armijo = kArmijo;                  // accept s when E(s) <= E(0) + armijo * s * g.p, finite
  double boundary_fraction = kPartOfLimit;  // of the largest certified step, if that limits s
  // The largest growth of a step per trial while the energy falls. Tuned by bench/tune.py
  // line_search.largest_growth.
  double largest_growth = 4;
  // The maximum number of longer or shorter steps tried after the first acceptable one. Tuned by
  // bench/tune.py line_search.most_improvements.
  int most_improvements = 8;
  // In the barrier phase, decrement > barrier_decrement |E(0)|, a step that the parabola would
  // lengthen is doubled instead, as long as each doubling lowers E by the part barrier_gain. Tuned
  // by bench/tune.py line_search.barrier_decrement.
  double barrier_decrement = 0.5;
  // Tuned by bench/tune.py line_search.barrier_gain.
  double barrier_gain = 0.1;
  // The search ends below this part of y, where steps are lost in its rounding.
  double smallest_step = 1e-14;
};

class LineSearch {
 public:
  // Relative changes of an energy below this may be rounding: 4500 unit roundoffs; a sum of N terms
  // of one sign loses about sqrt(N) of them.
  static constexpr double kResolution = 5e-13;
  // Searches along y + s p from a feasible y, all of size(). energy: E(y); decrement: -g.p >= 0, an
  // energy. The arguments other than `stop` must outlive the search. Evaluations poll `stop`;
  // checkers poll their own.
  LineSearch(Evaluator& evaluator, const LineSearchOptions& options, const Vec& y, const Vec& p,
             double energy, double decrement, StopCheck stop = {});

  enum class Result {
    Accepted,
    Blocked,     // the largest certified step is below smallest_step
    NoDecrease,  // no acceptable step down to smallest_step
  };
  // Tries s = first, or the certified part of it.
  Result find(double first);  // throws Stopped; the search then has no step

  double step() const { return best_step_; }      // accepted, 0 if none
  double energy() const { return best_energy_; }  // at step()
  int trials() const { return trials_; }          // evaluations of the energy
  // The largest certified step <= max(1, first), and what limits it.
  const StepBound& bound() const { return bound_; }
  StepLimit limit() const { return limit_; }  // why no longer step was found, other than growth

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
  // An increase that counts as rounding; 0 if the decrement exceeds kResolution. Below that, a step
  // is taken if it does no visible harm, so that gradients can go below sqrt(epsilon).
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
