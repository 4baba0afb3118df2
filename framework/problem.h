// An optimization problem: minimize sum_k w_k E_k(x) subject to A x = b, inside a feasible set.
//
//   ProblemBuilder builder(2 * space->node_count());
//   const TermId id = builder.add(energy, 1.0);   // shared_ptr<const EnergyTerm>
//   builder.add(FixedPoints({{0, {0, 0}}}));  // Constraint: eliminated, holds exactly
//   // FeasibilityChecker: held by the line search
//   builder.add(std::make_shared<LocalInjectivity>(space, 2 * rest.measure));
//   Problem problem = builder.build();
//   SolveResult r = NewtonMinimizer().minimize(problem, problem.reduce(x), observer);
//   Problem other = problem.with({{id, {.weight = 2}}});      // everything else the same
//
// A Problem is immutable and cheap to copy. Solvers see the reduced unknowns y of x = Z y + c.
//
// Not for sums whose elements have many unknowns each: matrices are sparse, local matrices dense.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/framework/constraint.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

class ColoredBatches;
class Elimination;
class Partition;

// The id of a term, which ProblemBuilder::add returns; the same in all problems of one structure.
enum class TermId : std::size_t {};

// New states of terms, complete or in parts.
using TermChanges = std::vector<std::pair<TermId, TermChange>>;

class Problem {
 public:
  Index full_size() const;
  Index size() const;  // of the reduced unknowns

  std::span<const TermId> terms() const;  // in the order of add()
  const EnergyTerm& term(TermId id) const;
  const TermState& state(TermId id) const;
  const SparsePattern& pattern() const;  // of the Hessian in the reduced unknowns
  const std::vector<std::shared_ptr<const FeasibilityChecker>>& checkers() const;
  bool supports(Curvature curvature) const;

  // Returns the same problem with other states of these terms: pattern, slots and (in a solver) the
  // symbolic factor stay valid. A TermState replaces the whole state of a term, a TermChange the
  // members that it sets: {{id, {.parameters = numbers}}} keeps the weight. Throws InvalidArgument
  // for a term that the problem does not have, and for states that ProblemBuilder::add() refuses.
  Problem with(TermChanges changes) const;
  // Returns a problem of another structure, with the same unknowns and constraints: other terms
  // replace some terms and keep their states, and these checkers replace all. It serves to relax
  // bounds. Throws InvalidArgument as with() and ProblemBuilder::add() do.
  Problem exchanged(const std::vector<std::pair<TermId, std::shared_ptr<const EnergyTerm>>>& terms,
                    std::vector<std::shared_ptr<const FeasibilityChecker>> checkers) const;
  // Returns whether a factorization analysed for `other` fits this problem.
  bool same_structure(const Problem& other) const { return structure_ == other.structure_; }

  // Both throw InvalidArgument for another number of unknowns.
  Vec expand(VecIn y) const;
  // Returns the y of x; *residual (may be null) receives the largest violation of the constraints.
  Vec reduce(VecIn x, double* residual = nullptr) const;

 private:
  friend class ProblemBuilder;
  friend struct ProblemParts;  // used by evaluators
  struct Structure;
  void require_term(std::string_view where, TermId id) const;
  // before: a problem whose first terms are reused as far as they are the same; may be null.
  static Problem assembled(Structure structure, std::vector<TermState> states,
                           const Problem* before);

  std::shared_ptr<const Structure> structure_;
  std::vector<TermState> states_;
  std::vector<std::shared_ptr<const ColoredBatches>> plans_;
};

class ProblemBuilder {
 public:
  // The result of add(term): converts to the id of the term or, in a chain of calls, to the
  // builder.
  //     const TermId energy = builder.add(term, 1.0);
  //     const Problem problem = ProblemBuilder(size).add(term, 1.0).add(pins).build();
  class AddedTerm {
   public:
    AddedTerm(ProblemBuilder& builder, TermId id) : builder_(builder), id_(id) {}
    operator TermId() const { return id_; }
    template <class... Arguments>
    decltype(auto) add(Arguments&&... arguments) const {
      return builder_.add(std::forward<Arguments>(arguments)...);
    }
    Problem build() const { return builder_.build(); }

   private:
    ProblemBuilder& builder_;
    TermId id_;
  };

  // add() throws InvalidArgument for null pointers, element_dofs beyond the unknowns, weights that
  // are negative or not finite, states and parameters of another size, rules that a term does not
  // have, and constraints with an unfinished row.
  explicit ProblemBuilder(Index full_size);
  AddedTerm add(std::shared_ptr<const EnergyTerm> term, double weight);
  AddedTerm add(std::shared_ptr<const EnergyTerm> term, TermState state);
  ProblemBuilder& add(const Constraint& constraint);  // rows are copied
  ProblemBuilder& add(std::shared_ptr<const FeasibilityChecker> checker);
  // Eliminates the constraints and fixes the pattern. Throws Error(Unsupported) if the constraints
  // contradict each other, InvalidArgument if a constraint has an unknown out of range.
  Problem build() const;
  // Builds the same problem faster if `before` begins with the same terms on the same unknowns:
  // their batches, slots and part of the pattern are reused. For terms that change while others
  // stay.
  Problem build(const Problem& before) const;

 private:
  friend struct ProblemParts;
  explicit ProblemBuilder(std::shared_ptr<const Partition> partition);
  Problem build_after(const Problem* before) const;

  Index full_size_;
  std::shared_ptr<const Partition> partition_;  // null: one process
  std::vector<std::shared_ptr<const EnergyTerm>> terms_;
  std::vector<TermState> states_;
  ConstraintRows rows_;
  std::vector<std::shared_ptr<const FeasibilityChecker>> checkers_;
};

// Evaluates a Problem: energy, gradient and curvature in the reduced unknowns.
//
//   Evaluator evaluator(problem);
//   Vec y = problem.reduce(x), g, h;
//   double energy = evaluator.value(y);                                 // line searches
//   energy = evaluator.gradient(y, g);                                  // first-order methods
//   energy = evaluator.linearize(y, Curvature::Projected, g, h);        // Newton
//   const Eigen::SparseMatrix<double> H = evaluator.hessian(y);         // to look at
//
// Use one evaluator per solver: it owns scratch memory, counters and timers. Results do not depend
// on the number of threads (parallel.h), to the last bit. Batches are fixed, batches of one colour
// touch disjoint unknowns, colours run in order, and energies are added in the order of batches.
// All members throw InvalidArgument for another number of unknowns, linearize() also for a
// curvature that a term does not support. Exceptions of terms pass through unchanged.

// Both functions take one term at x (full unknowns). The first returns the unweighted values of
// this process's elements, the second the term's part of the energy of the whole problem, weights
// included. Both poll the stop check between batches of elements, as all evaluations do, and throw
// Stopped.
Vec element_values(const Problem& problem, TermId id, VecIn x, const StopCheck& stop = {});
double term_energy(const Problem& problem, TermId id, VecIn x, const StopCheck& stop = {});

class Evaluator {
 public:
  explicit Evaluator(const Problem& problem);
  ~Evaluator();
  Evaluator(const Evaluator&) = delete;
  Evaluator& operator=(const Evaluator&) = delete;

  const Problem& problem() const { return problem_; }
  // Continues with another problem.
  void reset(const Problem& problem);

  double value(VecIn y, const StopCheck& stop = {});  // +inf outside the domain
  // Returns the energy at y, which must lie in the domain, and writes gradient and Hessian. The
  // Hessian values are parallel to problem().pattern().rows.
  double linearize(VecIn y, BlendedCurvature curvature, Vec& gradient, Vec& hessian_values,
                   const StopCheck& stop = {});
  // Returns the energy at y, which must lie in the domain, and writes Z^T of the full gradient,
  // size() entries.
  double gradient(VecIn y, Vec& gradient, const StopCheck& stop = {});
  // Does the same for the part of one term, weights included.
  double gradient(TermId id, VecIn y, Vec& gradient, const StopCheck& stop = {});
  // Returns a copy of the Hessian at y, which must lie in the domain, with both triangles.
  // Minimizers use linearize(); HessianFactor (hessian_factor.h) solves with the Hessian.
  Eigen::SparseMatrix<double> hessian(VecIn y, BlendedCurvature curvature = Curvature::Exact,
                                      const StopCheck& stop = {});

  struct Violation {
    const FeasibilityChecker* checker = nullptr;
    Verdict verdict;
  };
  // Returns the full unknowns of the last evaluation.
  const Vec& point() const { return x_; }
  // Returns the first of the problem's checkers that refuses x (full unknowns), if any.
  std::optional<Violation> violation(VecIn x);

  // Counts since construction, over all problems.
  struct Counters {
    long values = 0, gradients = 0, linearizations = 0;
    std::vector<long> proven;  // Verdict::proven of all violation()s
    double value_seconds = 0, gradient_seconds = 0, linearize_seconds = 0;
  };
  const Counters& counters() const { return counters_; }

 private:
  struct Scratch;
  double assemble(VecIn y, BlendedCurvature curvature, std::span<const TermId> terms, Vec& gradient,
                  Vec* hessian_values, const StopCheck& stop);
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
