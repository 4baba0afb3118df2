// Compares the assembled reduced system with dense Z^T H Z and Z^T g.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "framework/quadratic_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/problem_parts.h"

namespace majorant {
namespace {

using test::QuadraticTerm;
using test::Random;
using test::Rows;

Eigen::MatrixXd dense(const SparsePattern& p, const Vec& values) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(p.size, p.size);
  for (Index c = 0; c < p.size; ++c)
    for (Index k = p.column_starts[static_cast<std::size_t>(c)];
         k < p.column_starts[static_cast<std::size_t>(c) + 1]; ++k) {
      const Index r = p.rows[static_cast<std::size_t>(k)];
      m(r, c) = m(c, r) = values[k];
    }
  return m;
}

using TermList = std::vector<std::shared_ptr<const QuadraticTerm>>;

void expect_matches_dense(const Problem& problem, const TermList& terms, Random& random) {
  const Vec y = random.vector(problem.size());
  const Vec x = problem.expand(y);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(x.size(), x.size());
  Vec g = Vec::Zero(x.size());
  for (std::size_t k = 0; k < terms.size(); ++k)
    terms[k]->add_dense(x, problem.state(problem.terms()[k]), h, g);
  const Eigen::MatrixXd z = test::dense_z(ProblemParts::elimination(problem));

  Evaluator evaluator(problem);
  Vec gradient, values;
  const double f = evaluator.linearize(y, Curvature::Exact, gradient, values);
  const double scale = 1 + (z.transpose() * h * z).norm();
  EXPECT_LE((dense(problem.pattern(), values) - z.transpose() * h * z).norm(), 1e-13 * scale);
  EXPECT_LE((gradient - z.transpose() * g).norm(), 1e-13 * (1 + g.norm() * z.norm()));
  EXPECT_NEAR(f, evaluator.value(y), 1e-12 * (1 + std::abs(f)));
}

// Returns the lower triangle of the union of cliques, plus the diagonal, from Z and the
// element_dofs.
Eigen::MatrixXi structure(const Problem& problem, const TermList& terms) {
  const Eigen::MatrixXd z = test::dense_z(ProblemParts::elimination(problem));
  Eigen::MatrixXi s = Eigen::MatrixXi::Identity(problem.size(), problem.size());
  for (const auto& term : terms)
    for (Index e = 0; e < term->element_dofs().element_count(); ++e)
      for (int i = 0; i < term->element_dofs().local_size(); ++i)
        for (int j = 0; j < term->element_dofs().local_size(); ++j)
          for (Index p = 0; p < problem.size(); ++p)
            for (Index q = 0; q <= p; ++q)
              if (z(term->full(e, i), p) != 0 && z(term->full(e, j), q) != 0) s(p, q) = 1;
  return s;
}

void expect_exact_pattern(const Problem& problem, const TermList& terms) {
  const SparsePattern& p = problem.pattern();
  ASSERT_EQ(p.size, problem.size());
  ASSERT_EQ(p.column_starts.size(), static_cast<std::size_t>(p.size) + 1);
  ASSERT_EQ(p.block_of.size(), static_cast<std::size_t>(p.size));
  ASSERT_EQ(p.column_starts.back(), p.nonzeros());
  Eigen::MatrixXi found = Eigen::MatrixXi::Zero(p.size, p.size);
  for (Index c = 0; c < p.size; ++c) {
    const auto first = p.rows.begin() + p.column_starts[static_cast<std::size_t>(c)];
    const auto last = p.rows.begin() + p.column_starts[static_cast<std::size_t>(c) + 1];
    ASSERT_NE(first, last);
    EXPECT_EQ(*first, c);
    EXPECT_TRUE(std::adjacent_find(first, last, std::greater_equal<>()) == last);
    for (auto r = first; r != last; ++r) found(*r, c) = 1;
  }
  const Eigen::MatrixXi lower = structure(problem, terms).triangularView<Eigen::Lower>();
  EXPECT_EQ(found, lower);
}

class Assembly : public testing::TestWithParam<int> {};  // unknowns per node

TEST_P(Assembly, Unconstrained) {
  Random random(1);
  const int block = GetParam();
  const auto term = std::make_shared<const QuadraticTerm>(
      test::random_elements(random, 40, 3, 12, block), random);  // repeats nodes within elements
  const Problem problem = ProblemBuilder(12 * block).add(term, 2.5).build();
  expect_matches_dense(problem, {term}, random);
  expect_exact_pattern(problem, {term});
}

TEST_P(Assembly, ManyBatches) {
  Random random(2);
  const int block = GetParam();
  const auto term =
      std::make_shared<const QuadraticTerm>(test::band_elements(300, 4, block), random);
  const Problem problem = ProblemBuilder(303 * block).add(term, 1.0).build();
  EXPECT_GT(ProblemParts::plan(problem, problem.terms().front()).batch_count(), 2);
  expect_matches_dense(problem, {term}, random);
}

// Rows of Z have several entries, negative and fractional coefficients, and unknowns that occur
// twice in one element.
TEST_P(Assembly, GeneralConstraints) {
  Random random(3);
  const int block = GetParam();
  const Index size = 12 * block;
  const auto term = std::make_shared<const QuadraticTerm>(
      test::random_elements(random, 30, 4, 12, block), random);
  Rows rows;
  rows.row({{0, 1}, {3, -1}}, 0.25)
      .row({{1, 1}, {4, 1}, {7, -1}}, -1)
      .row({{2, 2}, {5, -3}}, 0.5)
      .row({{6, 1}}, 3)
      .row({{8, 1}, {9, 1}, {10, 1}, {0, -1}}, 0);
  const Problem problem = ProblemBuilder(size).add(term, 1.5).add(rows).build();
  EXPECT_EQ(problem.size(), size - 5);
  expect_matches_dense(problem, {term}, random);
  expect_exact_pattern(problem, {term});
}

// Some unknowns of a node are fixed. If it is the first node, its next unknown has number 0.
TEST_P(Assembly, NodesThatAreFixedInPart) {
  Random random(7);
  const int block = GetParam();
  for (const Index fixed : {0, 1, 2 * block, 3 * block - 1}) {
    const auto term = std::make_shared<const QuadraticTerm>(
        test::random_elements(random, 30, 4, 12, block), random);
    Rows rows;
    rows.row({{fixed, 1}}, 0.5);
    const Problem problem = ProblemBuilder(12 * block).add(term, 1.5).add(rows).build();
    expect_matches_dense(problem, {term}, random);
    expect_exact_pattern(problem, {term});
  }
}

// Tests that build(before), which reuses parts of an earlier problem, equals a new build.
void expect_same_problem(const Problem& found, const Problem& expected, Random& random) {
  EXPECT_EQ(found.pattern().column_starts, expected.pattern().column_starts);
  EXPECT_EQ(found.pattern().rows, expected.pattern().rows);
  EXPECT_EQ(found.pattern().block_of, expected.pattern().block_of);
  const Vec y = random.vector(expected.size());
  Vec gradient[2], values[2];
  Evaluator(found).linearize(y, Curvature::Exact, gradient[0], values[0]);
  Evaluator(expected).linearize(y, Curvature::Exact, gradient[1], values[1]);
  EXPECT_EQ(gradient[0], gradient[1]);
  EXPECT_EQ(values[0], values[1]);
}

TEST_P(Assembly, TakesOverTheTermsThatStay) {
  Random random(7);
  const int block = GetParam();
  const auto stays = std::make_shared<const QuadraticTerm>(
      test::random_elements(random, 200, 3, 20, block), random);
  Rows rows;
  rows.row({{0, 1}, {7, -1}}, 0).row({{3, 1}}, 1);
  Problem before;
  // First more nodes than in the earlier problem, then fewer; equal and other edges among its
  // nodes.
  for (const Index nodes : {24, 30, 30, 22}) {
    const auto changes = std::make_shared<const QuadraticTerm>(
        test::random_elements(random, 40, 2, nodes, block), random);
    TermState state;
    state.element_rule.assign(200, 0);  // the default, explicitly
    Rows last;
    last.row({{block * nodes - 1, 1}}, 2);
    ProblemBuilder builder(nodes * block);
    builder.add(stays, state).add(changes, 2.0).add(rows).add(last);
    const Problem expected = builder.build();
    const Problem found = nodes == 24 ? expected : builder.build(before);
    expect_same_problem(found, expected, random);
    if (nodes != 24) {
      EXPECT_EQ(&ProblemParts::plan(found, found.terms().front()),
                &ProblemParts::plan(before, before.terms().front()));
    }
    before = found;
  }
}

TEST_P(Assembly, TakesNothingOverWhereUnknownsAreOthers) {
  Random random(8);
  const int block = GetParam();
  const auto term = std::make_shared<const QuadraticTerm>(
      test::random_elements(random, 50, 3, 20, block), random);
  Rows rows;
  rows.row({{3, 1}}, 1);
  ProblemBuilder free(20 * block), held(20 * block);
  free.add(term, 1.0);
  held.add(term, 1.0).add(rows);
  const Problem before = free.build(free.build());
  expect_same_problem(held.build(before), held.build(), random);
}

TEST_P(Assembly, SeveralTermsWeightsAndRules) {
  Random random(4);
  const int block = GetParam();
  const auto a = std::make_shared<const QuadraticTerm>(
      test::random_elements(random, 200, 3, 20, block), random);
  const auto b = std::make_shared<const QuadraticTerm>(
      test::random_elements(random, 9, 2, 20 * block, 1), random);
  TermState state;
  state.weight = 0.5;
  state.element_weight = random.vector(200, 0, 2);
  for (int e = 0; e < 200; ++e) state.element_rule.push_back(random.integer(0, 3));
  Rows rows;
  rows.row({{0, 1}, {7, -1}}, 0).row({{3, 1}}, 1);
  ProblemBuilder builder(20 * block);
  const TermId first = builder.add(a, state);
  const TermId second = builder.add(b, 3);
  const Problem problem = builder.add(rows).build();
  expect_matches_dense(problem, {a, b}, random);
  expect_exact_pattern(problem, {a, b});

  std::reverse(state.element_rule.begin(), state.element_rule.end());
  TermState other;
  other.weight = 7;
  const Problem one = problem.with({{second, other}});
  EXPECT_EQ(one.state(second).weight, 7);
  EXPECT_EQ(one.state(first).element_rule, problem.state(first).element_rule) << "kept";
  expect_matches_dense(one, {a, b}, random);
  const Problem changed = one.with({{first, state}});
  EXPECT_EQ(changed.state(second).weight, 7);
  EXPECT_EQ(changed.state(first).element_rule, state.element_rule);
  EXPECT_TRUE(changed.same_structure(problem));
  expect_matches_dense(changed, {a, b}, random);
  EXPECT_THROW(problem.with({{TermId(2), other}}), InvalidArgument);
  expect_matches_dense(problem, {a, b}, random);  // unchanged
}

INSTANTIATE_TEST_SUITE_P(Blocks, Assembly, testing::Values(1, 2));

TEST(Assembly, BlocksHoldTheUnknownsOfOneNode) {
  Random random(5);
  const auto term = std::make_shared<const QuadraticTerm>(test::band_elements(6, 2, 2), random);
  Rows rows;
  rows.row({{3, 1}}, 0);
  const Problem problem = ProblemBuilder(14).add(term, 1).add(rows).build();
  const Elimination& z = ProblemParts::elimination(problem);
  for (Index i = 0; i < problem.size(); ++i)
    for (Index j = 0; j < problem.size(); ++j)
      EXPECT_EQ(problem.pattern().block_of[static_cast<std::size_t>(i)] ==
                    problem.pattern().block_of[static_cast<std::size_t>(j)],
                z.full_index(i) / 2 == z.full_index(j) / 2);
}

TEST(Assembly, ElementsOutsideTheUnknownsAreRefused) {
  Random random(6);
  const auto term = std::make_shared<const QuadraticTerm>(test::band_elements(6, 2, 2), random);
  EXPECT_THROW(ProblemBuilder(13).add(term, 1).build(), InvalidArgument);
  EXPECT_NO_THROW(ProblemBuilder(14).add(term, 1).build());
}

TEST(Assembly, SupportNeedsEveryTerm) {
  Random random(7);
  const auto term = std::make_shared<const QuadraticTerm>(test::band_elements(6, 2, 1), random);
  const Problem problem = ProblemBuilder(7).add(term, 1).build();
  EXPECT_TRUE(problem.supports(Curvature::Exact));
  EXPECT_FALSE(problem.supports(Curvature::Reweighted));
}

// An element with value +inf on request.
class Wall final : public EnergyTerm {
 public:
  std::string_view name() const override { return "wall"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature) const override { return true; }
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p)
      f[p] = x[batch.elements[p]] < 0 ? std::numeric_limits<double>::infinity() : 1.0;
  }
  void local(VecIn, const ElementBatch&, BlendedCurvature, const TermState&, Workspace&,
             LocalSystem&) const override {}

 private:
  ElementDofs element_dofs_ = test::band_elements(2, 1, 1);
};

TEST(Assembly, InfinityIsPassedOnAndNeverTurnsIntoNaN) {
  const auto wall = std::make_shared<const Wall>();
  EXPECT_EQ(Evaluator(ProblemBuilder(2).add(wall, 3.0).build()).value(Vector2(1, 1)), 6.0);
  EXPECT_EQ(Evaluator(ProblemBuilder(2).add(wall, 3.0).build()).value(Vector2(1, -1)),
            std::numeric_limits<double>::infinity());
  TermState masked;
  masked.element_weight = Vector2(1, 0);
  const double f = Evaluator(ProblemBuilder(2).add(wall, masked).build()).value(Vector2(1, -1));
  EXPECT_FALSE(std::isnan(f)) << "0 * inf";
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
