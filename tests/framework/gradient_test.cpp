// Compares Evaluator::gradient with linearize() and finite differences; counts calls of terms.
#include <gtest/gtest.h>

#include "framework/barrier_chain.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"

namespace majorant {
namespace {

using test::QuadraticTerm;
using test::Random;
using test::Rows;

// A term that counts its calls.
class Spy final : public EnergyTerm {
 public:
  std::string_view name() const override { return "spy"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override { return c == Curvature::Exact; }
  void values(VecIn, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    std::fill_n(f.begin(), batch.elements.size(), 0.0);
  }
  void local(VecIn, const ElementBatch&, BlendedCurvature, const TermState&, Workspace&,
             LocalSystem& out) const override {
    ++(out.hessian ? with_hessian : without_hessian);
    std::fill_n(out.value, LocalSystem::stride, 0.0);
    std::fill_n(out.gradient, LocalSystem::stride, 0.0);
    if (out.hessian) std::fill_n(out.hessian, LocalSystem::stride, 0.0);
  }
  mutable int with_hessian = 0, without_hessian = 0;

 private:
  ElementDofs element_dofs_ = test::band_elements(3, 1, 1);
};

Problem random_problem(Random& random, int block) {
  const auto a = std::make_shared<const QuadraticTerm>(test::band_elements(3000, 3, block), random);
  const auto b = std::make_shared<const QuadraticTerm>(
      test::random_elements(random, 300, 2, 3002, block), random);
  TermState state;
  state.weight = 0.7;
  state.element_weight = random.vector(3000, 0, 2);
  for (int e = 0; e < 3000; ++e) state.element_rule.push_back(random.integer(0, 3));
  Rows rows;
  rows.row({{0, 1}, {3, -1}}, 0.25)
      .row({{1, 1}, {4, 1}, {7, -1}}, -1)
      .row({{2, 2}, {5, -3}}, 0.5)
      .row({{900, 1}, {1700, 1}}, 0);
  return ProblemBuilder(3002 * block).add(a, state).add(b, 3).add(rows).build();
}

class Gradient : public testing::TestWithParam<int> {};  // unknowns per node

TEST_P(Gradient, IsThatOfLinearizeToTheLastBitForAnyNumberOfThreads) {
  Random random(1);
  const Problem problem = random_problem(random, GetParam());
  const Vec y = random.vector(problem.size());
  Vec reference, hessian;
  const double energy = Evaluator(problem).linearize(y, Curvature::Exact, reference, hessian);
  for (int count = 1; count <= 4; ++count) {
    const ThreadCount threads(count);
    Evaluator evaluator(problem);
    Vec g = Vec::Constant(3, 7);  // size and contents do not matter
    EXPECT_EQ(evaluator.gradient(y, g), energy);
    EXPECT_EQ(g, reference);
    EXPECT_EQ(evaluator.gradient(y, g), energy) << "scratch is reused";
    EXPECT_EQ(g, reference);
  }
}

INSTANTIATE_TEST_SUITE_P(Blocks, Gradient, testing::Values(1, 2));

TEST(Gradient, IsTheDerivativeOfTheValue) {
  const test::ChainProblem chain(6);
  Evaluator evaluator(chain.problem);
  Vec g;
  evaluator.gradient(chain.start, g);
  Vec y = chain.start;
  for (Index i = 0; i < y.size(); ++i) {
    const double h = 1e-7, here = y[i];
    y[i] = here + h;
    const double above = evaluator.value(y);
    y[i] = here - h;
    EXPECT_NEAR((above - evaluator.value(y)) / (2 * h), g[i], 1e-6 * g.norm());
    y[i] = here;
  }
}

TEST(Gradient, NeedsNoHessianAndIsCounted) {
  const auto spy = std::make_shared<const Spy>();
  Evaluator evaluator(ProblemBuilder(3).add(spy, 1).build());
  Vec g, h;
  evaluator.gradient(Vec::Zero(3), g);
  EXPECT_EQ(spy->with_hessian, 0);
  EXPECT_EQ(spy->without_hessian, 1);
  evaluator.linearize(Vec::Zero(3), Curvature::Exact, g, h);
  EXPECT_EQ(spy->with_hessian, 1);
  evaluator.gradient(Vec::Zero(3), g);
  EXPECT_EQ(spy->with_hessian, 1);
  EXPECT_EQ(evaluator.counters().gradients, 2);
  EXPECT_EQ(evaluator.counters().linearizations, 1);
  EXPECT_EQ(evaluator.counters().values, 0);
  EXPECT_GT(evaluator.counters().gradient_seconds, 0);
}

}  // namespace
}  // namespace majorant

// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the majorant developers
