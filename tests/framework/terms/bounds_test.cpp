// Bounds on unknowns: barrier, step limit, minima on the boundary compared with Ceres and closed
// forms.
#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "framework/terms/ceres_options.h"
#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"
#include "random.h"

namespace majorant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Bounds, BarrierAndItsDerivatives) {
  const Bounds bounds(Vec{{-kInfinity, 0, -1, -kInfinity}}, Vec{{2, kInfinity, 1, kInfinity}});
  const auto barrier = bounds.barrier();
  EXPECT_EQ(barrier->element_dofs().element_count(), 4);
  const Vec x{{1.5, 3, 0.9, 7}};
  const DerivativeReport report = check_derivatives(*barrier, x);
  EXPECT_TRUE(report.ok()) << report.message();
  const Problem problem = ProblemBuilder(4).add(barrier, 1).build();
  EXPECT_NEAR(Evaluator(problem).value(x),
              -std::log(0.5) - std::log(3) - std::log(1.9) - std::log(0.1), 1e-14);
  for (const Vec& outside : {Vec{{2.5, 3, 0, 0}}, Vec{{2, 3, 0, 0}}, Vec{{0, -1e-300, 0, 0}}})
    EXPECT_EQ(Evaluator(problem).value(outside), kInfinity);
}

TEST(Bounds, ViolationAndItsDerivatives) {
  const Bounds bounds(Vec{{0, 0, -kInfinity}}, Vec{{0.1, kInfinity, kInfinity}});
  const auto measure = std::dynamic_pointer_cast<const ViolationMeasure>(bounds.checker());
  ASSERT_TRUE(measure);
  const auto violation = measure->violation(0.1);  // relative to the gap, if there is one
  EXPECT_EQ(violation->element_dofs().nodes, bounds.barrier()->element_dofs().nodes);
  const Vec x{{0.4, -2, 7}};
  const DerivativeReport report = check_derivatives(*violation, x);
  EXPECT_TRUE(report.ok()) << report.message();
  const Problem problem = ProblemBuilder(3).add(violation, 1).build();
  EXPECT_NEAR(Evaluator(problem).value(x), 0.31 * 0.31 + 2.1 * 2.1, 1e-14);
  EXPECT_EQ(Evaluator(problem).value(Vec{{0.05, 0.2, 0}}), 0);
}

TEST(Bounds, StepsAreLimited) {
  const auto checker = Bounds(Vec{{0, -1, -kInfinity}}, Vec{{4, kInfinity, kInfinity}}).checker();
  const Vec x{{1, 1, 0}};
  EXPECT_TRUE(checker->check(x).feasible);
  EXPECT_EQ(checker->check(x).margin, 1);
  EXPECT_FALSE(checker->check(Vec{{0, 1, 0}}).feasible);
  EXPECT_EQ(checker->check(Vec{{5, -2, 0}}).blocking, (std::vector<Index>{0, 1}));
  EXPECT_FALSE(checker->check(Vec{{kInfinity * 0, 1, 0}}).feasible);
  const auto step = [&](const Vec& d, double s) { return checker->max_step(x, d, s); };
  EXPECT_EQ(step(Vec{{6, 0, -9}}, 1).step, 0.5);
  EXPECT_EQ(step(Vec{{6, 0, -9}}, 1).blocking, (std::vector<Index>{0}));
  EXPECT_EQ(step(Vec{{-4, -5, 1}}, 1).step, 0.25);
  EXPECT_EQ(step(Vec{{-4, -5, 1}}, 1).blocking, (std::vector<Index>{0, 1}));
  EXPECT_EQ(step(Vec{{1, 5, 1e300}}, 2).step, 2);
  EXPECT_TRUE(step(Vec{{1, 5, 1}}, 2).blocking.empty());
}

TEST(Bounds, Interior) {
  const Bounds bounds(Vec{{0, 0, -kInfinity}}, Vec{{4, kInfinity, 1}});
  EXPECT_EQ(bounds.interior(Vec{{9, -3, 5}}, 0.25), (Vec{{3, 0.25, 0.75}}));
  EXPECT_EQ(bounds.interior(Vec{{2, 7, -5}}), (Vec{{2, 7, -5}}));
  EXPECT_THROW(bounds.interior(Vec::Zero(2)), Error);
  EXPECT_THROW(bounds.interior(Vec::Zero(3), 0), Error);
}

TEST(Bounds, WithoutRoom) {
  EXPECT_THROW(Bounds(Vec::Zero(2), Vec::Ones(3)), Error);
  EXPECT_THROW(Bounds(Vec::Zero(2), Vec{{1, 0}}), Error);
  EXPECT_THROW(Bounds(Vec::Zero(1), Vec::Constant(1, std::nan(""))), Error);
}

struct Pull {
  double target;
  template <class T>
  bool operator()(const T* x, T* r) const {
    r[0] = x[0] - target;
    return true;
  }
};

// sum (x_i - a_i)^2 / 2 in a box: the minimum is a, clamped, and Ceres finds it.
TEST(Bounds, ProjectionOntoABox) {
  test::Random random(1);
  const Index n = 300;
  const Vec target = random.vector(n, -3, 3), lower = random.vector(n, -2, -1),
            upper = random.vector(n, 1, 2);
  Cells each(n, 1);
  for (Index i = 0; i < n; ++i) each(i, 0) = i;
  const auto pull = make_least_squares<1>(
      "pull", each, [target](Index e, const auto& z) { return z[0] - target[e]; });
  const Bounds bounds(lower, upper);
  ProblemBuilder builder(n);
  builder.add(pull, 1);
  const TermId barrier = builder.add(bounds.barrier(), 1);
  builder.add(bounds.checker());
  const Problem problem = builder.build();
  const BarrierResult result =
      BarrierMinimizer({barrier}).run(problem, bounds.interior(Vec::Zero(n)));
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_TRUE(bounds.checker()->check(result.y).feasible);
  const Vec expected = target.cwiseMax(lower).cwiseMin(upper);
  EXPECT_LE((result.y - expected).lpNorm<Eigen::Infinity>(), 1e-6);
  EXPECT_NEAR(result.energy, 0.5 * (expected - target).squaredNorm(), 1e-6);
  EXPECT_LE(result.iterations.size(), 60);
  ceres::Problem theirs;
  Vec x = Vec::Zero(n);
  for (Index i = 0; i < n; ++i) {
    theirs.AddResidualBlock(new ceres::AutoDiffCostFunction<Pull, 1, 1>(new Pull{target[i]}),
                            nullptr, &x[i]);
    theirs.SetParameterLowerBound(&x[i], 0, lower[i]);
    theirs.SetParameterUpperBound(&x[i], 0, upper[i]);
  }
  ceres::Solver::Summary summary;
  ceres::Solve(test::tight_options(), &theirs, &summary);
  EXPECT_LE((result.y - x).lpNorm<Eigen::Infinity>(), 1e-3);  // Ceres stops earlier
  EXPECT_NEAR(result.energy, summary.final_cost, 1e-6);
}

// Compares dense linear least squares in a box with coordinate descent.
TEST(Bounds, LeastSquaresInABox) {
  constexpr int n = 12;
  test::Random random(2);
  const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(30, n, [&] { return random.uniform(); });
  const Vec b = random.vector(30, -5, 5);
  const auto planes = make_least_squares<n>(
      "planes", Cells::Ones(30, 1) * Eigen::RowVectorXi::LinSpaced(n, 0, n - 1),
      [&](Index e, const auto& z) {
        auto r = A(e, 0) * z[0] - b[e];
        for (int k = 1; k < n; ++k) r += A(e, k) * z[k];
        return r;
      });
  const Bounds bounds(Vec::Constant(n, -0.5), Vec::Constant(n, 0.7));
  ProblemBuilder builder(n);
  builder.add(planes, 1);
  const TermId barrier = builder.add(bounds.barrier(), 1);
  builder.add(bounds.checker());
  const BarrierMinimizer minimizer(
      {barrier},
      {.tolerance = 1e-11});  // relative to an energy near 100, and bounds are weakly active
  const BarrierResult result = minimizer.run(builder.build(), Vec::Zero(n));
  const Eigen::MatrixXd H = A.transpose() * A;
  const Vec c = A.transpose() * b;
  Vec x = Vec::Zero(n);
  for (int sweep = 0; sweep < 3000; ++sweep)
    for (int k = 0; k < n; ++k)
      x[k] = std::clamp(x[k] + (c[k] - H.row(k).dot(x)) / H(k, k), -0.5, 0.7);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_GE(((x.array() == -0.5) || (x.array() == 0.7)).count(), 4);
  // The tolerance bounds the energy above the minimum, and so, by the least eigenvalue, the
  // distance.
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(H).eigenvalues()[0];
  const double gap = 1e-11 * std::max(1.0, result.energy);
  EXPECT_NEAR(result.energy, 0.5 * (A * x - b).squaredNorm(), gap);
  EXPECT_LE((result.y - x).norm(), std::sqrt(2 * gap / least));
}

struct Rosenbrock {
  template <class T>
  bool operator()(const T* x, T* r) const {
    r[0] = 10.0 * (x[1] - x[0] * x[0]);
    r[1] = 1.0 - x[0];
    return true;
  }
};

// A nonlinear problem with active and inactive bounds: first-order conditions hold, and Ceres,
// which stops early along the valley, finds no lower energy.
TEST(Bounds, RosenbrockInABox) {
  const auto valley = make_least_squares<2>("valley", Cells{{0, 1}}, [](Index, const auto& z) {
    return std::array{10.0 * (z[1] - z[0] * z[0]), 1.0 - z[0]};
  });
  const Problem free = ProblemBuilder(2).add(valley, 1).build();
  for (const auto& [lower, upper] : {std::pair(Vec{{-2, -2}}, Vec{{0.5, 2}}),
                                     {Vec{{-2, -2}}, Vec{{2, 0.25}}},
                                     {Vec{{-2, 1.5}}, Vec{{2, kInfinity}}},
                                     {Vec{{-2, -2}}, Vec{{2, 2}}}}) {
    const Bounds bounds(lower, upper);
    const Vec start = bounds.interior(Vec{{-1.2, 1}});
    ProblemBuilder builder(2);
    builder.add(valley, 1);
    const TermId barrier = builder.add(bounds.barrier(), 1);
    builder.add(bounds.checker());
    const BarrierResult result = BarrierMinimizer({barrier}).run(builder.build(), start);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    Vec g;
    Evaluator(free).gradient(result.y, g);
    for (int k = 0; k < 2; ++k) {
      const bool low = result.y[k] - lower[k] < 1e-6, high = upper[k] - result.y[k] < 1e-6;
      EXPECT_TRUE(low ? g[k] > 0 : high ? g[k] < 0 : std::abs(g[k]) < 1e-5) << g[k];
    }
    ceres::Problem theirs;
    double x[] = {start[0], start[1]};
    theirs.AddResidualBlock(new ceres::AutoDiffCostFunction<Rosenbrock, 2, 2>(new Rosenbrock),
                            nullptr, x);
    for (int k = 0; k < 2; ++k) {
      theirs.SetParameterLowerBound(x, k, lower[k]);
      if (upper[k] < kInfinity) theirs.SetParameterUpperBound(x, k, upper[k]);
    }
    ceres::Solver::Summary summary;
    ceres::Solve(test::tight_options(), &theirs, &summary);
    EXPECT_LE(result.energy, summary.final_cost + 1e-7);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
