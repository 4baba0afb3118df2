// Newton's method with feasibility checkers: it stays inside, and reports the blocking ones.
#include <gtest/gtest.h>

#include <cmath>

#include "framework/scalar_terms.h"
#include "majorant/framework/newton.h"

namespace majorant {
namespace {

using test::Box;
using test::Chain;
using test::double_well;
using test::Frozen;
using test::kInfinity;
using test::parabola;
using test::Scalar;

NewtonOptions exact() {
  NewtonOptions o;
  o.curvature = Curvature::Exact;
  return o;
}

class NewtonInTheBox : public testing::TestWithParam<bool> {};

TEST_P(NewtonInTheBox, NeverLeavesTheFeasibleSet) {
  const auto box = std::make_shared<const Box>(1.2, GetParam());
  const Problem problem =
      ProblemBuilder(4).add(std::make_shared<const Chain>(4, double_well()), 1).add(box).build();
  Vec y0(4);
  y0 << 0.6, -0.7, 1.1, -0.8;
  StepObserver observer([&](const TraceEntry&, const Vec& y) {
    EXPECT_TRUE(box->check(problem.expand(y)).feasible);
    return Directive::Continue;
  });
  const SolveResult r = NewtonMinimizer(exact()).minimize(problem, y0, &observer);
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_NEAR(r.energy, 4, 1e-5);
}

// The minimum lies outside: the solver stops at the boundary and reports it.
TEST_P(NewtonInTheBox, StallsAtTheBoundary) {
  const auto box = std::make_shared<const Box>(1, GetParam());
  const Problem problem =
      ProblemBuilder(2).add(std::make_shared<const Chain>(2, parabola(2, 1)), 1).add(box).build();
  const SolveResult r = NewtonMinimizer(exact()).minimize(problem, Vector2(0.5, 0), {});
  EXPECT_EQ(r.status, Status::Stalled) << r.message;
  EXPECT_GT(r.newton_decrement, 1e-4 * r.energy);
  EXPECT_TRUE(box->check(problem.expand(r.y)).feasible);
}

INSTANTIATE_TEST_SUITE_P(PathsAndPoints, NewtonInTheBox, testing::Bool());

TEST(Newton, CertifiedStepsEndShortOfTheirBound) {
  const auto box = std::make_shared<const Box>(1, true);
  const Problem problem =
      ProblemBuilder(2).add(std::make_shared<const Chain>(2, parabola(2, 1)), 1).add(box).build();
  const SolveResult r = NewtonMinimizer(exact()).minimize(problem, Vector2(0.5, 0), {});
  EXPECT_FALSE(r.blocking.empty());
  EXPECT_LE(r.iterations.at(0).step,
            (1 + 1e-12) * exact().line_search.boundary_fraction * r.iterations.at(0).step_bound);
}

TEST(Newton, BlockedStepsStall) {
  const Problem problem = ProblemBuilder(1)
                              .add(std::make_shared<const Chain>(1, parabola(2, 1)), 1)
                              .add(std::make_shared<const Frozen>())
                              .build();
  const SolveResult r = NewtonMinimizer(exact()).minimize(problem, Vec::Zero(1), {});
  EXPECT_EQ(r.status, Status::Stalled);
  EXPECT_EQ(r.blocking, std::vector<Index>{3});
  EXPECT_EQ(r.y[0], 0);
  EXPECT_TRUE(r.iterations.empty());
}

TEST(Newton, InfeasibleStarts) {
  const auto box = std::make_shared<const Box>(1, true);
  const Problem boxed =
      ProblemBuilder(3).add(std::make_shared<const Chain>(3, parabola(0, 1)), 1).add(box).build();
  SolveResult r = NewtonMinimizer(exact()).minimize(boxed, Vector3(0, 7, 0), {});
  EXPECT_EQ(r.status, Status::Infeasible);
  EXPECT_EQ(r.blocking, std::vector<Index>{1});
  EXPECT_EQ(r.y, Vec(Vector3(0, 7, 0)));
  EXPECT_EQ(r.message.find("the start violates box at element 1"), 0) << r.message;
  EXPECT_TRUE(std::isnan(r.energy));

  const Scalar barrier{[](double t) { return t > 0 ? t - std::log(t) : kInfinity; },
                       [](double t) { return 1 - 1 / t; }, [](double t) { return 1 / (t * t); }};
  const Problem domain =
      ProblemBuilder(1).add(std::make_shared<const Chain>(1, barrier), 1).build();
  EXPECT_EQ(NewtonMinimizer(exact()).minimize(domain, Vec::Constant(1, -1), {}).status,
            Status::Infeasible);
  r = NewtonMinimizer(exact()).minimize(domain, Vec::Constant(1, 1e-6), {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_NEAR(r.y[0], 1, 1e-3);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
