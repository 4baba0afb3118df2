// One step of a descent method, and the loop around it that all methods share.
//
// A method derives from Stepper, computes gradient and direction in advance() and leaves the rest
// to descend(); run() is the loop with the stopping rules of minimizer.h. Outer loops that change
// the problem between steps call step() themselves. Not for methods that bring a line search of
// their own (ceres_minimizer.h).
#pragma once

#include <chrono>
#include <utility>
#include <vector>

#include "majorant/framework/evaluator.h"
#include "majorant/framework/line_search.h"
#include "majorant/framework/minimizer.h"

namespace majorant {

// Seconds since the last call, or since construction.
class Lap {
 public:
  double operator()() {
    const auto now = Clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_ = Clock::now();
};

// value / |energy|, 0 / 0 = 0: energies may vanish at their minimum.
double relative_to(double energy, double value);

class Stepper {
 public:
  virtual ~Stepper() = default;

  enum class Outcome {
    Moved,
    AtMinimum,   // decrement rule, or no unknowns: y unchanged
    Blocked,     // the largest certified step is below smallest_step: y unchanged
    NoDecrease,  // no decrease down to smallest_step: y unchanged
    Breakdown,   // no factorization or no finite direction: y unchanged
    Stopped,     // Step::why: y unchanged
  };
  struct Step {
    Outcome outcome = Outcome::Breakdown;
    IterationRecord record;
    std::vector<Index> blocking;  // StepBound::blocking of the line search
    Directive why = Directive::Continue;
  };
  // One step from y, which must be feasible; energy of y in, energy of the new y out. A step that
  // its stop check ends is abandoned.
  Step step(Vec& y, double& energy);

  // The loop is about to stop because the energy hardly decreases: a method that left out a more
  // accurate model of late tries it in its next step.
  virtual void polish() {}

  Evaluator& evaluator() { return evaluator_; }

 protected:
  // decrement_rule: StoppingRules::decrement. stop: polled in every piece of a step.
  Stepper(const Problem& problem, const LineSearchOptions& line_search, double decrement_rule,
          StopCheck stop)
      : evaluator_(problem),
        stop_(std::move(stop)),
        line_search_(line_search),
        decrement_rule_(decrement_rule) {}

  // The step of a problem that has unknowns. step.record.energy is that of y. May throw Stopped as
  // long as y and energy are as they were.
  virtual void advance(Vec& y, double& energy, Step& step) = 0;

  // From gradient_ at y and a direction p, size() entries each: checks that p is finite and no
  // ascent, applies the decrement rule, searches the line from the trial step `first`, moves y.
  void descend(const Vec& p, double first, Vec& y, double& energy, Step& step);

  Evaluator evaluator_;
  StopCheck stop_;
  Vec gradient_;

 private:
  LineSearchOptions line_search_;
  double decrement_rule_;
};

// Whether result.y may be a start: fills result.energy there, else status Infeasible, message and
// blocking elements. For minimizers that do not use run().
bool check_start(Evaluator& evaluator, SolveResult& result);

// Steps until a stopping rule, the observer or the stepper's stop check says so. An infeasible y0
// is Status::Infeasible; outer loops that change the state of the problem call this repeatedly.
SolveResult run(Stepper& stepper, Vec y0, const StoppingRules& rules, const Observer& observer);

}  // namespace majorant
