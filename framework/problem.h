// An optimization problem: minimize sum_k w_k E_k(x) subject to A x = b, inside a feasible set.
//
//   ProblemBuilder builder(2 * space->node_count());
//   TermId id = builder.add(energy, 1.0);     // shared_ptr<const EnergyTerm>
//   builder.add(FixedPoints({{0, {0, 0}}}));  // Constraint: eliminated, holds exactly
//   // FeasibilityChecker: held by the line search
//   builder.add(std::make_shared<LocalInjectivity>(space, 2 * rest.measure));
//   Problem problem = builder.build();
//   SolveResult r = NewtonMinimizer().minimize(problem, problem.reduce(x), observer);
//
//   problem = problem.with({{id, TermState{.weight = 2}}});  // everything else the same
//
// A Problem is immutable and cheap to copy. Solvers see the reduced unknowns y of x = Z y + c.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/assembly.h"
#include "majorant/framework/chunk_plan.h"
#include "majorant/framework/constraint.h"
#include "majorant/framework/elimination.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/feasibility.h"
#include "majorant/framework/sparse_pattern.h"

namespace majorant {

// One term of a problem, as ProblemBuilder::add names it; the same in all problems of one
// structure.
enum class TermId : std::size_t {};

// What is to be set, term by term.
using TermChanges = std::vector<std::pair<TermId, TermState>>;

class Problem {
 public:
  Index full_size() const { return structure_->elimination.full_size(); }
  Index size() const { return structure_->elimination.reduced_size(); }

  std::span<const TermId> terms() const { return structure_->ids; }  // in the order of add()
  const EnergyTerm& term(TermId id) const { return *structure_->terms[at(id)]; }
  const TermState& state(TermId id) const { return states_[at(id)]; }
  const ChunkPlan& plan(TermId id) const { return *plans_[at(id)]; }
  const SlotTable& slots(TermId id) const { return structure_->slots[at(id)]; }
  const Elimination& elimination() const { return structure_->elimination; }
  const SparsePattern& pattern() const { return structure_->pattern; }
  const std::vector<std::shared_ptr<const FeasibilityChecker>>& checkers() const {
    return structure_->checkers;
  }
  bool supports(Curvature curvature) const;

  // The same problem with other states of these terms, the rest kept: pattern, slots and (in a
  // solver) the symbolic factor stay valid. Throws std::invalid_argument for a term of another
  // problem.
  Problem with(TermChanges changes) const;
  // Whether a factorization analysed for `other` fits this problem.
  bool same_structure(const Problem& other) const { return structure_ == other.structure_; }

  Vec expand(VecIn y) const;
  // y of x; *residual (may be null) receives the largest violation of the constraints.
  Vec reduce(VecIn x, double* residual = nullptr) const {
    return structure_->elimination.reduce(x, residual);
  }

 private:
  friend class ProblemBuilder;
  static std::size_t at(TermId id) { return static_cast<std::size_t>(id); }
  struct Structure {
    std::vector<std::shared_ptr<const EnergyTerm>> terms;
    std::vector<TermId> ids;
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
  // What add() of a term returns: its id, or the builder again where nobody asks for it.
  //   const TermId energy = builder.add(term, 1.0);
  //   const Problem problem = ProblemBuilder(size).add(term, 1.0).add(pins).build();
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

  explicit ProblemBuilder(Index full_size) : full_size_(full_size) {}
  AddedTerm add(std::shared_ptr<const EnergyTerm> term, double weight);
  AddedTerm add(std::shared_ptr<const EnergyTerm> term, TermState state);
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
