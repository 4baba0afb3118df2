// Gradients of lambda terms use dual numbers of first order, and are right.
#include <gtest/gtest.h>

#include "majorant/framework/energy_term.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/least_squares.h"
#include "random.h"

namespace majorant {
namespace {

constexpr Index kPoints = 40;

// Numbers of calls with numbers of each order; 0: doubles.
using Calls = std::array<int, 3>;

template <class Z>
void count(Calls& calls, const Z&) {
  if constexpr (std::is_same_v<typename Z::Scalar, double>)
    ++calls[0];
  else
    ++calls[Z::Scalar::order];
}

Cells pairs() {
  Cells cells(kPoints - 1, 2);
  for (Index e = 0; e < cells.rows(); ++e) cells.row(e) << e, e + 1;
  return cells;
}

// Tests a term of springs in the plane: first derivatives do not depend on whether second ones are
// computed, and only second ones use numbers of second order.
void expect_first_order(const std::shared_ptr<const EnergyTerm>& term, Calls& calls) {
  SCOPED_TRACE(term->name());
  const Problem problem = ProblemBuilder(2 * kPoints).add(term, 2).build();
  Vec x(2 * kPoints);
  test::Random random(2);
  for (Index k = 0; k < x.size(); ++k) x[k] = 1.5 * (k / 2) + random.uniform(-0.2, 0.2);
  Evaluator evaluator(problem);
  Vec first, second, hessian;
  calls = {};
  const double energy = evaluator.gradient(x, first);
  EXPECT_EQ(calls, (Calls{0, kPoints - 1, 0}));
  EXPECT_EQ(evaluator.linearize(x, Curvature::Projected, second, hessian), energy);
  EXPECT_EQ(calls, (Calls{0, kPoints - 1, kPoints - 1}));
  EXPECT_EQ(first, second);
  EXPECT_GT(first.norm(), 0);
}

TEST(GradientOrder, LambdaTermsTakeNoSecondDerivatives) {
  Calls calls{};
  expect_first_order(make_term<2, 2>("springs", pairs(),
                                     [&calls](Index, const auto& z) {
                                       count(calls, z);
                                       const auto stretch = (z.col(1) - z.col(0)).norm() - 1.0;
                                       return stretch * stretch;
                                     }),
                     calls);
  expect_first_order(make_least_squares<2, 2>(
                         "fit", pairs(),
                         [&calls](Index, const auto& z) {
                           count(calls, z);
                           return std::array{z(0, 1) - z(0, 0) - 1.0, z(1, 1) * z(1, 0)};
                         },
                         huber_loss(0.5)),
                     calls);
  const auto apart = inequality<2, 2>("apart", pairs(), [&calls](Index, const auto& z) {
    count(calls, z);
    return (z.col(1) - z.col(0)).squaredNorm() - 0.25;
  });
  expect_first_order(apart.barrier(), calls);
}

// Tests every function with numbers of both orders.
TEST(GradientOrder, OfEveryFunction) {
  const Cells unknowns{{0, 1}};
  const auto term = make_term<2>("all", unknowns, [](Index, const auto& z) {
    using std::abs, std::acos, std::asin, std::atan, std::atan2, std::cos, std::cosh, std::exp;
    using std::hypot, std::log, std::max, std::min, std::pow, std::sin, std::sinh, std::sqrt;
    using std::tan, std::tanh;
    const auto &x = z[0], y = z[1];
    auto sum = sqrt(x) + log(y) + exp(x * y) + pow(x, 1.5) + pow(2.0, y) + pow(x, y) + sin(x);
    sum += cos(y) + tan(x * y) + asin(0.3 * x) + acos(0.2 * y) + atan(x) + atan2(y, x);
    sum += sinh(x) + cosh(y) + tanh(x - y) + hypot(x, y) + abs(x - 2.0) + min(x, y) + max(y, 0.1);
    sum /= 1.0 + x;
    sum -= 2.0 / y;
    sum *= x * y;
    return sum - 0.5;
  });
  test::Random random(9);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec x = random.vector(2, 0.3, 0.9);
    Evaluator evaluator(ProblemBuilder(2).add(term, 1).build());
    Vec first, second, hessian;
    EXPECT_EQ(evaluator.gradient(x, first),
              evaluator.linearize(x, Curvature::Exact, second, hessian));
    EXPECT_EQ(first, second);
    const DerivativeReport report = check_derivatives(*term, x);
    EXPECT_TRUE(report.ok()) << report.message();
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
