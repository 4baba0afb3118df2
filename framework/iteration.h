// What one step of an iterative solver reports, and how a whole solve may end.
//
//     StepResult step = stepper.step(y, energy);
//     if (step.outcome == StepResult::Outcome::Moved) print(step.record.energy);
//
// Values only: no solver. Who decides from them whether to go on is StoppingTest (stopping.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/curvature.h"
#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"

namespace majorant {

enum class Status {
  Converged,  // a stopping formula holds
  MaxIterations,
  TimeLimit,    // an observer said so
  Interrupted,  // an observer said so
  Stalled,      // no step decreases the energy, or only tiny ones, far from a minimum
  Infeasible,   // the start violates a checker or lies outside an energy's domain
  Failed,       // numerical breakdown: no factorization, no finite energy
};
// "converged", "max_iterations", ... as reports have it.
std::string_view status_name(Status status);
Status stopped_status(Directive why);  // of a run that was stopped

struct IterationRecord {
  int iteration = 0;                           // 1-based
  double energy = 0;                           // after the step
  double relative_decrease = 0;                // (E_before - E_after) / |E_before|
  double step = 0;                             // accepted multiple of the Newton direction
  double step_bound = 0;                       // largest certified multiple
  double gradient_norm = 0;                    // before the step, reduced unknowns, Euclidean
  double newton_decrement = 0;                 // -g . p, an energy; before the step
  double shift = 0;                            // added to the Hessian's diagonal
  Curvature curvature = Curvature::Projected;  // model that gave the direction
  double projection_weight = 1;                // BlendedCurvature::projection_weight of it
  int trials = 0;                              // energy evaluations of the line search
  double residual = 0;                         // Solution::residual, 0 with a direct solver
  int solver_iterations = 0;                   // Solution::iterations, of all solves
  int factorizations = 0;                      // of a matrix of this size, failed ones included
  int failed_factorizations = 0;               // of these: the matrix was not positive definite
  struct Seconds {
    double assemble = 0, factorize = 0, solve = 0, line_search = 0;
    double sum() const { return assemble + factorize + solve + line_search; }
  } seconds;
};

// value / |energy|, 0 / 0 = 0: energies may vanish at their minimum.
double relative_to(double energy, double value);

// What refused the last of the trials that were too long, of a step that was shortened or of one
// that was not found. In this order: of several the last is named.
enum class StepLimit {
  None,     // nothing: the first trial was good
  Energy,   // it falls less than its derivatives promise, or not at all
  Domain,   // it is not finite there
  Checker,  // a FeasibilityChecker
};

struct StepResult {
  enum class Outcome {
    Moved,
    AtMinimum,   // decrement rule, or no unknowns: y unchanged
    Blocked,     // the largest certified step is below smallest_step: y unchanged
    NoDecrease,  // no decrease down to smallest_step: y unchanged
    Breakdown,   // no factorization or no finite direction: y unchanged
    Stopped,     // `why`: y unchanged
  };
  Outcome outcome = Outcome::Breakdown;
  double energy_before = 0;
  IterationRecord record;       // record.energy is the energy after the step
  std::vector<Index> blocking;  // StepBound::blocking of the line search
  StepLimit limit = StepLimit::None;
  Directive why = Directive::Continue;
  std::string why_none;  // of a Breakdown, where somebody looked into it: a sentence
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
