// Evaluates a Problem: energy, gradient and curvature in the reduced unknowns.
//
//   Evaluator evaluator(problem);
//   Vec y = problem.reduce(x), g, h;
//   double energy = evaluator.value(y);                                 // line searches
//   energy = evaluator.gradient(y, g);                                  // first-order methods
//   energy = evaluator.linearize(y, Curvature::Projected, g, h);        // Newton
//
// One evaluator per solver: it owns scratch memory, counters and timers. Results do not depend on
// the number of threads (thread_count.h), to the last bit: batches are fixed, batches of one colour
// touch disjoint unknowns, colours run in order, energies add in batch order. All throw
// InvalidArgument for another number of unknowns, linearize() for a curvature that a term has not;
// what a term throws leaves them as it is.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/problem.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

// Of one term at x (full unknowns): the unweighted value of each of its elements here, and its part
// of the (whole) problem's energy, weights included. Poll between batches of elements, as all
// evaluations do that are given a stop check: Stopped.
Vec element_values(const Problem& problem, TermId id, VecIn x, const StopCheck& stop = {});
double term_energy(const Problem& problem, TermId id, VecIn x, const StopCheck& stop = {});

class Evaluator {
 public:
  explicit Evaluator(const Problem& problem);
  ~Evaluator();
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  const Problem& problem() const { return problem_; }
  // Goes on with another problem.
  void reset(const Problem& problem);

  double value(VecIn y, const StopCheck& stop = {});  // +inf outside the domain
  // Energy, gradient and curvature at y, which lies in the domain. The Hessian values are parallel
  // to problem().pattern().rows.
  double linearize(VecIn y, BlendedCurvature curvature, Vec& gradient, Vec& hessian_values,
                   const StopCheck& stop = {});
  // Energy and gradient at y, which lies in the domain: Z^T of the full gradient, size() entries.
  double gradient(VecIn y, Vec& gradient, const StopCheck& stop = {});

  struct Violation {
    const FeasibilityChecker* checker = nullptr;
    Verdict verdict;
  };
  // The first of the problem's checkers that does not find x feasible (full unknowns), if any.
  std::optional<Violation> violation(VecIn x);

  // Since construction, all problems together.
  struct Counters {
    long values = 0, gradients = 0, linearizations = 0;
    std::vector<long> proven;  // Verdict::proven of all violation()s
    double value_seconds = 0, gradient_seconds = 0, linearize_seconds = 0;
  };
  const Counters& counters() const { return counters_; }

 private:
  struct Scratch;
  double assemble(VecIn y, BlendedCurvature curvature, Vec& gradient, Vec* hessian_values,
                  const StopCheck& stop);
  void assemble_term(TermId k, BlendedCurvature curvature, Vec& gradient, Vec* hessian_values,
                     const StopCheck& stop, std::vector<double>& batch_energies);

  Problem problem_;
  Vec x_;
  std::vector<std::unique_ptr<Scratch>> scratch_;
  Counters counters_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
