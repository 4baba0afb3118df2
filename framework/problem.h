// An optimization problem: minimize sum_k w_k E_k(x) subject to A x = b, inside a feasible set.
//
//   ProblemBuilder builder(2 * space->node_count());
//   builder.add(energy, 1.0);                 // shared_ptr<const EnergyTerm>
//   builder.add(FixedPoints({{0, {0, 0}}}));  // Constraint: eliminated, holds exactly
//   // FeasibilityChecker: held by the line search
//   builder.add(std::make_shared<LocalInjectivity>(space, 2 * rest.measure));
//   Problem problem = builder.build();
//   SolveResult r = NewtonMinimizer().minimize(problem, problem.reduce(x), observer);
//
// A Problem is immutable and cheap to copy. Solvers see the reduced unknowns y of x = Z y + c.
#pragma once

#include <memory>
#include <vector>

#include "majorant/framework/assembly.h"
#include "majorant/framework/chunk_plan.h"
#include "majorant/framework/constraint.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/sparse_pattern.h"

namespace majorant {

class Problem {
 public:
  Index full_size() const { return structure_->elimination.full_size(); }
  Index size() const { return structure_->elimination.reduced_size(); }

  std::size_t term_count() const { return structure_->terms.size(); }
  const EnergyTerm& term(std::size_t k) const { return *structure_->terms[k]; }
  const TermState& state(std::size_t k) const { return states_[k]; }
  const ChunkPlan& plan(std::size_t k) const { return *plans_[k]; }
  const SlotTable& slots(std::size_t k) const { return structure_->slots[k]; }
  const Elimination& elimination() const { return structure_->elimination; }
  const SparsePattern& pattern() const { return structure_->pattern; }
  const std::vector<std::shared_ptr<const FeasibilityChecker>>& checkers() const {
    return structure_->checkers;
  }
  bool supports(Curvature curvature) const;

  // The same problem with other states: pattern, slots and (in a solver) the symbolic factor stay
  // valid. Throws std::invalid_argument unless there are term_count() states.
  Problem with(std::vector<TermState> states) const;
  // Whether a factorization analysed for `other` fits this problem.
  bool same_structure(const Problem& other) const { return structure_ == other.structure_; }

  Vec expand(VecIn y) const;
  // y of x; *residual (may be null) receives the largest violation of the constraints.
  Vec reduce(VecIn x, double* residual = nullptr) const {
    return structure_->elimination.reduce(x, residual);
  }

 private:
  friend class ProblemBuilder;
  struct Structure {
    std::vector<std::shared_ptr<const EnergyTerm>> terms;
    std::vector<std::shared_ptr<const FeasibilityChecker>> checkers;
    Elimination elimination;
    SparsePattern pattern;
    std::vector<SlotTable> slots;
  };
  std::shared_ptr<const Structure> structure_;
  std::vector<TermState> states_;
  std::vector<std::shared_ptr<const ChunkPlan>> plans_;
};

class ProblemBuilder {
 public:
  explicit ProblemBuilder(Index full_size) : full_size_(full_size) {}
  ProblemBuilder& add(std::shared_ptr<const EnergyTerm> term, double weight);
  ProblemBuilder& add(std::shared_ptr<const EnergyTerm> term, TermState state);
  ProblemBuilder& add(const Constraint& constraint);  // rows are copied
  ProblemBuilder& add(std::shared_ptr<const FeasibilityChecker> checker);
  // Eliminates the constraints and fixes the pattern. Throws Error(Unsupported) when the
  // constraints contradict each other, std::invalid_argument when one leaves the unknowns (add()
  // does so for a stencil).
  Problem build() const;

 private:
  Index full_size_;
  std::vector<std::shared_ptr<const EnergyTerm>> terms_;
  std::vector<TermState> states_;
  ConstraintRows rows_;
  std::vector<std::shared_ptr<const FeasibilityChecker>> checkers_;
};

}  // namespace majorant
