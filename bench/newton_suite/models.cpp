#include "models.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/framework/terms/parameter_blocks.h"

namespace majorant::newton_suite {
namespace {

// Returns the least squares of these residuals, each a function of all N unknowns.
template <int N, class F>
SuiteInstance fit(const char* name, Index count, const Vec& x, const Vec& spread, F f,
                  RobustLoss loss = {}) {
  auto term = make_least_squares<N>(name, all_unknowns(count, N), f, std::move(loss));
  Problem problem = ProblemBuilder(N).add(std::move(term), 1).build();
  std::vector<Vec> starts = starts_around(problem, x, spread);
  return {std::move(problem), std::move(starts)};
}

}  // namespace

SuiteInstance exponential_fit(double noise) {
  const Vec t = Vec::LinSpaced(30, 0, 3);
  const Vec y = (2.5 * (-1.3 * t.array()).exp() + 0.5).matrix() + noise * Uniform(1).vector(30);
  return fit<3>("fit", 30, Vec{{1, -0.5, 0}}, Vec{{0.5, 0.2, 0.5}}, [=](Index e, const auto& z) {
    using std::exp;
    return z[0] * exp(z[1] * t[e]) + z[2] - y[e];
  });
}

SuiteInstance two_exponentials(double noise) {
  const Vec t = Vec::LinSpaced(40, 0, 4);
  const Vec y = (3 * (-0.5 * t.array()).exp() + 2 * (-3 * t.array()).exp()).matrix() +
                noise * Uniform(2).vector(40);
  return fit<4>("fit", 40, Vec{{1, 0.2, 1, 2}}, Vec{{0.5, 0.1, 0.5, 0.5}},
                [=](Index e, const auto& z) {
                  using std::exp;
                  return z[0] * exp(-t[e] * z[1]) + z[2] * exp(-t[e] * z[3]) - y[e];
                });
}

SuiteInstance circle_fit(double noise, double arc) {
  Uniform random(3);
  RowMatrix points(40, 2);
  for (Index i = 0; i < 40; ++i) {
    const double t = arc * static_cast<double>(i) / 39, r = 2 + noise * random();
    points.row(i) << 1 + r * std::cos(t), -0.5 + r * std::sin(t);
  }
  return fit<3>("circle", 40, Vec{{0, 0, 1}}, Vec{{1, 1, 0.5}}, [points](Index e, const auto& z) {
    using std::sqrt;
    const auto a = z[0] - points(e, 0), b = z[1] - points(e, 1);
    return sqrt(a * a + b * b) - z[2];
  });
}

SuiteInstance peaks_fit() {
  const Vec t = Vec::LinSpaced(60, 0, 10);
  const auto peak = [](double height, double at, const Vec& s) {
    return (height * (-(s.array() - at).square()).exp()).matrix().eval();
  };
  const Vec y =
      peak(2, 3, t) + peak(1, 6, t) + Vec::Constant(60, 0.2) + 0.05 * Uniform(4).vector(60);
  return fit<7>("peaks", 60, Vec{{1, 2.5, 1.5, 1, 6.5, 1.5, 0}},
                Vec{{0.3, 0.5, 0.3, 0.3, 0.5, 0.3, 0.2}}, [=](Index e, const auto& z) {
                  using std::exp;
                  const auto a = z[1] - t[e], b = z[4] - t[e];
                  return z[0] * exp(-z[2] * a * a) + z[3] * exp(-z[5] * b * b) + z[6] - y[e];
                });
}

SuiteInstance robust_line() {
  const Vec t = Vec::LinSpaced(40, -1, 1);
  Vec y = 2 * t + Vec::Constant(40, 0.5) + 0.05 * Uniform(5).vector(40);
  for (Index i = 0; i < 40; i += 4) y[i] += 3 + 0.02 * static_cast<double>(i);
  return fit<2>(
      "line", 40, Vec{{0, 0}}, Vec{{2, 1}},
      [=](Index e, const auto& z) { return z[0] * t[e] + z[1] - y[e]; }, cauchy_loss(0.3));
}

SuiteInstance logistic_fit() {
  const Vec t = Vec::LinSpaced(25, 0, 12);
  const Vec y = (5 / (1 + (4 - 0.9 * t.array()).exp())).matrix() + 0.1 * Uniform(6).vector(25);
  return fit<3>("growth", 25, Vec{{1, 1, 0.5}}, Vec{{1, 1, 0.3}}, [=](Index e, const auto& z) {
    using std::exp;
    return z[0] / (1.0 + exp(z[1] - z[2] * t[e])) - y[e];
  });
}

SuiteInstance logistic_regression() {
  constexpr int n = 12, count = 150;
  Uniform random(7);
  Eigen::MatrixXd features(count, n);
  for (double& entry : features.reshaped()) entry = random();
  const Vec truth = 5 * random.vector(n);
  Vec label(count);
  for (Index i = 0; i < count; ++i)
    label[i] = features.row(i).dot(truth) + 2 * random() > 0 ? 1 : -1;
  auto loss = make_term<n>("likelihood", all_unknowns(count, n), [=](Index e, const auto& z) {
    using std::exp;
    using std::log;
    using T = typename std::decay_t<decltype(z)>::Scalar;
    T s = T(0.0);
    for (int j = 0; j < n; ++j) s = s + features(e, j) * z[j];
    s = T(label[e] * s);
    return s > 0.0 ? T(log(1.0 + exp(-s))) : T(log(1.0 + exp(s)) - s);
  });
  auto penalty =
      make_term<1>("penalty", runs(n, 1), [](Index, const auto& z) { return z[0] * z[0]; });
  const Problem problem = ProblemBuilder(n).add(loss, 1).add(penalty, 0.01).build();
  std::vector<Vec> starts = starts_around(problem, Vec::Zero(n), 20);
  return {problem, std::move(starts)};
}

namespace {

template <class T>
using Point = Eigen::Matrix<T, 3, 1>;

// Rotates by Rodrigues' formula, or by its Taylor expansion for tiny angles.
template <class T, class V, class P>
Point<T> rotated(const V& w, const P& p) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T s = w.squaredNorm();
  const Point<T> cross = w.cross(p);
  if (!(s > 1e-16)) return p + cross;
  const T angle = sqrt(s);
  const Point<T> again = w.cross(cross);
  return p + cross * T(sin(angle) / angle) + again * T((1.0 - cos(angle)) / s);
}

}  // namespace

SuiteInstance bundle_adjustment(double noise, bool is_robust) {
  constexpr Index cameras = 6, points = 30;
  Uniform random(8);
  Vec x(6 * cameras + 3 * points);
  for (Index c = 0; c < cameras; ++c) {
    x.segment<3>(6 * c) = 0.2 * random.vector(3);
    x.segment<3>(6 * c + 3) = Vec{{0, 0, 5}} + random.vector(3);
  }
  for (Index p = 0; p < points; ++p) x.segment<3>(6 * cameras + 3 * p) = random.vector(3);
  Cells first(cameras * points, 2);
  RowMatrix seen(cameras * points, 2);
  for (Index c = 0, e = 0; c < cameras; ++c)
    for (Index p = 0; p < points; ++p, ++e) {
      first.row(e) << 6 * c, 6 * cameras + 3 * p;
      const Vector3 at = rotated<double>(x.segment<3>(6 * c), x.segment<3>(6 * cameras + 3 * p)) +
                         x.segment<3>(6 * c + 3);
      seen.row(e) << at[0] / at[2] + 1e-3 * noise * random(),
          at[1] / at[2] + 1e-3 * noise * random();
      if (is_robust && e % 10 == 3) seen(e, 0) += 0.3;
    }
  auto term = make_least_squares(
      "seen", ParameterBlocks<6, 3>(first),
      [seen](Index e, const auto& camera, const auto& point) {
        using T = typename std::decay_t<decltype(camera)>::Scalar;
        const Point<T> w = camera.template head<3>(), t = camera.template tail<3>();
        const Point<T> at = rotated<T>(w, point) + t;
        return std::array<T, 2>{at[0] / at[2] - seen(e, 0), at[1] / at[2] - seen(e, 1)};
      },
      is_robust ? huber_loss(0.01) : RobustLoss());
  const Problem problem = ProblemBuilder(x.size()).add(std::move(term), 1).build();
  std::vector<Vec> starts = starts_around(problem, x, 0.1);
  starts.front() = problem.reduce(x + 0.05 * Uniform(9).vector(x.size()));
  return {problem, std::move(starts)};
}

SuiteInstance pose_graph() {
  constexpr Index n = 40;
  Uniform random(10);
  // A figure of eight, passed twice.
  Vec x(3 * n);
  for (Index i = 0; i < n; ++i) {
    const double t = 4 * std::numbers::pi * static_cast<double>(i) / n;
    x.segment<3>(3 * i) << 3 * std::sin(t), 2 * std::sin(2 * t),
        std::atan2(4 * std::cos(2 * t), 3 * std::cos(t));
  }
  std::vector<std::array<Index, 2>> seen;
  for (Index i = 0; i + 1 < n; ++i) seen.push_back({i, i + 1});
  for (Index i = 0; i + n / 2 < n; i += 2) seen.push_back({i, i + n / 2});
  Cells first(static_cast<Index>(seen.size()), 2);
  RowMatrix measured(first.rows(), 3);
  for (Index e = 0; e < first.rows(); ++e) {
    const Index a = seen[to_size(e)][0], b = seen[to_size(e)][1];
    first.row(e) << a, b;
    const double c = std::cos(x[3 * a + 2]), s = std::sin(x[3 * a + 2]);
    const double dx = x[3 * b] - x[3 * a], dy = x[3 * b + 1] - x[3 * a + 1];
    measured.row(e) << c * dx + s * dy + 0.05 * random(), -s * dx + c * dy + 0.05 * random(),
        x[3 * b + 2] - x[3 * a + 2] + 0.02 * random();
  }
  auto term = make_least_squares<2, 3>("poses", first, [measured](Index e, const auto& z) {
    using std::cos;
    using std::sin;
    using T = typename std::decay_t<decltype(z)>::Scalar;
    const T c = cos(z(2, 0)), s = sin(z(2, 0)), dx = z(0, 1) - z(0, 0), dy = z(1, 1) - z(1, 0);
    const T turn = z(2, 1) - z(2, 0) - measured(e, 2);
    // Half angles, since whole turns have no effect.
    return std::array<T, 4>{10.0 * (c * dx + s * dy - measured(e, 0)),
                            10.0 * (c * dy - s * dx - measured(e, 1)), 10.0 * sin(turn),
                            10.0 * (1.0 - cos(turn))};
  });
  ProblemBuilder builder(3 * n);
  builder.add(std::move(term), 1).add(FixedUnknowns({{0, x[0]}, {1, x[1]}, {2, x[2]}}));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, x, 0.3);
  // The natural start is odometry alone, which drifts.
  Vec walk = x;
  for (Index i = 0; i + 1 < n; ++i) {
    const double c = std::cos(walk[3 * i + 2]), s = std::sin(walk[3 * i + 2]);
    walk[3 * i + 3] = walk[3 * i] + c * measured(i, 0) - s * measured(i, 1);
    walk[3 * i + 4] = walk[3 * i + 1] + s * measured(i, 0) + c * measured(i, 1);
    walk[3 * i + 5] = walk[3 * i + 2] + measured(i, 2);
  }
  starts.front() = problem.reduce(walk);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance pendulum(int n, double time) {
  const double h = time / n;
  // Two equal angles at each end make the pendulum rest there.
  ProblemBuilder builder(n + 1);
  builder.add(make_least_squares<3>("torque", runs(n - 1, 3),
                                    [h](Index, const auto& z) {
                                      using std::sin;
                                      return std::sqrt(h) *
                                             ((z[0] - 2.0 * z[1] + z[2]) / (h * h) + sin(z[1]));
                                    }),
              1);
  builder.add(FixedUnknowns({{0, 0}, {1, 0}, {n - 1, std::numbers::pi}, {n, std::numbers::pi}}));
  Problem problem = builder.build();
  std::vector<Vec> starts = starts_around(problem, Vec::LinSpaced(n + 1, 0, std::numbers::pi), 0.3);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance van_der_pol(int n) {
  const double h = 5.0 / n;
  // Each node has the unknowns x, x', u.
  ProblemBuilder builder(3 * (n + 1));
  builder
      .add(make_least_squares<2, 3>(
               "dynamics", runs(n, 2),
               [h](Index, const auto& z) {
                 using T = typename std::decay_t<decltype(z)>::Scalar;
                 const T x = 0.5 * (z(0, 0) + z(0, 1)), v = 0.5 * (z(1, 0) + z(1, 1)),
                         u = 0.5 * (z(2, 0) + z(2, 1));
                 return std::array<T, 2>{(z(0, 1) - z(0, 0)) / h - v,
                                         (z(1, 1) - z(1, 0)) / h - ((1.0 - x * x) * v - x + u)};
               }),
           1e3)
      .add(
          make_least_squares<1, 3>("cost", runs(n + 1, 1),
                                   [h](Index, const auto& z) { return (std::sqrt(h) * z).eval(); }),
          1)
      .add(FixedUnknowns({{0, 1}, {1, 0}}));
  Problem problem = builder.build();
  Vec x = Vec::Zero(3 * (n + 1));
  x[0] = 1;
  std::vector<Vec> starts = starts_around(problem, x, 0.5);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance path_past_obstacles(int n) {
  const double h = 1.0 / n;
  ProblemBuilder builder(2 * (n + 1));
  builder
      .add(make_term<3, 2>("acceleration", runs(n - 1, 3),
                           [h](Index, const auto& z) {
                             const auto a = (z.col(0) - 2.0 * z.col(1) + z.col(2)).eval();
                             return a.squaredNorm() / (2 * h * h * h);
                           }),
           1)
      .add(make_term<1, 2>("obstacles", runs(n + 1, 1),
                           [h](Index, const auto& z) {
                             using std::exp;
                             using T = typename std::decay_t<decltype(z)>::Scalar;
                             T sum = T(0.0);
                             for (const auto& [x, y] : {std::pair(0.3, 0.05), {0.7, -0.05}}) {
                               const T a = z(0, 0) - x, b = z(1, 0) - y;
                               sum = sum + exp(-50.0 * (a * a + b * b));
                             }
                             return T(h * sum);
                           }),
           200);
  std::vector<FixedUnknown> held;
  for (const Index i : {Index(0), Index(1), Index(n - 1), Index(n)}) {
    held.push_back({2 * i, static_cast<double>(i) * h});
    held.push_back({2 * i + 1, 0});
  }
  builder.add(FixedUnknowns(held));
  Problem problem = builder.build();
  Vec x = Vec::Zero(2 * (n + 1));
  for (Index i = 0; i <= n; ++i) x[2 * i] = static_cast<double>(i) * h;
  std::vector<Vec> starts = starts_around(problem, x, 0.02);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance brachistochrone(int n) {
  const double h = 1.0 / n;
  // Unknowns are depths at n + 1 places; the first is 0, the last 0.6.
  ProblemBuilder builder(n + 1);
  builder
      .add(make_term<2>("time", runs(n, 2),
                        [h](Index, const auto& z) {
                          using std::sqrt;
                          const auto d = z[1] - z[0];
                          // This is the mean of 1 / sqrt along a straight piece.
                          return 2.0 * sqrt(h * h + d * d) / (sqrt(z[0]) + sqrt(z[1]));
                        }),
           1)
      .add(FixedUnknowns({{0, 1e-3}, {n, 0.6}}));
  Problem problem = builder.build();
  Vec x(n + 1), spread(n + 1);
  for (Index i = 0; i <= n; ++i) {
    x[i] = 1e-3 + 0.599 * static_cast<double>(i) / n;
    spread[i] = 0.5 * x[i];
  }
  std::vector<Vec> starts = starts_around(problem, x, spread);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance two_link_arm(int n) {
  const double h = 1.0 / n;
  // The energy is the square of the torques of two equal links without gravity.
  ProblemBuilder builder(2 * (n + 1));
  builder.add(make_least_squares<3, 2>(
                  "torques", runs(n - 1, 3),
                  [h](Index, const auto& z) {
                    using std::cos;
                    using std::sin;
                    using T = typename std::decay_t<decltype(z)>::Scalar;
                    const T a1 = (z(0, 0) - 2.0 * z(0, 1) + z(0, 2)) / (h * h);
                    const T a2 = (z(1, 0) - 2.0 * z(1, 1) + z(1, 2)) / (h * h);
                    const T v1 = (z(0, 2) - z(0, 0)) / (2 * h), v2 = (z(1, 2) - z(1, 0)) / (2 * h);
                    const T c = cos(z(1, 1)), s = sin(z(1, 1));
                    const T mixed = 1.0 / 3 + 0.5 * c;
                    return std::array<T, 2>{
                        std::sqrt(h) * ((5.0 / 3 + c) * a1 + mixed * a2 - s * v2 * (v1 + 0.5 * v2)),
                        std::sqrt(h) * (mixed * a1 + a2 / 3.0 + 0.5 * s * v1 * v1)};
                  }),
              1);
  std::vector<FixedUnknown> held;
  for (const Index i : {0, 1})
    for (const Index c : {0, 1}) {
      held.push_back({2 * i + c, 0});
      held.push_back({2 * (n - i) + c, c == 0 ? 2.5 : -2.0});
    }
  builder.add(FixedUnknowns(held));
  Problem problem = builder.build();
  Vec x(2 * (n + 1));
  for (Index i = 0; i <= n; ++i)
    x.segment<2>(2 * i) << 2.5 * static_cast<double>(i) / n, -2.0 * static_cast<double>(i) / n;
  std::vector<Vec> starts = starts_around(problem, x, 0.1);
  return {std::move(problem), std::move(starts)};
}

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
