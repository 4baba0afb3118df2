// Gradients of users' densities are computed with first-order numbers, and correct.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <atomic>

#include "energies/density_fixture.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/problem.h"

namespace majorant {
namespace {

// The number of calls of a formula with doubles, and with first- and second-order numbers.
struct Calls {
  std::atomic<int> values = 0, first = 0, second = 0;

  template <class T>
  void count() {
    if constexpr (std::is_same_v<T, double>)
      ++values;
    else
      ++(T::order == 1 ? first : second);
  }
};

template <class T>
using Entry = std::decay_t<decltype(std::declval<const T&>()(0, 0))>;

// Five tetrahedra in a cube, slightly moved.
struct Cube {
  std::shared_ptr<const BezierTetrahedronSpace> space;
  RestShapes rest;
  Vec x;

  explicit Cube(int degree) {
    RowMatrix corners(8, 3);
    for (int v = 0; v < 8; ++v) corners.row(v) << (v & 1), ((v >> 1) & 1), ((v >> 2) & 1);
    const Cells cells{{0, 1, 2, 4}, {3, 2, 1, 7}, {5, 4, 7, 1}, {6, 7, 4, 2}, {1, 2, 4, 7}};
    space = std::make_shared<const BezierTetrahedronSpace>(cells, 8, degree);
    rest = flat_simplices(corners, cells);
    const RowMatrix nodes = space->node_positions(corners);
    x = Eigen::Map<const Vec>(nodes.data(), nodes.size());
    x += test::Random(3).vector(x.size(), -0.05, 0.05);
  }
};

auto counted_volumes(Calls& calls) {
  return density<3, 3>("volumes", [&calls](const auto& J) {
    calls.count<Entry<decltype(J)>>();
    return J.squaredNorm() + J.inverse().squaredNorm();
  });
}

Problem problem_of(const Cube& cube, Calls& calls) {
  return ProblemBuilder(static_cast<Index>(cube.x.size()))
      .add(make_energy(cube.space, cube.rest, counted_volumes(calls)), 1)
      .build();
}

TEST(GradientOrder, GradientsTakeNoSecondDerivatives) {
  const Cube cube(1);
  Calls calls;
  const Problem problem = problem_of(cube, calls);
  Evaluator evaluator(problem);
  Vec first, second, hessian;
  evaluator.gradient(cube.x, first);
  EXPECT_GE(calls.first, 5);
  EXPECT_EQ(calls.second, 0);
  EXPECT_EQ(calls.values, 0);
  evaluator.linearize(cube.x, Curvature::Exact, second, hessian);
  EXPECT_GE(calls.second, 5);
  EXPECT_EQ(first, second);
}

// Except for their metric, a Hessian at the start.
TEST(GradientOrder, FirstOrderMethodsTakeNoSecondDerivatives) {
  const Cube cube(1);
  Calls calls;
  const Problem problem = problem_of(cube, calls);
  Vec g, h;
  Evaluator(problem).linearize(cube.x, Curvature::Projected, g, h);
  const int once = calls.second;
  GradientFlowOptions flow;
  flow.stopping.max_iterations = 3;
  EXPECT_EQ(GradientFlowMinimizer(flow).minimize(problem, cube.x, {}).iterations.size(), 3);
  LbfgsOptions lbfgs;
  lbfgs.stopping.max_iterations = 3;
  const int by_flow = calls.first;
  EXPECT_GT(by_flow, 0);
  EXPECT_EQ(LbfgsMinimizer(lbfgs).minimize(problem, cube.x, {}).iterations.size(), 3);
  EXPECT_GT(calls.first, by_flow);
  EXPECT_EQ(calls.second, 3 * once);
}

TEST(GradientOrder, WithDataOfElementsToo) {
  const test::Triangles t(3);
  Calls calls;
  const auto stiff = density<2, 2>(
      "stiff",
      [&calls](const auto& J, double k) {
        calls.count<Entry<decltype(J)>>();
        return k * (J.squaredNorm() + 1.0 / J.determinant());
      },
      Vec(Vec::LinSpaced(3, 1, 2)));
  const std::vector<Eigen::Matrix2d> jacobians(3, Eigen::Matrix2d{{1.5, 0.5}, {0, 0.75}});
  const Vec x = test::corners_of(jacobians);
  const Problem problem = ProblemBuilder(static_cast<Index>(x.size()))
                              .add(make_energy(t.space, t.rest, stiff), 1)
                              .build();
  Vec g, h, second;
  Evaluator evaluator(problem);
  evaluator.gradient(x, g);
  EXPECT_GT(calls.first, 0);
  EXPECT_EQ(calls.second, 0);
  evaluator.linearize(x, Curvature::Exact, second, h);
  EXPECT_EQ(g, second);
}

// Returns |J|^2 + |J^-1|^2 of the tetrahedron with unit rest shape, by Ceres' automatic
// differentiation.
TEST(GradientOrder, AgreesWithJets) {
  using Jet = ceres::Jet<double, 12>;
  const Cells cell{{0, 1, 2, 3}};
  RowMatrix corners = RowMatrix::Zero(4, 3);
  corners.bottomRows(3).setIdentity();
  const auto space = std::make_shared<const BezierTetrahedronSpace>(cell, 4, 1);
  Calls calls;
  const Problem problem =
      ProblemBuilder(12)
          .add(make_energy(space, flat_simplices(corners, cell), counted_volumes(calls)), 6)
          .build();
  test::Random random(8);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec x = Eigen::Map<const Vec>(corners.data(), 12) + random.vector(12, -0.2, 0.2);
    Eigen::Matrix<Jet, 3, 3> J;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) J(r, c) = Jet(x[3 * (c + 1) + r], 3 * (c + 1) + r) - Jet(x[r], r);
    const Jet expected = J.squaredNorm() + J.inverse().eval().squaredNorm();
    Vec g;
    const double energy = Evaluator(problem).gradient(x, g);
    EXPECT_NEAR(energy, expected.a, 1e-12 * expected.a);
    EXPECT_LE((g - Vec(expected.v)).norm(), 1e-12 * expected.v.norm());
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
