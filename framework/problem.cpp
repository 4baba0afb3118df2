#include "majorant/framework/problem.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "majorant/framework/internal/problem_parts.h"

namespace majorant {
namespace {

std::size_t number(TermId id) { return static_cast<std::size_t>(id); }

}  // namespace

struct Problem::Structure {
  std::vector<std::shared_ptr<const EnergyTerm>> terms;
  std::vector<TermId> ids;
  std::vector<std::shared_ptr<const FeasibilityChecker>> checkers;
  Elimination elimination;
  SparsePattern pattern;
  std::vector<SlotTable> slots;
};

Index Problem::full_size() const { return structure_->elimination.full_size(); }

Index Problem::size() const { return structure_->elimination.reduced_size(); }

std::span<const TermId> Problem::terms() const { return structure_->ids; }

const EnergyTerm& Problem::term(TermId id) const { return *structure_->terms[number(id)]; }

const TermState& Problem::state(TermId id) const { return states_[number(id)]; }

const SparsePattern& Problem::pattern() const { return structure_->pattern; }

const std::vector<std::shared_ptr<const FeasibilityChecker>>& Problem::checkers() const {
  return structure_->checkers;
}

const Elimination& ProblemParts::elimination(const Problem& problem) {
  return problem.structure_->elimination;
}

const ChunkPlan& ProblemParts::plan(const Problem& problem, TermId id) {
  return *problem.plans_[number(id)];
}

const SlotTable& ProblemParts::slots(const Problem& problem, TermId id) {
  return problem.structure_->slots[number(id)];
}

bool Problem::supports(Curvature curvature) const {
  for (const auto& term : structure_->terms)
    if (!term->supports(curvature)) return false;
  return true;
}

Problem Problem::with(TermChanges changes) const {
  Problem other = *this;
  for (auto& [id, state] : changes) {
    if (number(id) >= states_.size())
      throw std::invalid_argument("Problem::with: no term of this problem has that id");
    if (state.element_rule != other.states_[number(id)].element_rule)
      other.plans_[number(id)] = std::make_shared<const ChunkPlan>(
          term(id).stencils(), state.element_rule, structure_->elimination);
    other.states_[number(id)] = std::move(state);
  }
  return other;
}

Vec Problem::expand(VecIn y) const {
  Vec x;
  structure_->elimination.expand(y, x);
  return x;
}

Vec Problem::reduce(VecIn x, double* residual) const {
  return structure_->elimination.reduce(x, residual);
}

ProblemBuilder::AddedTerm ProblemBuilder::add(std::shared_ptr<const EnergyTerm> term,
                                              double weight) {
  TermState state;
  state.weight = weight;
  return add(std::move(term), std::move(state));
}

ProblemBuilder::AddedTerm ProblemBuilder::add(std::shared_ptr<const EnergyTerm> term,
                                              TermState state) {
  const Stencils& s = term->stencils();
  if (s.nodes.size() && (s.nodes.minCoeff() < 0 || s.block * (s.nodes.maxCoeff() + 1) > full_size_))
    throw std::invalid_argument(
        fmt::format("term '{}': a stencil leaves the {} unknowns", term->name(), full_size_));
  terms_.push_back(std::move(term));
  states_.push_back(std::move(state));
  return {*this, TermId(terms_.size() - 1)};
}

ProblemBuilder& ProblemBuilder::add(const Constraint& constraint) {
  constraint.append_rows(rows_);
  return *this;
}

ProblemBuilder& ProblemBuilder::add(std::shared_ptr<const FeasibilityChecker> checker) {
  checkers_.push_back(std::move(checker));
  return *this;
}

Problem ProblemBuilder::build() const {
  Elimination elimination(full_size_, rows_);
  std::vector<const Stencils*> stencils;
  for (const auto& term : terms_) stencils.push_back(&term->stencils());
  SparsePattern pattern = reduced_pattern(stencils, elimination);
  std::vector<SlotTable> slots;
  for (const Stencils* s : stencils) slots.emplace_back(*s, elimination, pattern);

  Problem problem;
  std::vector<TermId> ids;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    ids.push_back(TermId(k));
    problem.plans_.push_back(
        std::make_shared<const ChunkPlan>(*stencils[k], states_[k].element_rule, elimination));
  }
  problem.states_ = states_;
  problem.structure_ = std::make_shared<const Problem::Structure>(
      Problem::Structure{terms_, std::move(ids), checkers_, std::move(elimination),
                         std::move(pattern), std::move(slots)});
  return problem;
}

}  // namespace majorant
