#include "majorant/framework/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/partition.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

std::size_t number(TermId id) { return static_cast<std::size_t>(id); }

using Terms = std::vector<std::shared_ptr<const EnergyTerm>>;

std::vector<const ElementDofs*> element_dofs(const Terms& terms, std::size_t first,
                                             std::size_t last) {
  std::vector<const ElementDofs*> out;
  for (std::size_t k = first; k < last; ++k) out.push_back(&terms[k]->element_dofs());
  return out;
}

// Returns the number of full unknowns up to the last one of a term.
Index extent(const EnergyTerm& term) {
  const ElementDofs& s = term.element_dofs();
  return s.nodes.size() ? s.block * (s.nodes.maxCoeff() + 1) : 0;
}

// Returns whether elements have the same rules; an empty list means rule 0.
bool same_rules(const std::vector<RuleId>& a, const std::vector<RuleId>& b) {
  const auto is_default = [](RuleId rule) { return rule == 0; };
  if (a.empty()) return std::all_of(b.begin(), b.end(), is_default);
  if (b.empty()) return std::all_of(a.begin(), a.end(), is_default);
  return a == b;
}

void require_fitting(const EnergyTerm& term, Index full_size) {
  const ElementDofs& s = term.element_dofs();
  if (s.block < 1)
    throw InvalidArgument(
        fmt::format("term '{}': nodes of {} unknowns, at least 1 is needed", term.name(), s.block));
  if (const Index own = term.full_size(); own >= 0 && own != full_size)
    throw InvalidArgument(fmt::format(
        "term '{}': it is of {} unknowns, the problem has {}: give a number for each, 0 "
        "where there is none",
        term.name(), own, full_size));
  const Index nodes = full_size / s.block;
  for (Index e = 0; e < s.nodes.rows(); ++e)
    for (Index k = 0; k < s.nodes.cols(); ++k)
      if (s.nodes(e, k) < 0 || s.nodes(e, k) >= nodes)
        throw InvalidArgument(fmt::format(
            "term '{}': node {} of element {} is {}: the problem has {} unknowns, nodes 0 to {} of "
            "{} each",
            term.name(), k, e, s.nodes(e, k), full_size, nodes - 1, s.block));
}

// Tests the nodes of terms as ConstraintRows::expect_nodes() documents.
void require_expected_nodes(const ConstraintRows& rows, const Terms& terms) {
  for (const auto& expected : rows.expected_nodes()) {
    const EnergyTerm* other = nullptr;
    bool found = false;
    for (const auto& term : terms) {
      const int block = term->element_dofs().block;
      found = found || block == expected.unknowns_each;
      if (block > 1 && block != expected.unknowns_each) other = term.get();
    }
    if (other && !found)
      throw InvalidArgument(fmt::format(
          "{}, with {} unknowns each: the nodes of term '{}' have {}; {}", expected.what,
          expected.unknowns_each, other->name(), other->element_dofs().block, expected.remedy));
  }
}

}  // namespace

// The parts of a problem that depend only on its first terms.
struct LeadingTerms {
  std::size_t count;
  SparsePattern pattern;  // columns up to their last unknown
  std::vector<ScatterMap> slots;

  LeadingTerms(const Terms& terms, std::size_t first_terms, const Elimination& elimination)
      : count(first_terms), pattern(reduced_pattern(element_dofs(terms, 0, count), elimination)) {
    Index unknowns = 0;
    for (std::size_t k = 0; k < count; ++k) {
      slots.emplace_back(terms[k]->element_dofs(), elimination, pattern);
      const Index last = extent(*terms[k]);
      for (Index i = 0; i < last; ++i)
        for (const auto& e : elimination.row(i)) unknowns = std::max(unknowns, e.reduced + 1);
    }
    pattern.size = unknowns;
    pattern.column_starts.resize(to_size(unknowns) + 1);
    pattern.rows.resize(to_size(pattern.column_starts.back()));
  }
};

namespace {

// Returns the partition of the unknowns that remain after elimination.
Partition reduced_partition(const Partition* full, const Elimination& elimination) {
  if (!full || full->is_whole()) return Partition(elimination.reduced_size());
  bool single = elimination.auxiliary_size() == 0;
  for (Index i = 0; i < elimination.full_size(); ++i) {
    const Elimination::Row row = elimination.row(i);
    single = single && (row.size() == 0 || (row.size() == 1 && row.begin()->coefficient == 1 &&
                                            elimination.offset(i) == 0));
  }
  single = single && elimination.reduced_size() <= elimination.full_size();
  std::vector<Index> kept;
  for (Index j = 0; single && j < elimination.reduced_size(); ++j)
    kept.push_back(elimination.full_index(j));
  single = single && std::is_sorted(kept.begin(), kept.end());
  if (!full->all(single))
    throw InvalidArgument(
        "ProblemBuilder: constraints of a problem that several processes have may hold single "
        "unknowns, not tie them to each other");
  return full->part(kept);
}

}  // namespace

struct Problem::Structure {
  std::vector<std::shared_ptr<const EnergyTerm>> terms;
  std::vector<TermId> ids;
  std::vector<std::shared_ptr<const FeasibilityChecker>> checkers;
  Elimination elimination;
  SparsePattern pattern;
  std::vector<ScatterMap> slots;
  std::shared_ptr<const LeadingTerms> leading;  // those shared with the problem before
  Partition partition;
  std::shared_ptr<const ConstraintRows> rows = {};  // the eliminated rows

  // Returns the number of first terms that are those of `other`, on the same unknowns.
  std::size_t shared_terms(const Structure& other) const {
    std::size_t count = 0;
    while (count < terms.size() && count < other.terms.size() &&
           terms[count] == other.terms[count] &&
           elimination.begins_like(other.elimination, extent(*terms[count])))
      ++count;
    return count;
  }
};

Index Problem::full_size() const { return structure_->elimination.full_size(); }

Index Problem::size() const { return structure_->elimination.reduced_size(); }

std::span<const TermId> Problem::terms() const { return structure_->ids; }

const EnergyTerm& Problem::term(TermId id) const {
  require_term("Problem::term", id);
  return *structure_->terms[number(id)];
}

const TermState& Problem::state(TermId id) const {
  require_term("Problem::state", id);
  return states_[number(id)];
}

void Problem::require_term(std::string_view where, TermId id) const {
  if (number(id) >= states_.size())
    throw InvalidArgument(fmt::format("{}: no term of this problem has that id ({} of {})", where,
                                      number(id), states_.size()));
}

const SparsePattern& Problem::pattern() const { return structure_->pattern; }

const Partition& ProblemParts::partition(const Problem& problem) {
  return problem.structure_->partition;
}

ProblemBuilder ProblemParts::builder(std::shared_ptr<const Partition> partition) {
  return ProblemBuilder(std::move(partition));
}

const std::vector<std::shared_ptr<const FeasibilityChecker>>& Problem::checkers() const {
  return structure_->checkers;
}

const Elimination& ProblemParts::elimination(const Problem& problem) {
  return problem.structure_->elimination;
}

const ConstraintRows& ProblemParts::rows(const Problem& problem) {
  return *problem.structure_->rows;
}

const ColoredBatches& ProblemParts::plan(const Problem& problem, TermId id) {
  return *problem.plans_[number(id)];
}

const ScatterMap& ProblemParts::slots(const Problem& problem, TermId id) {
  return problem.structure_->slots[number(id)];
}

// Weights may be 0 but not negative: a negated energy is unbounded below, and none of its curvature
// models is definite.
void require_valid(const EnergyTerm& term, const TermState& state) {
  const auto refuse = [&](const std::string& what) {
    throw InvalidArgument(fmt::format("term '{}': {}", term.name(), what));
  };
  const Index count = term.element_dofs().element_count();
  const auto usable = [](double w) { return w >= 0 && std::isfinite(w); };
  if (!usable(state.weight))
    refuse(fmt::format("its weight is {:g}, finite and at least 0 is needed", state.weight));
  const Vec& w = state.element_weight;
  if (w.size() != 0 && w.size() != count)
    refuse(fmt::format("{} weights of elements for {} elements", w.size(), count));
  for (Index e = 0; e < w.size(); ++e)
    if (!usable(w[e]))
      refuse(fmt::format("the weight of element {} is {:g}, finite and at least 0 is needed", e,
                         w[e]));
  if (!state.element_rule.empty() && state.element_rule.size() != to_size(count))
    refuse(fmt::format("{} rules of elements for {} elements", state.element_rule.size(), count));
  for (std::size_t e = 0; e < state.element_rule.size(); ++e)
    if (state.element_rule[e] < 0 || state.element_rule[e] >= term.rule_count())
      refuse(fmt::format("the rule of element {} is {}, there are {}", e, state.element_rule[e],
                         term.rule_count()));
  const Index parameters = state.parameters.size();
  if (parameters != 0 && parameters != term.parameter_count())
    refuse(fmt::format("parameters: it takes {}, not {}", term.parameter_count(), parameters));
  if (!state.parameters.allFinite()) refuse("its parameters are not finite");
}

void require_curvature(std::string_view who, const Problem& problem, Curvature curvature) {
  for (const TermId k : problem.terms())
    if (!problem.term(k).supports(curvature))
      throw InvalidArgument(fmt::format("{}: term '{}' has no curvature model '{}'", who,
                                        problem.term(k).name(), curvature_name(curvature)));
}

bool Problem::supports(Curvature curvature) const {
  for (const auto& term : structure_->terms)
    if (!term->supports(curvature)) return false;
  return true;
}

namespace {

TermState changed(TermState state, TermChange change) {
  if (change.weight) state.weight = *change.weight;
  if (change.element_weight) state.element_weight = std::move(*change.element_weight);
  if (change.element_rule) state.element_rule = std::move(*change.element_rule);
  if (change.parameters) state.parameters = std::move(*change.parameters);
  return state;
}

}  // namespace

Problem Problem::with(TermChanges changes) const {
  Problem other = *this;
  for (auto& [id, change] : changes) {
    require_term("Problem::with", id);
    TermState state = changed(other.states_[number(id)], std::move(change));
    require_valid(term(id), state);
    if (!same_rules(state.element_rule, other.states_[number(id)].element_rule))
      other.plans_[number(id)] = std::make_shared<const ColoredBatches>(
          term(id).element_dofs(), state.element_rule, structure_->elimination);
    other.states_[number(id)] = std::move(state);
  }
  return other;
}

Vec Problem::expand(VecIn y) const {
  require_size("Problem::expand: y", y.size(), size());
  Vec x;
  structure_->elimination.expand(y, x);
  return x;
}

Vec Problem::reduce(VecIn x, double* residual) const {
  require_size("Problem::reduce: x", x.size(), full_size());
  return structure_->elimination.reduce(x, residual);
}

ProblemBuilder::ProblemBuilder(Index full_size) : full_size_(full_size) {
  require_at_least("ProblemBuilder: the number of unknowns", full_size, 0);
}

ProblemBuilder::ProblemBuilder(std::shared_ptr<const Partition> partition)
    : full_size_(given("ProblemBuilder: the partition", partition)->size()),
      partition_(std::move(partition)) {}

ProblemBuilder::AddedTerm ProblemBuilder::add(std::shared_ptr<const EnergyTerm> term,
                                              double weight) {
  TermState state;
  state.weight = weight;
  return add(std::move(term), std::move(state));
}

ProblemBuilder::AddedTerm ProblemBuilder::add(std::shared_ptr<const EnergyTerm> term,
                                              TermState state) {
  require_given("ProblemBuilder::add: the term", term);
  require_fitting(*term, full_size_);
  require_valid(*term, state);
  terms_.push_back(std::move(term));
  states_.push_back(std::move(state));
  return {*this, TermId(terms_.size() - 1)};
}

ProblemBuilder& ProblemBuilder::add(const Constraint& constraint) {
  constraint.append_rows(rows_);
  rows_.require_ended();
  return *this;
}

ProblemBuilder& ProblemBuilder::add(std::shared_ptr<const FeasibilityChecker> checker) {
  require_given("ProblemBuilder::add: the checker", checker);
  checkers_.push_back(std::move(checker));
  return *this;
}

Problem ProblemBuilder::build() const { return build_after(nullptr); }

Problem ProblemBuilder::build(const Problem& before) const { return build_after(&before); }

Problem ProblemBuilder::build_after(const Problem* before) const {
  require_expected_nodes(rows_, terms_);
  Problem::Structure s{terms_, {}, checkers_, Elimination(full_size_, rows_), {}, {}, {}, {}};
  s.partition = reduced_partition(partition_.get(), s.elimination);
  s.rows = std::make_shared<const ConstraintRows>(rows_);
  return Problem::assembled(std::move(s), states_, before);
}

Problem Problem::exchanged(
    const std::vector<std::pair<TermId, std::shared_ptr<const EnergyTerm>>>& terms,
    std::vector<std::shared_ptr<const FeasibilityChecker>> checkers) const {
  Structure s{structure_->terms,
              {},
              std::move(checkers),
              structure_->elimination,
              {},
              {},
              {},
              structure_->partition,
              structure_->rows};
  for (const auto& [id, term] : terms) {
    require_term("Problem::exchanged", id);
    require_given("Problem::exchanged: the term", term);
    require_fitting(*term, full_size());
    require_valid(*term, states_[number(id)]);
    s.terms[number(id)] = term;
  }
  for (const auto& checker : s.checkers) require_given("Problem::exchanged: a checker", checker);
  return assembled(std::move(s), states_, this);
}

Problem Problem::assembled(Structure s, std::vector<TermState> states, const Problem* before) {
  Problem problem;
  problem.states_ = std::move(states);
  const std::size_t count = s.terms.size(),
                    shared = before ? s.shared_terms(*before->structure_) : 0;
  s.pattern = reduced_pattern(element_dofs(s.terms, shared, count), s.elimination);
  if (shared > 0) {
    s.leading = before->structure_->leading;
    if (!s.leading || s.leading->count != shared)
      s.leading = std::make_shared<const LeadingTerms>(s.terms, shared, s.elimination);
    s.pattern.block_of = node_blocks(element_dofs(s.terms, 0, count), s.elimination);
    std::vector<Index> places;
    s.pattern = s.leading->pattern.joined(s.pattern, places);
    for (const ScatterMap& slots : s.leading->slots) s.slots.push_back(slots.moved(places));
  }
  for (std::size_t k = 0; k < count; ++k) {
    s.ids.push_back(TermId(k));
    const ElementDofs& element_dofs = s.terms[k]->element_dofs();
    if (k >= shared) s.slots.emplace_back(element_dofs, s.elimination, s.pattern);
    const bool same =
        k < shared && same_rules(before->states_[k].element_rule, problem.states_[k].element_rule);
    problem.plans_.push_back(
        same ? before->plans_[k]
             : std::make_shared<const ColoredBatches>(element_dofs, problem.states_[k].element_rule,
                                                      s.elimination));
  }
  problem.structure_ = std::make_shared<const Problem::Structure>(std::move(s));
  return problem;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
