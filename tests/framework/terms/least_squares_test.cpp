// Compares least squares and robust losses with Ceres.
#include "majorant/framework/terms/least_squares.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include "framework/terms/ceres_options.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/newton.h"
#include "random.h"

namespace majorant {
namespace {

struct LossPair {
  const char* name;
  RobustLoss ours;
  std::shared_ptr<ceres::LossFunction> theirs;
};

std::vector<LossPair> losses(double width) {
  return {{"none", {}, nullptr},
          {"huber", huber_loss(width), std::make_shared<ceres::HuberLoss>(width)},
          {"soft l1", soft_l1_loss(width), std::make_shared<ceres::SoftLOneLoss>(width)},
          {"cauchy", cauchy_loss(width), std::make_shared<ceres::CauchyLoss>(width)},
          {"arctan", arctan_loss(width), std::make_shared<ceres::ArctanLoss>(width)},
          {"tukey", tukey_loss(width), std::make_shared<ceres::TukeyLoss>(width)}};
}

// Samples of y = exp(m t + c) with noise and outliers, the curve of Ceres' tutorial.
struct Samples {
  Vec t, y;
  Samples(Index count, unsigned seed) : t(Vec::LinSpaced(count, 0, 5)), y(count) {
    test::Random random(seed);
    for (Index i = 0; i < count; ++i)
      y[i] = std::exp(0.3 * t[i] + 0.1) + 0.1 * random.uniform() + (i % 9 == 4 ? 4 : 0);
  }
};

struct CurveResidual {
  double t, y;
  template <class T>
  bool operator()(const T* m, const T* c, T* residual) const {
    residual[0] = T(y) - exp(m[0] * t + c[0]);
    return true;
  }
};

ceres::Problem::Options borrowed_losses() {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  return options;
}

auto curve_term(const Samples& s, RobustLoss loss) {
  return make_least_squares<2>(
      "curve", Cells::Ones(s.t.size(), 1) * Eigen::RowVector2i(0, 1),
      [s](Index e, const auto& z) {
        using std::exp;
        return s.y[e] - exp(z[0] * s.t[e] + z[1]);
      },
      std::move(loss));
}

TEST(LeastSquares, RobustFitsAgreeWithCeres) {
  const Samples s(67, 1);
  for (const LossPair& loss : losses(0.5)) {
    SCOPED_TRACE(loss.name);
    ceres::Problem theirs(borrowed_losses());
    // The start is the fit without outliers, which is near a minimum of each loss.
    double m = 0.29, c = 0.12;
    for (Index i = 0; i < s.t.size(); ++i)
      theirs.AddResidualBlock(new ceres::AutoDiffCostFunction<CurveResidual, 1, 1, 1>(
                                  new CurveResidual{s.t[i], s.y[i]}),
                              loss.theirs.get(), &m, &c);
    const Problem ours = ProblemBuilder(2).add(curve_term(s, loss.ours), 1).build();
    NewtonOptions tight;
    tight.stopping.relative_decrease = tight.stopping.decrement = 1e-15;
    const SolveResult result = NewtonMinimizer(tight).minimize(ours, Vec{{m, c}}, {});
    ceres::Solver::Summary summary;
    ceres::Solve(test::tight_options(), &theirs, &summary);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    EXPECT_NEAR(result.energy, summary.final_cost, 1e-12 * summary.final_cost);
    EXPECT_NEAR(result.y[0], m, 1e-7);
    EXPECT_NEAR(result.y[1], c, 1e-7);
  }
}

TEST(LeastSquares, LossesAgreeWithCeres) {
  for (const double width : {0.1, 3.0})
    for (const LossPair& loss : losses(width)) {
      if (!loss.theirs) continue;
      for (const double s :
           {0.0, 1e-9, 0.3 * width * width, 0.99 * width * width, 2 * width * width, 1e6}) {
        double rho[3];
        loss.theirs->Evaluate(s, rho);
        const auto ours = loss.ours(s);
        for (std::size_t k = 0; k < 3; ++k)
          EXPECT_NEAR(ours[k], rho[k], 1e-14 * std::abs(rho[k])) << loss.name << " " << s;
      }
    }
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(huber_loss(bad), Error);
    EXPECT_THROW(tukey_loss(bad), Error);
  }
}

// Several residuals per element, as array and as vector; every loss, with both branches.
TEST(LeastSquares, Derivatives) {
  test::Random random(2);
  Cells pairs(40, 2);
  for (Index e = 0; e < pairs.rows(); ++e) pairs.row(e) << e, e + 1;
  const Vec x = random.vector(2 * 41);
  for (const LossPair& loss : losses(0.7)) {
    SCOPED_TRACE(loss.name);
    const auto array = make_least_squares<2, 2>(
        "array", pairs,
        [](Index, const auto& z) {
          using std::sin;
          return std::array{sin(z(0, 0) * z(1, 1)), z(1, 0) - z(0, 1) * z(0, 1), z(0, 0) + 0.2};
        },
        loss.ours);
    const auto vector = make_least_squares<2, 2>(
        "vector", pairs,
        [](Index e, const auto& z) { return (z.col(1) * (1.0 + e) - z.col(0)).eval(); }, loss.ours);
    for (const auto& term : {array, vector}) {
      const DerivativeReport report = check_derivatives(*term, x);
      EXPECT_TRUE(report.ok()) << report.message();
    }
  }
}

// Compares exact and Gauss-Newton curvature with J and r of a residual with known derivatives,
// r = x y - 3.
TEST(LeastSquares, CurvatureIsAsDocumented) {
  const auto term = make_least_squares<2>(
      "product", Cells{{0, 1}}, [](Index, const auto& z) { return z[0] * z[1] - 3.0; },
      cauchy_loss(2));
  const Problem problem = ProblemBuilder(2).add(term, 1).build();
  const Vec x{{1.5, 4}};
  const double r = 3, s = r * r, rho1 = 1 / (1 + s / 4), rho2 = -rho1 * rho1 / 4;
  const Eigen::Vector2d J(x[1], x[0]);
  const Eigen::Matrix2d gauss = rho1 * J * J.transpose(),
                        exact = gauss + 2 * rho2 * s * J * J.transpose() +
                                rho1 * r * (Eigen::Matrix2d() << 0, 1, 1, 0).finished();
  Evaluator evaluator(problem);
  const auto expect = [&](BlendedCurvature curvature, const Eigen::Matrix2d& H) {
    Vec g, h;
    EXPECT_NEAR(evaluator.linearize(x, curvature, g, h), 2 * std::log1p(s / 4), 1e-14);
    EXPECT_LE((g - rho1 * r * J).norm(), 1e-14);
    EXPECT_LE((h - Vec{{H(0, 0), H(1, 0), H(1, 1)}}).norm(), 1e-13 * H.norm());
  };
  expect(Curvature::Exact, exact);
  expect(Curvature::Projected, gauss);
  expect(Curvature::Reweighted, gauss);
  expect(BlendedCurvature::projected(0.25), 0.75 * exact + 0.25 * gauss);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
