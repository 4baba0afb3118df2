// Wrong calls of functions that make and evaluate problems.
#include <cmath>
#include <limits>
#include <memory>

#include "framework/scalar_terms.h"
#include "majorant/framework/cholmod_solver.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/terms/quadratic_penalty.h"
#include "misuse/outcome.h"

namespace majorant::misuse {
namespace problem_calls {

using test::Chain;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::shared_ptr<const EnergyTerm> term(Index count = 5) {
  return std::make_shared<const Chain>(count, test::parabola(1, 0));
}

Problem problem() {
  ProblemBuilder builder(5);
  builder.add(term(), 1.0);
  return builder.build();
}

struct Rows final : Constraint {
  explicit Rows(std::function<void(ConstraintRows&)> f) : append(std::move(f)) {}
  void append_rows(ConstraintRows& rows) const override { append(rows); }
  std::function<void(ConstraintRows&)> append;
};

void build(const std::function<void(ConstraintRows&)>& append) {
  ProblemBuilder builder(5);
  builder.add(term(), 1.0).add(Rows(append)).build();
}

void with_state(const std::function<void(TermState&)>& change) {
  TermState state;
  change(state);
  ProblemBuilder(5).add(term(), state);
}

void with_later_state(const std::function<void(TermState&)>& change) {
  TermState state;
  change(state);
  const Problem p = problem();
  p.with({{p.terms().front(), state}});
}

struct Nodes final : EnergyTerm {
  explicit Nodes(ElementDofs s) : s_(std::move(s)) {}
  std::string_view name() const override { return "nodes"; }
  const ElementDofs& element_dofs() const override { return s_; }
  bool supports(Curvature) const override { return true; }
  void values(VecIn, const ElementBatch&, const TermState&, Workspace&,
              std::span<double>) const override {}
  void local(VecIn, const ElementBatch&, BlendedCurvature, const TermState&, Workspace&,
             LocalSystem&) const override {}
  ElementDofs s_;
};

void with_nodes(std::initializer_list<Index> nodes, int block) {
  ElementDofs s{Cells(1, static_cast<Index>(nodes.size())), block};
  std::copy(nodes.begin(), nodes.end(), s.nodes.data());
  ProblemBuilder(5).add(std::make_shared<const Nodes>(s), 1.0);
}

SparsePattern pattern() {
  SparsePattern p;
  p.append_column({1});
  p.append_column({});
  p.order_in_blocks(1);
  return p;
}

void analyze(const std::function<void(SparsePattern&)>& change) {
  SparsePattern p = pattern();
  change(p);
  make_direct_solver()->analyze(p);
}

void solve(const Vec& values, const Vec& r) {
  const SparsePattern p = pattern();
  const auto solver = make_direct_solver();
  solver->analyze(p);
  solver->factorize(values, 0);
  Vec x;
  solver->solve(r, x);
}

void solve_ldlt(const Vec& values, const Vec& r) {
  const SparsePattern p = pattern();
  const auto solver = make_eigen_ldlt_solver();
  solver->analyze(p);
  solver->factorize(values, 0);
  Vec x;
  solver->solve(r, x);
}

const std::vector<Call> kCalls{
    {"null_term", "InvalidArgument: ProblemBuilder::add: the term is null",
     [] { ProblemBuilder(5).add(std::shared_ptr<const EnergyTerm>(), 1.0); }},
    {"null_checker", "InvalidArgument: ProblemBuilder::add: the checker is null",
     [] { ProblemBuilder(5).add(std::shared_ptr<const FeasibilityChecker>()); }},
    {"negative_unknowns", "InvalidArgument: ProblemBuilder: the number of unknowns is -1",
     [] { ProblemBuilder(-1); }},
    {"stencil_too_large", "InvalidArgument: term 'chain': node 0 of element 5 is 5",
     [] { ProblemBuilder(5).add(term(6), 1.0); }},
    {"stencil_negative", "InvalidArgument: term 'nodes': node 1 of element 0 is -2",
     [] {
       with_nodes({0, -2}, 1);
     }},
    {"stencil_block_too_large", "InvalidArgument: term 'nodes': node 1 of element 0 is 2",
     [] {
       with_nodes({0, 2}, 2);
     }},
    {"stencil_overflow", "InvalidArgument: term 'nodes': node 0 of element 0 is 2147483647",
     [] { with_nodes({std::numeric_limits<Index>::max()}, 2); }},
    {"no_block", "InvalidArgument: term 'nodes': nodes of 0 unknowns", [] { with_nodes({0}, 0); }},
    {"negative_weight", "InvalidArgument: term 'chain': its weight is -1",
     [] { ProblemBuilder(5).add(term(), -1.0); }},
    {"nan_weight", "InvalidArgument: term 'chain': its weight is nan",
     [] { ProblemBuilder(5).add(term(), kNan); }},
    {"infinite_weight", "InvalidArgument: term 'chain': its weight is inf",
     [] { ProblemBuilder(5).add(term(), kInf); }},
    {"few_element_weights", "InvalidArgument: term 'chain': 3 weights of elements for 5 elements",
     [] { with_state([](TermState& s) { s.element_weight = Vec::Ones(3); }); }},
    {"negative_element_weight", "InvalidArgument: term 'chain': the weight of element 4 is -2",
     [] {
       with_state([](TermState& s) { s.element_weight = Vec::Ones(5), s.element_weight[4] = -2; });
     }},
    {"few_element_rules", "InvalidArgument: term 'chain': 2 rules of elements for 5 elements",
     [] { with_state([](TermState& s) {
            s.element_rule = {0, 0};
          }); }},
    {"rule_out_of_range", "InvalidArgument: term 'chain': the rule of element 1 is 7, there are 1",
     [] { with_state([](TermState& s) {
            s.element_rule = {0, 7, 0, 0, 0};
          }); }},
    {"parameters_of_none", "InvalidArgument: term 'chain': parameters: it takes 0, not 1",
     [] { with_state([](TermState& s) { s.parameters = Vec::Constant(1, kNan); }); }},
    {"with_negative_weight", "InvalidArgument: term 'chain': its weight is -3",
     [] { with_later_state([](TermState& s) { s.weight = -3; }); }},
    {"with_few_element_weights", "InvalidArgument: term 'chain': 4 weights of elements",
     [] { with_later_state([](TermState& s) { s.element_weight = Vec::Ones(4); }); }},
    {"with_long_element_rules", "InvalidArgument: term 'chain': 6 rules of elements",
     [] { with_later_state([](TermState& s) { s.element_rule.assign(6, 0); }); }},
    {"with_unknown_term", "InvalidArgument: Problem::with: no term of this problem has that id",
     [] {
       problem().with({{TermId(3), {}}});
     }},
    {"unknown_term", "InvalidArgument: Problem::term: no term", [] { problem().term(TermId(1)); }},
    {"unknown_state", "InvalidArgument: Problem::state: no term",
     [] { problem().state(TermId(1)); }},
    {"reduce_short", "InvalidArgument: Problem::reduce: x has 4 numbers, 5 are needed",
     [] { problem().reduce(Vec::Zero(4)); }},
    {"expand_long", "InvalidArgument: Problem::expand: y has 6 numbers, 5 are needed",
     [] { problem().expand(Vec::Zero(6)); }},
    {"open_row", "InvalidArgument: constraint row 'mine' was begun, but not ended",
     [] { build([](ConstraintRows& r) { r.begin_row("mine"), r.add(0, 1); }); }},
    {"row_begun_twice", "InvalidArgument: constraint row 'a' was begun, but not ended",
     [] { build([](ConstraintRows& r) { r.begin_row("a"), r.begin_row("b"); }); }},
    {"entry_without_row", "InvalidArgument: ConstraintRows::add: no row was begun",
     [] { build([](ConstraintRows& r) { r.add(0, 1); }); }},
    {"end_without_row", "InvalidArgument: ConstraintRows::end_row: no row was begun",
     [] { build([](ConstraintRows& r) { r.end_row(1); }); }},
    {"nan_right_hand_side", "InvalidArgument: constraint row 'a': its right-hand side is nan",
     [] { build([](ConstraintRows& r) { r.begin_row("a"), r.add(0, 1), r.end_row(kNan); }); }},
    {"row_out_of_range", "InvalidArgument: constraint row 'a': unknown 5 does not exist",
     [] { build([](ConstraintRows& r) { r.begin_row("a"), r.add(5, 1), r.end_row(0); }); }},
    {"unknown_auxiliary", "InvalidArgument: constraint row 'a': unknown -1 does not exist",
     [] { build([](ConstraintRows& r) { r.begin_row("a"), r.add(-1, 1), r.end_row(0); }); }},
    {"contradiction", "Error Unsupported: constraints contradict each other: row 'b' is off by",
     [] {
       build([](ConstraintRows& r) {
         r.begin_row("a"), r.add(0, 1), r.end_row(1);
         r.begin_row("b"), r.add(0, 1), r.end_row(2);
       });
     }},
    {"empty_row_not_zero", "Error Unsupported: constraints contradict each other: row 'a'",
     [] { build([](ConstraintRows& r) { r.begin_row("a"), r.end_row(1); }); }},
    {"penalty_of_open_row", "InvalidArgument: constraint row 'a' was begun, but not ended",
     [] { QuadraticPenalty(Rows([](ConstraintRows& r) { r.begin_row("a"), r.add(0, 1); })); }},
    {"penalty_without_unknowns", "InvalidArgument: QuadraticPenalty: a row of 0 unknowns",
     [] {
       QuadraticPenalty(std::vector<LinearExpression>{{{}, 1}});
     }},
    {"penalty_negative_unknown", "InvalidArgument: QuadraticPenalty: unknown -1",
     [] {
       QuadraticPenalty(std::vector<LinearExpression>{{{{-1, 1.0}}, 1}});
     }},
    {"penalty_nan_coefficient", "InvalidArgument: QuadraticPenalty: unknown 0 with coefficient nan",
     [] {
       QuadraticPenalty(std::vector<LinearExpression>{{{{0, kNan}}, 1}});
     }},
    {"penalty_nan_target", "InvalidArgument: QuadraticPenalty: a target is not finite",
     [] {
       QuadraticPenalty(std::vector<LinearExpression>{{{{0, 1.0}}, kNan}});
     }},
    {"penalty_auxiliary",
     "InvalidArgument: QuadraticPenalty: the constraint has auxiliary unknowns",
     [] {
       QuadraticPenalty(Rows([](ConstraintRows& r) {
         const Index a = r.add_auxiliary();
         r.begin_row("a"), r.add(a, 1), r.end_row(0);
       }));
     }},
    {"value_of_x", "InvalidArgument: Evaluator::value: y has 7 numbers, 5 are needed",
     [] { Evaluator(problem()).value(Vec::Zero(7)); }},
    {"gradient_of_nothing", "InvalidArgument: Evaluator::gradient: y has 0 numbers",
     [] {
       Vec g;
       Evaluator(problem()).gradient(Vec(), g);
     }},
    {"linearize_short", "InvalidArgument: Evaluator::linearize: y has 1 numbers",
     [] {
       Vec g, h;
       Evaluator(problem()).linearize(Vec::Zero(1), Curvature::Exact, g, h);
     }},
    {"linearize_without_model",
     "InvalidArgument: Evaluator::linearize: term 'random quadratics' has no curvature model "
     "'reweighted'",
     [] {
       test::Random random(1);
       ProblemBuilder builder(5);
       builder.add(
           std::make_shared<const test::QuadraticTerm>(test::band_elements(5, 1, 1), random), 1.0);
       Vec g, h;
       Evaluator(builder.build()).linearize(Vec::Zero(5), Curvature::Reweighted, g, h);
     }},
    {"projection_weight_out_of_range",
     "InvalidArgument: Evaluator::linearize: the projection weight of a curvature",
     [] {
       Vec g, h;
       Evaluator(problem()).linearize(Vec::Zero(5), BlendedCurvature::projected(2.5), g, h);
     }},
    {"violation_short", "InvalidArgument: Evaluator::violation: x has 2 numbers",
     [] { Evaluator(problem()).violation(Vec::Zero(2)); }},
    {"element_values_short", "InvalidArgument: element_values: x has 2 numbers",
     [] { element_values(problem(), TermId(0), Vec::Zero(2)); }},
    {"term_energy_unknown_term", "InvalidArgument: Problem::state: no term",
     [] { term_energy(problem(), TermId(9), Vec::Zero(5)); }},
    {"derivatives_of_short_x", "InvalidArgument: check_derivatives: x has 3 numbers",
     [] { check_derivatives(*term(), Vec::Zero(3)); }},
    {"derivatives_with_short_state", "InvalidArgument: term 'chain': 1 rules of elements",
     [] {
       TermState state;
       state.element_rule = {0};
       check_derivatives(*term(), Vec::Zero(5), 1e-5, state);
     }},
    {"pattern_entry_missing", "InvalidArgument: SparsePattern::slot: there is no entry (3, 0)",
     [] { pattern().slot(3, 0); }},
    {"pattern_column_missing", "InvalidArgument: SparsePattern::slot: column 2 does not exist",
     [] { pattern().slot(3, 2); }},
    {"pattern_row_above", "InvalidArgument: SparsePattern::append_column: row 0 is not below",
     [] { pattern().append_column({0}); }},
    {"pattern_without_blocks", "InvalidArgument: sparse pattern: 0 blocks for 2 unknowns",
     [] { analyze([](SparsePattern& p) { p.block_of.clear(); }); }},
    {"pattern_unsorted", "InvalidArgument: sparse pattern: column 0 is not its diagonal",
     [] { analyze([](SparsePattern& p) { std::swap(p.rows[0], p.rows[1]); }); }},
    {"pattern_row_outside", "InvalidArgument: sparse pattern: column 0 is not its diagonal",
     [] { analyze([](SparsePattern& p) { p.rows[1] = 9; }); }},
    {"pattern_starts", "InvalidArgument: sparse pattern: 2 starts of columns",
     [] { analyze([](SparsePattern& p) { p.column_starts.pop_back(); }); }},
    {"blocks_of_nothing", "InvalidArgument: SparsePattern::order_in_blocks: block is 0",
     [] { pattern().order_in_blocks(0); }},
    {"few_values", "InvalidArgument: LinearSolver::factorize: values has 2 numbers, 3 are needed",
     [] { solve(Vec::Ones(2), Vec::Ones(2)); }},
    {"long_right_hand_side", "InvalidArgument: LinearSolver::solve: r has 3 numbers, 2 are needed",
     [] { solve(Eigen::Vector3d(2, -1, 2), Vec::Ones(3)); }},
    {"ldlt_few_values", "InvalidArgument: LinearSolver::factorize: values has 1 numbers",
     [] { solve_ldlt(Vec::Ones(1), Vec::Ones(2)); }},
    {"ldlt_short_right_hand_side", "InvalidArgument: LinearSolver::solve: r has 1 numbers",
     [] { solve_ldlt(Eigen::Vector3d(2, -1, 2), Vec::Ones(1)); }},
    {"cholmod_few_values", "InvalidArgument: LinearSolver::factorize: values has 2 numbers",
     [] {
       const SparsePattern p = pattern();
       const auto solver = make_cholmod_solver();
       solver->analyze(p);
       solver->factorize(Vec::Ones(2), 0);
     }},
    {"cholmod_before_an_analysis", "InvalidArgument: LinearSolver::solve: r has 1 numbers",
     [] {
       Vec p;
       make_cholmod_solver()->solve(Vec::Ones(1), p);
     }},
    {"cholmod_pattern_without_blocks", "InvalidArgument: sparse pattern: 0 blocks for 2 unknowns",
     [] {
       SparsePattern p = pattern();
       p.block_of.clear();
       make_cholmod_solver()->analyze(p);
     }},
    {"shifted_few_values", "InvalidArgument: factorize_shifted: values has 0 numbers",
     [] {
       const SparsePattern p = pattern();
       const auto solver = make_direct_solver();
       solver->analyze(p);
       factorize_shifted(*solver, p, Vec());
     }},
    {"negative_threads", "InvalidArgument: ThreadCount: -2 threads", [] { ThreadCount t(-2); }},
};

}  // namespace problem_calls

class ProblemCalls : public Misuse {};
TEST_P(ProblemCalls, IsRefused) { expect_refusal(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Table, ProblemCalls, testing::ValuesIn(problem_calls::kCalls), name_of);

}  // namespace majorant::misuse

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
