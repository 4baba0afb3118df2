// Blocks of different sizes and Levenberg-Marquardt damping, on a bundle adjustment like Ceres'
// example: frame and scale are free, so that Gauss-Newton's matrix is singular.
#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include "framework/terms/ceres_options.h"
#include "majorant/framework/error.h"
#include "majorant/framework/levenberg_marquardt.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/parameter_blocks.h"
#include "random.h"

namespace majorant {
namespace {

constexpr int kCamera = 6, kPoint = 3;  // rotation vector and translation; position
constexpr double kWidth = 0.01;         // of Huber's loss

// Returns the image of p: rotated, translated, divided by its depth.
template <class T>
Eigen::Matrix<T, 2, 1> projected(const Eigen::Matrix<T, 6, 1>& camera,
                                 const Eigen::Matrix<T, 3, 1>& p) {
  using std::cos, std::sin, std::sqrt;
  const Eigen::Matrix<T, 3, 1> w = camera.template head<3>();
  const T angle2 = w.squaredNorm(), angle = sqrt(angle2);
  const T c = cos(angle), s = sin(angle) / angle, k = (1.0 - c) / angle2;
  const Eigen::Matrix<T, 3, 1> q =
      p * c + w.cross(p) * s + w * (w.dot(p) * k) + camera.template tail<3>();
  return Eigen::Matrix<T, 2, 1>(q[0] / q[2], q[1] / q[2]);
}

// Cameras on an arc that observe points in a ball; some observations are wrong.
struct Scene {
  static constexpr int cameras = 6, points = 60;
  Cells seen;  // camera, point
  Eigen::MatrixXd images;
  Vec start;

  Scene() {
    test::Random random(7);
    Vec x(kCamera * cameras + kPoint * points);
    for (int c = 0; c < cameras; ++c) {
      const double angle = 0.25 * (c - 2.4);
      x.segment<6>(kCamera * c) << 0.1 * random.uniform(), angle, 0.1 * random.uniform(),
          0.2 * random.uniform(), 0.2 * random.uniform(), 5;
    }
    for (Index i = kCamera * cameras; i < x.size(); ++i) x[i] = random.uniform();
    std::vector<std::array<int, 2>> pairs;
    for (int p = 0; p < points; ++p)
      for (int c = 0; c < cameras; ++c)
        if ((p + c) % 5) pairs.push_back({c, p});
    seen.resize(static_cast<Index>(pairs.size()), 2);
    images.resize(seen.rows(), 2);
    for (Index e = 0; e < seen.rows(); ++e) {
      seen.row(e) << pairs[e][0], pairs[e][1];
      images.row(e) = projected<double>(x.segment<6>(first(e, 0)), x.segment<3>(first(e, 1)));
      for (int d = 0; d < 2; ++d)
        images(e, d) += 0.002 * random.uniform() + (e % 17 == 5 ? 0.3 * random.uniform() : 0);
    }
    start = x;
    for (double& value : start) value += 0.2 * random.uniform();
  }

  Index first(Index e, int block) const {
    return block == 0 ? kCamera * seen(e, 0) : kCamera * cameras + kPoint * seen(e, 1);
  }
  ParameterBlocks<kCamera, kPoint> blocks() const {
    Cells all(seen.rows(), 2);
    for (Index e = 0; e < seen.rows(); ++e) all.row(e) << first(e, 0), first(e, 1);
    return ParameterBlocks<kCamera, kPoint>(all);
  }
  auto term() const {
    return make_least_squares(
        "reprojection", blocks(),
        [this](Index e, const auto& camera, const auto& point) {
          auto r = projected(camera, point);
          for (int d = 0; d < 2; ++d) r[d] -= images(e, d);
          return r;
        },
        huber_loss(kWidth));
  }
  Problem problem() const { return ProblemBuilder(start.size()).add(term(), 1).build(); }
};

struct Reprojection {
  double u, v;
  template <class T>
  bool operator()(const T* camera, const T* point, T* r) const {
    const Eigen::Matrix<T, 2, 1> at = projected<T>(Eigen::Map<const Eigen::Matrix<T, 6, 1>>(camera),
                                                   Eigen::Map<const Eigen::Matrix<T, 3, 1>>(point));
    r[0] = at[0] - u;
    r[1] = at[1] - v;
    return true;
  }
};

// Returns Ceres' summary with cost and iterations.
ceres::Solver::Summary solve_by_ceres(const Scene& scene) {
  Vec x = scene.start;
  ceres::Problem problem;
  for (Index e = 0; e < scene.seen.rows(); ++e)
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Reprojection, 2, kCamera, kPoint>(
                                 new Reprojection{scene.images(e, 0), scene.images(e, 1)}),
                             new ceres::HuberLoss(kWidth), x.data() + scene.first(e, 0),
                             x.data() + scene.first(e, 1));
  ceres::Solver::Summary summary;
  ceres::Solve(test::tight_options(), &problem, &summary);
  return summary;
}

TEST(ParameterBlocks, derivatives_are_those_of_the_blocks) {
  const Scene scene;
  const DerivativeReport report = check_derivatives(*scene.term(), scene.start);
  EXPECT_TRUE(report.ok()) << report.message();
  const Cells unknowns = scene.blocks().unknowns();
  ASSERT_EQ(unknowns.cols(), kCamera + kPoint);
  EXPECT_EQ(unknowns(3, 0), scene.first(3, 0));
  EXPECT_EQ(unknowns(3, 5), scene.first(3, 0) + 5);
  EXPECT_EQ(unknowns(3, 6), scene.first(3, 1));
}

TEST(ParameterBlocks, the_energy_is_that_of_ceres) {
  const Scene scene;
  const Problem problem = scene.problem();
  EXPECT_NEAR(Evaluator(problem).value(scene.start), solve_by_ceres(scene).initial_cost,
              1e-12 * solve_by_ceres(scene).initial_cost);
}

TEST(ParameterBlocks, terms_of_any_blocks) {
  Cells first(2, 3);
  first << 0, 3, 1, 2, 0, 5;
  const auto term = make_term("mixed", ParameterBlocks<1, 2, 1>(first),
                              [](Index e, const auto& a, const auto& b, const auto& c) {
                                return a[0] * b.squaredNorm() + double(e) * c[0] * b[1];
                              });
  const Vec x{{1, 2, 3, 4, 5, 6}};
  const Problem problem = ProblemBuilder(6).add(term, 1).build();
  EXPECT_DOUBLE_EQ(Evaluator(problem).value(x), 1 * (16 + 25) + 3 * (1 + 4) + 6 * 2);
  EXPECT_TRUE(check_derivatives(*term, x).ok());
}

TEST(ParameterBlocks, another_number_of_columns_is_refused) {
  EXPECT_THROW((ParameterBlocks<6, 3>(Cells::Zero(2, 3))), InvalidArgument);
}

TEST(LevenbergMarquardt, ends_where_ceres_does) {
  const Scene scene;
  const Problem problem = scene.problem();
  LevenbergMarquardtOptions options;
  options.stopping.relative_decrease = 1e-14;
  const SolveResult ours = LevenbergMarquardtMinimizer(options).minimize(problem, scene.start, {});
  const ceres::Solver::Summary theirs = solve_by_ceres(scene);
  EXPECT_EQ(ours.status, Status::Converged) << ours.message;
  EXPECT_NEAR(ours.energy, theirs.final_cost, 1e-8 * theirs.final_cost);
  // Wrong observations have residuals at the minimum.
  EXPECT_LT(ours.energy, 0.3 * Evaluator(problem).value(scene.start));
  EXPECT_LE(ours.iterations.size(), theirs.iterations.size());
}

TEST(LevenbergMarquardt, lambda_falls_where_the_model_is_right_and_rises_where_it_is_not) {
  // Rosenbrock's valley as least squares.
  const auto valley = make_least_squares<2>(
      "valley", Cells::Ones(1, 1) * Eigen::RowVector2i(0, 1), [](Index, const auto& z) {
        return std::array{10.0 * (z[1] - z[0] * z[0]), 1.0 - z[0]};
      });
  const Problem problem = ProblemBuilder(2).add(valley, 1).build();
  LevenbergMarquardtOptions options;
  options.damping.first = 1;
  const SolveResult result =
      LevenbergMarquardtMinimizer(options).minimize(problem, Vec{{-1.2, 1}}, {});
  ASSERT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_NEAR((result.y - Vec::Ones(2)).norm(), 0, 1e-6);
  double most = 0, least = 1;
  for (const IterationRecord& r : result.iterations) {
    most = std::max(most, r.shift);
    least = std::min(least, r.shift);
  }
  EXPECT_LT(least, 1e-3);
  EXPECT_GE(most, 1);
  EXPECT_LT(result.iterations.size(), 60u);
}

TEST(LevenbergMarquardt, unknowns_that_nothing_sees_stay) {
  const auto one =
      make_least_squares<2>("one of two", Cells::Ones(1, 1) * Eigen::RowVector2i(0, 1),
                            [](Index, const auto& z) { return z[0] - 3.0 + 0.0 * z[1]; });
  const Problem problem = ProblemBuilder(2).add(one, 1).build();
  const SolveResult result = LevenbergMarquardtMinimizer().minimize(problem, Vec{{0, 7}}, {});
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_NEAR(result.y[0], 3, 1e-6);
  EXPECT_EQ(result.y[1], 7);
}

TEST(LevenbergMarquardt, options_that_are_no_rules_are_refused) {
  const Scene scene;
  const Problem problem = scene.problem();
  const auto refused = [&](auto change) {
    LevenbergMarquardtOptions options;
    change(options);
    EXPECT_THROW(LevenbergMarquardtMinimizer(options).minimize(problem, scene.start, {}),
                 InvalidArgument);
  };
  refused([](auto& o) { o.damping.first = 0; });
  refused([](auto& o) { o.damping.smallest = 1; });
  refused([](auto& o) { o.damping.least = -1; });
  refused([](auto& o) { o.damping.largest = std::numeric_limits<double>::infinity(); });
  refused([](auto& o) { o.curvature = Curvature::Majorizer; });
  refused([](auto& o) { o.linear_solver = {}; });
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
