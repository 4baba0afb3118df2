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

Problem Problem::with(std::vector<TermState> states) const {
  if (states.size() != states_.size())
    throw std::invalid_argument("Problem::with: one state per term is needed");
  Problem other = *this;
  for (std::size_t k = 0; k < states.size(); ++k)
    if (states[k].element_rule != states_[k].element_rule)
      other.plans_[k] = std::make_shared<const ChunkPlan>(term(k).stencils(),
                                                          states[k].element_rule, elimination());
  other.states_ = std::move(states);
  return other;
}

Vec Problem::expand(VecIn y) const {
  Vec x;
  structure_->elimination.expand(y, x);
  return x;
}

ProblemBuilder& ProblemBuilder::add(std::shared_ptr<const EnergyTerm> term, double weight) {
  TermState state;
  state.weight = weight;
  return add(std::move(term), std::move(state));
}

ProblemBuilder& ProblemBuilder::add(std::shared_ptr<const EnergyTerm> term, TermState state) {
  const Stencils& s = term->stencils();
  if (s.nodes.size() && (s.nodes.minCoeff() < 0 || s.block * (s.nodes.maxCoeff() + 1) > full_size_))
    throw std::invalid_argument(
        fmt::format("term '{}': a stencil leaves the {} unknowns", term->name(), full_size_));
  terms_.push_back(std::move(term));
  states_.push_back(std::move(state));
  return *this;
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
  for (std::size_t k = 0; k < terms_.size(); ++k)
    problem.plans_.push_back(
        std::make_shared<const ChunkPlan>(*stencils[k], states_[k].element_rule, elimination));
  problem.states_ = states_;
  problem.structure_ = std::make_shared<const Problem::Structure>(Problem::Structure{
      terms_, checkers_, std::move(elimination), std::move(pattern), std::move(slots)});
  return problem;
}

}  // namespace majorant
