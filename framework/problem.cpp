#include "majorant/framework/problem.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace majorant {

bool Problem::supports(Curvature curvature) const {
  for (const auto& term : structure_->terms)
    if (!term->supports(curvature)) return false;
  return true;
}

Problem Problem::with(TermChanges changes) const {
  Problem other = *this;
  for (auto& [id, state] : changes) {
    if (at(id) >= states_.size())
      throw std::invalid_argument("Problem::with: no term of this problem has that id");
    if (state.element_rule != other.states_[at(id)].element_rule)
      other.plans_[at(id)] =
          std::make_shared<const ChunkPlan>(term(id).stencils(), state.element_rule, elimination());
    other.states_[at(id)] = std::move(state);
  }
  return other;
}

Vec Problem::expand(VecIn y) const {
  Vec x;
  structure_->elimination.expand(y, x);
  return x;
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
