// Data of lambda terms that change between steps; Hessians, factors and gradients of single terms
// as matrices and vectors.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/hessian_factor.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/residuals.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"
#include "random.h"

namespace majorant {
namespace {

constexpr Index kCount = 300;

// Returns springs from each node to its left neighbour, each with its own length.
std::shared_ptr<const EnergyTerm> chain(const Vec& lengths) {
  Cells pairs(kCount, 2);
  for (Index e = 0; e < kCount; ++e) pairs.row(e) << e, e + 1;
  return make_term<2>(
      "chain", pairs,
      [](Index e, const auto& z, const auto& length) {
        const auto part = z[1] - z[0] - length[e];
        return part * part;
      },
      lengths);
}

ProblemBuilder held() { return std::move(ProblemBuilder(kCount + 1).add(FixedUnknowns({{0, 0}}))); }

TEST(TermData, AVectorIsPassedWholeAndMayChange) {
  test::Random random(3);
  const Vec first = random.vector(kCount, 0.5, 1.5), second = random.vector(kCount, 0.5, 1.5);
  ProblemBuilder builder = held();
  const TermId id = builder.add(chain(first), 10.0);
  const Problem problem = builder.build();
  const auto end = [](const Problem& p) {
    const SolveResult r = NewtonMinimizer().minimize(p, Vec::Zero(p.size()), {});
    return p.expand(r.y)[kCount];
  };
  EXPECT_NEAR(end(problem), first.sum(), 1e-9);
  const Problem other = problem.with({{id, {.parameters = second}}});
  EXPECT_TRUE(other.same_structure(problem));
  EXPECT_EQ(other.state(id).weight, 10.0);
  EXPECT_NEAR(end(other), second.sum(), 1e-9);
  EXPECT_NEAR(end(problem), first.sum(), 1e-9);  // the problem is unchanged
}

TEST(TermData, EveryElementGetsItsRowOfAMatrix) {
  const Index count = 7;
  RowMatrix line(count, 2);
  for (Index e = 0; e < count; ++e) line.row(e) << e, 3 + 2 * e;
  const Cells both = Cells::Ones(count, 1) * Eigen::RowVector2i(0, 1);
  const auto fit = make_least_squares<2>(
      "line", both,
      [](Index, const auto& z, const auto& sample) { return z[0] + z[1] * sample[0] - sample[1]; },
      line);
  ProblemBuilder builder(2);
  const TermId id = builder.add(fit, 1.0);
  const Problem problem = builder.build();
  const Vec at = NewtonMinimizer().minimize(problem, Vec::Zero(2), {}).y;
  EXPECT_NEAR(at[0], 3, 1e-9);
  EXPECT_NEAR(at[1], 2, 1e-9);
  line.col(1) *= -1;
  const Vec numbers = line.reshaped<Eigen::RowMajor>();
  const Vec turned =
      NewtonMinimizer().minimize(problem.with({{id, {.parameters = numbers}}}), Vec::Zero(2), {}).y;
  EXPECT_NEAR(turned[0], -3, 1e-9);
  EXPECT_NEAR(turned[1], -2, 1e-9);
  const TermState state{.parameters = numbers};
  EXPECT_TRUE(check_derivatives(*fit, Vec{{0.3, -1}}, 1e-5, state).ok());
}

TEST(TermData, OtherNumbersOfThemAreRefused) {
  ProblemBuilder builder = held();
  const TermId id = builder.add(chain(Vec::Ones(kCount)), 1.0);
  const Problem problem = builder.build();
  EXPECT_THROW(problem.with({{id, {.parameters = Vec::Ones(kCount - 1)}}}), InvalidArgument);
  EXPECT_THROW(problem.with({{id, {.parameters = Vec::Constant(kCount, std::nan(""))}}}),
               InvalidArgument);
  EXPECT_THROW(held().add(chain(Vec::Ones(kCount)), TermState{.parameters = Vec::Ones(1)}),
               InvalidArgument);
  // A term without data refuses data, which would be ignored.
  const Cells nodes = Cells::Zero(1, 1);
  const auto square =
      make_term<1>("square", nodes, [](Index, const auto& z) { return z[0] * z[0]; });
  EXPECT_THROW(ProblemBuilder(1).add(square, TermState{.parameters = Vec::Ones(1)}),
               InvalidArgument);
  const auto scaled = [&](const auto& data) {
    return make_term<1>(
        "scaled", nodes, [](Index, const auto& z, const auto& s) { return s[0] * z[0] * z[0]; },
        data);
  };
  EXPECT_THROW(scaled(Vec()), InvalidArgument);
  EXPECT_THROW(scaled(RowMatrix(RowMatrix::Ones(2, 1))), InvalidArgument);
  EXPECT_THROW(scaled(Vec(Vec::Constant(1, std::nan("")))), InvalidArgument);
  EXPECT_EQ(scaled(Vec(Vec::Ones(1)))->parameter_count(), 1);
}

TEST(TermData, AStateReplacesAllDataAndAChangeTheNamedOnes) {
  ProblemBuilder builder = held();
  const TermId id = builder.add(chain(Vec::Ones(kCount)),
                                TermState{.weight = 3, .element_weight = Vec::Constant(kCount, 2)});
  const Problem problem = builder.build();
  const Problem heavier = problem.with({{id, {.weight = 5}}});
  EXPECT_EQ(heavier.state(id).weight, 5);
  EXPECT_EQ(heavier.state(id).element_weight.size(), kCount);
  const Problem plain = problem.with({{id, TermState{.weight = 5}}});
  EXPECT_EQ(plain.state(id).element_weight.size(), 0);
}

TEST(HessianInTheHand, IsTheMatrixOfDifferencesAndItsFactorSolves) {
  ProblemBuilder builder = held();
  const Cells nodes = Vec::LinSpaced(kCount + 1, 0, kCount).cast<Index>();
  const auto quartic = make_term<1>("quartic", nodes, [](Index, const auto& z) {
    const auto square = z[0] * z[0];
    return square * square - square;
  });
  const TermId first = builder.add(chain(Vec::Ones(kCount)), 2.0);
  const TermId second = builder.add(quartic, 0.5);
  const Problem problem = builder.build();
  test::Random random(5);
  const Vec y = random.vector(problem.size(), 0.6, 2);
  Evaluator evaluator(problem);
  const Eigen::SparseMatrix<double> H = evaluator.hessian(y);
  EXPECT_EQ(H.rows(), problem.size());
  EXPECT_NEAR((H - Eigen::SparseMatrix<double>(H.transpose())).norm(), 0, 0);
  const Vec d = random.vector(problem.size(), -1, 1);
  Vec up, down, g, part, other;
  const double h = 1e-5;
  evaluator.gradient(y + h * d, up);
  evaluator.gradient(y - h * d, down);
  EXPECT_NEAR(((up - down) / (2 * h) - H * d).norm(), 0, 1e-7 * (H * d).norm());
  const double energy = evaluator.gradient(y, g);
  const double parts = evaluator.gradient(first, y, part) + evaluator.gradient(second, y, other);
  EXPECT_NEAR(parts, energy, 1e-12 * energy);
  EXPECT_NEAR((part + other - g).norm(), 0, 1e-12 * g.norm());
  const HessianFactor factor(problem, y);
  EXPECT_NEAR((factor.gradient() - g).norm(), 0, 1e-14 * g.norm());
  Eigen::MatrixXd b(problem.size(), 2);
  b << d, g;
  EXPECT_NEAR((H * factor.solve(b) - b).norm(), 0, 1e-9 * b.norm());
  EXPECT_THROW(factor.solve(Eigen::MatrixXd::Ones(3, 1)), InvalidArgument);
  EXPECT_THROW(HessianFactor(problem, Vec::Zero(3)), InvalidArgument);
  EXPECT_THROW(
      HessianFactor(ProblemBuilder(kCount + 1).add(quartic, 1.0).build(), Vec::Zero(kCount + 1)),
      Error);
}

TEST(ResidualsInTheHand, GiveTheGradientThroughTheirJacobian) {
  const Cells pairs = (Cells(3, 2) << 0, 1, 1, 2, 2, 3).finished();
  const auto term = make_least_squares<2>("valleys", pairs, [](Index e, const auto& z) {
    return std::array{10.0 * (z[1] - z[0] * z[0]), 1.0 - z[0] + 0.1 * e};
  });
  ProblemBuilder builder(4);
  const TermId id = builder.add(term, TermState{.weight = 3, .element_weight = Vec{{1, 0.5, 2}}});
  builder.add(FixedUnknowns({{1, 0.3}}));
  const Problem problem = builder.build();
  const Vec y{{0.2, -0.4, 0.9}};
  const Residuals r = residuals_at(problem, id, y);
  Vec g;
  const double energy = Evaluator(problem).gradient(y, g);
  EXPECT_EQ(r.values.size(), 6);
  EXPECT_NEAR(r.values.squaredNorm() / 2, energy, 1e-12 * energy);
  EXPECT_NEAR((r.jacobian.transpose() * r.values - g).norm(), 0, 1e-12 * g.norm());
  const auto other =
      make_term<1>("square", Cells::Zero(1, 1), [](Index, const auto& z) { return z[0] * z[0]; });
  const Problem plain = ProblemBuilder(1).add(other, 1).build();
  EXPECT_THROW(residuals_at(plain, TermId(0), Vec::Ones(1)), Error);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
