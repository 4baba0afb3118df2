// Nonlinear equalities, together with all other constraints, and derivatives of such minima.
#include "majorant/framework/terms/equality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/error.h"
#include "majorant/framework/sensitivity.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/quadratic_penalty.h"

namespace majorant {
namespace {

// Returns one element with all n unknowns.
Cells one_element(int n) {
  return Cells::Ones(1, n).cwiseProduct(Eigen::RowVectorXi::LinSpaced(n, 0, n - 1));
}

// The constraint x[unknown] = value.
class Fixed final : public Constraint {
 public:
  Fixed(Index unknown, double value) : unknown_(unknown), value_(value) {}
  void append_rows(ConstraintRows& rows) const override {
    rows.begin_row("fixed");
    rows.add(unknown_, 1.0);
    rows.end_row(value_);
  }

 private:
  Index unknown_;
  double value_;
};

// A chain of `count` rods in the plane between two pins, with weights at its nodes of two unknowns.
// The lengths are unknowns, too, which constraints fix.
struct Chain {
  Index rods;
  Problem problem;
  Vec start;
};

Chain chain(Index rods, double distance, const Vec& lengths, double weight) {
  const Index nodes = rods + 1, size = 2 * nodes + rods;
  ProblemBuilder builder(size);
  Vec pull = Vec::Zero(size);
  for (Index k = 0; k < nodes; ++k) pull[2 * k + 1] = 1;
  builder.add(linear_term("weight", pull), weight);
  Cells unknowns(rods, 5);
  for (Index k = 0; k < rods; ++k)
    for (int c = 0; c < 5; ++c) unknowns(k, c) = c < 4 ? 2 * k + c : 2 * nodes + k;
  builder.add(equality<5>("rods", unknowns,
                          [](Index, const auto& z) {
                            const auto dx = z[2] - z[0], dy = z[3] - z[1];
                            return dx * dx + dy * dy - z[4] * z[4];
                          }),
              1.0);
  for (const auto& [unknown, value] :
       {std::pair<Index, double>{0, 0.0}, {1, 0.0}, {2 * rods, distance}, {2 * rods + 1, 0.0}})
    builder.add(Fixed(unknown, value));
  for (Index k = 0; k < rods; ++k) builder.add(Fixed(2 * nodes + k, lengths[k]));
  Vec x(size);
  for (Index k = 0; k < nodes; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(rods);
    x[2 * k] = t * distance;
    x[2 * k + 1] = -t * (1 - t);
  }
  x.tail(rods) = lengths;
  return {rods, builder.build(), x};
}

Vec hung(const Chain& c) {
  const BarrierResult result = BarrierMinimizer({}).run(c.problem, c.problem.reduce(c.start));
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_LE(result.violation, 1e-12);
  return c.problem.expand(result.y);
}

TEST(Equality, TheMultiplierOfACircleIsTheForceOnIt) {
  // For min x + y on the circle of radius r: x = y = -r / sqrt(2), and d(E)/d(r^2) is -l.
  const double r = 3;
  ProblemBuilder builder(2);
  builder.add(linear_term("slope", Vec{{1, 1}}), 1.0);
  builder.add(equality<2>("circle", one_element(2),
                          [r](Index, const auto& z) { return z.squaredNorm() - r * r; }),
              1.0);
  const Problem problem = builder.build();
  const BarrierResult result = BarrierMinimizer({}).run(problem, Vec{{2, 0.1}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_EQ(result.definite, Definite::Yes);
  EXPECT_NEAR(result.y[0], -r / std::sqrt(2), 1e-14 * r);
  EXPECT_NEAR(result.y[1], -r / std::sqrt(2), 1e-14 * r);
  ASSERT_EQ(result.multipliers.size(), 1u);
  EXPECT_NEAR(result.multipliers[0][0], 1 / (std::sqrt(2) * r), 1e-14);
  EXPECT_NEAR(result.energy, -std::sqrt(2) * r, 1e-14);
  EXPECT_EQ(result.phases.back().violation, result.violation);
}

TEST(Equality, HoldsBesideConstraintsBoundsAndInequalities) {
  // The point of the unit sphere on x + y + z = 1 that is nearest to (3, 1, -2), with z >= -0.2
  // and x <= 2.
  const Eigen::Vector3d target(3, 1, -2);
  ProblemBuilder builder(3);
  builder.add(std::make_shared<QuadraticPenalty>(std::vector<LinearExpression>{
                  {{{0, 1.0}}, target[0]}, {{{1, 1.0}}, target[1]}, {{{2, 1.0}}, target[2]}}),
              0.5);
  builder.add(equality<3>("sphere", one_element(3),
                          [](Index, const auto& z) { return z.squaredNorm() - 1.0; }),
              1.0);
  class Sum final : public Constraint {
    void append_rows(ConstraintRows& rows) const override {
      rows.begin_row("sum");
      for (Index k = 0; k < 3; ++k) rows.add(k, 1.0);
      rows.end_row(1);
    }
  };
  builder.add(Sum());
  const auto floor =
      inequality<1>("floor", Cells{{2}}, [](Index, const auto& z) { return z[0] + 0.2; }).checker();
  const double none = std::numeric_limits<double>::infinity();
  const auto wall = Bounds(Vec::Constant(3, -none), Vec{{2, none, none}}).checker();
  std::vector<HeldBound> bounds{{builder.add(floor->barrier(), 1.0), floor},
                                {builder.add(wall->barrier(), 1.0), wall}};
  builder.add(floor);
  builder.add(wall);
  const Problem problem = builder.build();
  for (const Vec& start : {Vec{{0.2, 0.3, 0.5}}, Vec{{3, 1, -3}}, Vec{{1, 1, -1}}}) {
    const BarrierResult result =
        BarrierMinimizer::of_bounds(bounds).run(problem, problem.reduce(start));
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    const Vec x = problem.expand(result.y);
    EXPECT_NEAR(x.norm(), 1, 1e-12);
    EXPECT_NEAR(x.sum(), 1, 1e-12);
    // The bound z >= -0.2 is active: x and y solve x + y = 1.2, x^2 + y^2 = 0.96.
    EXPECT_NEAR(x[2], -0.2, 1e-6);
    EXPECT_NEAR(x[0], (1.2 + std::sqrt(2 * 0.96 - 1.44)) / 2, 1e-6);
    EXPECT_GT(x[2], -0.2);
  }
}

TEST(Equality, EndsWhereNothingMeetsItAtTheLeastViolation) {
  ProblemBuilder builder(2);
  builder.add(linear_term("slope", Vec{{1, 0.5}}), 1.0);
  builder.add(equality<2>("near circle", one_element(2),
                          [](Index, const auto& z) { return z.squaredNorm() - 1.0; }),
              1.0);
  builder.add(equality<2>("far circle", one_element(2),
                          [](Index, const auto& z) {
                            return (z[0] - 3.0) * (z[0] - 3.0) + z[1] * z[1] - 1.0;
                          }),
              1.0);
  const Problem problem = builder.build();
  const BarrierResult result = BarrierMinimizer({}).run(problem, Vec{{0.3, 0.4}});
  EXPECT_EQ(result.status, Status::Infeasible);
  EXPECT_NEAR(result.y[0], 1.5, 1e-4);
  EXPECT_NEAR(result.y[1], 0, 1e-3);
  EXPECT_NE(result.message.find("circle' at element 0"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("is 1.25, not 0"), std::string::npos) << result.message;
  EXPECT_LT(result.iterations.size(), 60u);
}

TEST(Equality, MayDependOnOthers) {
  ProblemBuilder builder(2);
  builder.add(linear_term("slope", Vec{{1, 2}}), 1.0);
  for (const double k : {1.0, 2.0, -3.0})
    builder.add(equality<2>("circle", one_element(2),
                            [k](Index, const auto& z) { return k * (z.squaredNorm() - 1.0); }),
                1.0);
  const Problem problem = builder.build();
  const BarrierResult result = BarrierMinimizer({}).run(problem, Vec{{0.3, 0.4}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_NEAR(result.energy, -std::sqrt(5), 1e-14);
  double multiplier = 0;  // of the first equality without the second
  for (int k = 0; k < 3; ++k) multiplier += result.multipliers[k][0] * (k < 2 ? k + 1 : -3);
  EXPECT_NEAR(multiplier, std::sqrt(5) / 2, 1e-12);
}

// A weak and a stiff equality are satisfied together like each alone.
TEST(Equality, MayHaveAnyScale) {
  ProblemBuilder builder(3);
  builder.add(std::make_shared<QuadraticPenalty>(std::vector<LinearExpression>{
                  {{{0, 1.0}}, 1.0}, {{{1, 1.0}}, 1.0}, {{{2, 1.0}}, 1.0}}),
              0.5);
  builder.add(equality<2>("stiff", Cells{{0, 1}},
                          [](Index, const auto& z) { return 1e6 * (z.squaredNorm() - 1.0); }),
              1.0);
  builder.add(equality<2>("weak", Cells{{1, 2}},
                          [](Index, const auto& z) { return 1e-6 * (z[0] * z[1] - 0.1); }),
              1.0);
  const BarrierResult result = BarrierMinimizer({}).run(builder.build(), Vec{{1, 2, 1}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_NEAR(result.y.head<2>().norm(), 1, 1e-12);
  EXPECT_NEAR(result.y[1] * result.y[2], 0.1, 1e-9);
  // The gradient of the Lagrangian.
  const double stiff = result.multipliers[0][0] * 1e6, weak = result.multipliers[1][0] * 1e-6;
  EXPECT_NEAR(result.y[0] - 1 + 2 * stiff * result.y[0], 0, 1e-9);
  EXPECT_NEAR(result.y[1] - 1 + 2 * stiff * result.y[1] + weak * result.y[2], 0, 1e-9);
  EXPECT_NEAR(result.y[2] - 1 + weak * result.y[1], 0, 1e-9);
}

// On the axis of a circle no derivative leads away from the points where the energy has a maximum
// along the circle.
TEST(Equality, ReportsAMaximumOfItsViolation) {
  ProblemBuilder builder(2);
  builder.add(
      make_term<2>("hill", one_element(2), [](Index, const auto& z) { return z[1] - z[0] * z[0]; }),
      1.0);
  builder.add(equality<2>("circle", one_element(2),
                          [](Index, const auto& z) { return z.squaredNorm() - 1.0; }),
              1.0);
  const Problem problem = builder.build();
  BarrierOptions options;
  for (const double projection : {1.0, 2.0}) {
    options.newton.projection = projection;
    const BarrierResult top = BarrierMinimizer({}, options).run(problem, Vec{{0, 2}});
    EXPECT_EQ(top.status, Status::Converged) << top.message;
    EXPECT_NEAR(std::abs(top.y[1]), 1, 1e-9);
    EXPECT_EQ(top.definite, Definite::No);
    EXPECT_NE(top.message.find("at a saddle"), std::string::npos) << top.message;
    const BarrierResult side = BarrierMinimizer({}, options).run(problem, Vec{{0.1, 2}});
    EXPECT_NEAR(side.y[1], -0.5, 1e-12);
    EXPECT_EQ(side.definite, Definite::Yes);
  }
}

// The minimum lies between the curved side of a disk and an equality that crosses it. If barriers
// fell before the equality is satisfied, steps along the side would be as short as the distance to
// it.
TEST(Equality, IsMetBesideACurvedInequality) {
  ProblemBuilder builder(3);
  builder.add(linear_term("slope", Vec{{4, -1, 2}}), 1.0);
  builder.add(equality<3>("saddle", one_element(3),
                          [](Index, const auto& z) {
                            return 20.0 * (z[0] * z[1] + 0.5 * z[2] * z[2] - 0.2);
                          }),
              1.0);
  const auto ball = inequality<3>("ball", one_element(3), [](Index, const auto& z) {
                      return 1.0 - z.squaredNorm();
                    }).checker();
  const HeldBound bound{builder.add(ball->barrier(), 1.0), ball};
  builder.add(ball);
  const Problem problem = builder.build();
  for (const Vec& start : {Vec{{3, -2, 1}}, Vec{{-1, 4, -3}}, Vec{{0.1, 0.2, 5}}}) {
    const BarrierResult result = BarrierMinimizer::of_bounds({bound}).run(problem, start);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    EXPECT_LE(result.violation, 1e-12);
    EXPECT_LT(result.iterations.size(), 120u);
    // The gradient of the Lagrangian, with the multiplier of the ball from the last barrier.
    const Vec& y = result.y;
    const double l = 20 * result.multipliers[0][0],
                 side = 2 * result.phases.back().mu / (1 - y.squaredNorm());
    EXPECT_NEAR(4 + l * y[1] + side * y[0], 0, 1e-4);
    EXPECT_NEAR(-1 + l * y[0] + side * y[1], 0, 1e-4);
    EXPECT_NEAR(2 + l * y[2] + side * y[2], 0, 1e-4);
  }
}

TEST(Equality, IsMetFromWhereItHasNoPositiveCurvature) {
  ProblemBuilder builder(1);
  builder.add(
      equality<1>("two", Cells{{0}}, [](Index, const auto& z) { return z[0] * z[0] - 4.0; }), 1.0);
  const BarrierResult result = BarrierMinimizer({}).run(builder.build(), Vec{{1}});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_NEAR(result.y[0], 2, 1e-10);
}

// At the centre of a sphere the violation has a maximum, from which no derivative leads away.
TEST(Equality, IsMetFromASaddleOfItsViolation) {
  for (const double stiffness : {0.0, 1.0, 50.0}) {
    ProblemBuilder builder(3);
    builder.add(make_term<3>("bowl", one_element(3),
                             [stiffness](const auto& z) {
                               return stiffness *
                                      (z[0] * z[0] + 2.0 * z[1] * z[1] + 3.0 * z[2] * z[2]);
                             }),
                1.0);
    builder.add(
        equality<3>("sphere", one_element(3), [](const auto& z) { return z.squaredNorm() - 1.0; }),
        1.0);
    const BarrierResult result = BarrierMinimizer({}).run(builder.build(), Vec::Zero(3));
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    EXPECT_NEAR(result.y.norm(), 1, 1e-12);
    EXPECT_NEAR(result.energy, stiffness, 1e-9 * stiffness);
  }
}

TEST(Equality, ReportsMissingDerivativesAtTheStart) {
  ProblemBuilder builder(2);
  builder.add(linear_term("slope", Vec{{1, 1}}), 1.0);
  builder.add(equality<2>("length", one_element(2),
                          [](Index, const auto& z) {
                            using std::sqrt;
                            return sqrt(z[0] * z[0] + z[1] * z[1]) - 1.0;
                          }),
              1.0);
  const BarrierResult result = BarrierMinimizer({}).run(builder.build(), Vec::Zero(2));
  EXPECT_EQ(result.status, Status::Infeasible);
  EXPECT_NE(result.message.find("'length' at element 0"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("not finite at the start"), std::string::npos);
  ASSERT_EQ(result.multipliers.size(), 1u);
  EXPECT_EQ(result.multipliers[0], Vec::Zero(1));
}

TEST(Equality, IsAPenaltyForOtherMinimizersAndHasDerivatives) {
  const auto term = equality<3>("saddle", one_element(3), [](Index, const auto& z) {
    using std::sin;
    return z[0] * z[1] - sin(z[2]);
  });
  EXPECT_NE(dynamic_cast<const EqualityTerm*>(term.get()), nullptr);
  const Vec x{{0.3, 1.2, -0.4}};
  TermState state;
  state.parameters = Eigen::Vector2d(-2, 7);
  EXPECT_TRUE(check_derivatives(*term, x).ok());
  const DerivativeReport report = check_derivatives(*term, x, 1e-5, state);
  EXPECT_TRUE(report.ok()) << report.message();
}

TEST(Equality, RefusesAWeight) {
  ProblemBuilder builder(1);
  builder.add(equality<1>("one", Cells{{0}}, [](Index, const auto& z) { return z[0] - 1.0; }), 2.0);
  const Problem problem = builder.build();
  try {
    BarrierMinimizer({}).run(problem, Vec::Zero(1));
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find("'one' has a weight"), std::string::npos);
  }
}

// Compares derivatives of the hanging chain by the position of its end and by its lengths with
// extrapolated differences of whole solves (Richardson).
TEST(Equality, DerivativesOfAMinimumHoldThroughIt) {
  for (const Index rods : {4, 12, 40}) {
    const double distance = 1.7;
    Vec lengths = Vec::Constant(rods, 2.5 / static_cast<double>(rods));
    for (Index k = 0; k < rods; ++k) lengths[k] *= 1 + 0.1 * std::sin(3.0 * static_cast<double>(k));
    const Chain at = chain(rods, distance, lengths, 1);
    const BarrierResult result = BarrierMinimizer({}).run(at.problem, at.problem.reduce(at.start));
    ASSERT_EQ(result.status, Status::Converged) << result.message;
    const Sensitivity s(at.problem.with(result.states), result);

    Vec direction(rods);
    for (Index k = 0; k < rods; ++k) direction[k] = std::cos(static_cast<double>(k * k));
    Sensitivity::Change change;
    change.right_hand_sides = Vec::Zero(s.row_count());
    change.right_hand_sides[2] = 0.7;
    change.right_hand_sides.tail(rods) = direction;
    const Vec dx = s.forward(change);

    const auto difference = [&](double h) -> Vec {
      const auto moved = [&](double t) {
        return hung(chain(rods, distance + 0.7 * t, lengths + t * direction, 1));
      };
      return (moved(h) - moved(-h)) / (2 * h);
    };
    const double h = 0.02 / static_cast<double>(rods);
    const Vec coarse = difference(h), fine = difference(h / 2), finest = difference(h / 4);
    const Vec once = (4 * fine - coarse) / 3, twice = (4 * finest - fine) / 3;
    const Vec expected = (16 * twice - once) / 15;
    EXPECT_LE((dx - expected).norm(), 1e-7 * expected.norm()) << rods << " rods";

    Vec slope(at.start.size());
    for (Index k = 0; k < slope.size(); ++k) slope[k] = std::sin(static_cast<double>(7 * k + 1));
    const Sensitivity::Derivative d = s.adjoint(slope);
    EXPECT_NEAR(d.right_hand_sides.dot(change.right_hand_sides), slope.dot(dx),
                1e-9 * slope.norm() * dx.norm());
    EXPECT_LE(s.error(), 1e-9);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
