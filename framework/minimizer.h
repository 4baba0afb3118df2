// Iterative solvers: what they are given, what they report, why they stop.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "majorant/framework/problem.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

enum class Status {
  Converged,  // a stopping formula holds
  MaxIterations,
  TimeLimit,    // an observer said so
  Interrupted,  // an observer said so
  Stalled,      // no step decreases the energy inside the feasible set, far from a minimum
  Infeasible,   // the start violates a checker or lies outside an energy's domain
  Failed,       // numerical breakdown: no factorization, no finite energy
};
std::string_view name(Status status);  // "converged", "max_iterations", ... as interface.md has it
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
  int trials = 0;                              // energy evaluations of the line search
  struct Seconds {
    double assemble = 0, factorize = 0, solve = 0, line_search = 0;
  } seconds;
};

// Receives each record and the point reached, before the next iteration; anything but Continue
// ends the solve with that status.
using Observer = std::function<Directive(const IterationRecord&, const Vec& y)>;

struct SolveResult {
  Status status = Status::Failed;
  std::string message;
  Vec y;
  double energy = 0;
  double newton_decrement = 0;  // of the last step, an energy
  std::vector<IterationRecord> iterations;
  std::vector<Index> blocking;  // elements that limited the last step
};

// Stopping formulas, with E_k the energy after iteration k, p the Newton direction, g the gradient:
//     decrement:   -g.p <= decrement |E_{k-1}|                                Converged, no step
//     taken small step:  E_{k-1} - E_k <= relative_decrease |E_{k-1}|
//       and -g.p <= tail_factor relative_decrease |E_{k-1}|                   Converged
//       for a second time, the exact Hessian having been given another chance in between; steps
//       with the exact Hessian do not count, they converge quadratically to the decrement rule
//     idle: small step, or a certified step below stall_step, in stall_iterations successive
//       iterations: Converged if -g.p <= stall_decrement |E_{k-1}|, else Stalled, and the result is
//       the last point reached where the certified step was at least anchor_step: what follows it
//       led into a corner
//     no step decreases the energy: Converged or Stalled by the same bound on -g.p.
struct StoppingRules {
  double relative_decrease = 1e-6;
  double tail_factor = 10;
  double decrement = 1e-12;
  double stall_decrement = 1e-4;
  int stall_iterations = 3;
  double stall_step = 1e-3;
  double anchor_step = 0.1;
  int max_iterations = 1000;
};

// For first-order methods, whose steps are many and small: only the decrement, or the end of what
// doubles resolve, counts as a minimum; a small certified step alone is no stall, since the metric
// may belong to a shape far away, and the result of a stall is the last point reached by progress.
inline StoppingRules first_order_rules() {
  StoppingRules rules;
  rules.relative_decrease = 1e-14;
  rules.stall_decrement = 1e-8;
  rules.stall_step = 1e-9;
  rules.anchor_step = 0;
  rules.max_iterations = 10000;
  return rules;
}

class Minimizer {
 public:
  virtual ~Minimizer() = default;
  // y0: a feasible point of the reduced unknowns. Never throws for numerical reasons.
  virtual SolveResult minimize(const Problem& problem, Vec y0, const Observer& observer) const = 0;
};

}  // namespace majorant
