#include "classical.h"

#include <array>
#include <cmath>
#include <numbers>

#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"

namespace majorant::newton_suite {
namespace {

const std::vector<double> kFactors{0.5, 2, -1, 5};

Problem problem_of(Index size, std::shared_ptr<const EnergyTerm> term) {
  return ProblemBuilder(size).add(std::move(term), 1).build();
}

// Returns the least squares of these residuals, each a function of all N unknowns.
template <int N, class F>
SuiteInstance residuals(const char* name, Index count, const Vec& x, double spread, F f,
                        const std::vector<double>& factors = kFactors) {
  Problem problem = problem_of(N, make_least_squares<N>(name, all_unknowns(count, N), f));
  std::vector<Vec> starts = scaled_starts(problem, x, factors, spread);
  return {std::move(problem), std::move(starts)};
}

template <class Z>
using ScalarOf = typename std::decay_t<Z>::Scalar;

}  // namespace

SuiteInstance rosenbrock() {
  return residuals<2>("Rosenbrock", 2, Vec{{-1.2, 1}}, 2, [](Index e, const auto& z) {
    using T = ScalarOf<decltype(z)>;
    return e == 0 ? T(10.0 * (z[1] - z[0] * z[0])) : T(1.0 - z[0]);
  });
}

SuiteInstance rosenbrock_as_term() {
  Problem problem =
      problem_of(2, make_term<2>("Rosenbrock", all_unknowns(1, 2), [](Index, const auto& z) {
                   const auto a = z[1] - z[0] * z[0];
                   const auto b = 1.0 - z[0];
                   return 50.0 * a * a + 0.5 * b * b;
                 }));
  std::vector<Vec> starts = scaled_starts(problem, Vec{{-1.2, 1}}, kFactors, 2);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance extended_rosenbrock(int pairs) {
  Cells unknowns(2 * pairs, 2);
  Vec x(2 * pairs);
  for (Index e = 0; e < 2 * pairs; ++e) {
    unknowns.row(e) << e / 2 * 2, e / 2 * 2 + 1;
    x[e] = e % 2 ? 1 : -1.2;
  }
  Problem problem = problem_of(
      2 * pairs, make_least_squares<2>("Rosenbrock", unknowns, [](Index e, const auto& z) {
        using T = ScalarOf<decltype(z)>;
        return e % 2 == 0 ? T(10.0 * (z[1] - z[0] * z[0])) : T(1.0 - z[0]);
      }));
  std::vector<Vec> starts = scaled_starts(problem, x, kFactors, 2);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance freudenstein_roth() {
  return residuals<2>("Freudenstein and Roth", 2, Vec{{0.5, -2}}, 3, [](Index e, const auto& z) {
    using T = ScalarOf<decltype(z)>;
    return e == 0 ? T(-13.0 + z[0] + ((5.0 - z[1]) * z[1] - 2.0) * z[1])
                  : T(-29.0 + z[0] + ((z[1] + 1.0) * z[1] - 14.0) * z[1]);
  });
}

SuiteInstance powell_badly_scaled() {
  return residuals<2>("Powell, badly scaled", 2, Vec{{0, 1}}, 0.5,
                      [](Index e, const auto& z) {
                        using std::exp;
                        using T = ScalarOf<decltype(z)>;
                        return e == 0 ? T(1e4 * z[0] * z[1] - 1.0)
                                      : T(exp(-z[0]) + exp(-z[1]) - 1.0001);
                      },
                      {0.5, 2, 3, 4});
}

SuiteInstance brown_badly_scaled() {
  return residuals<2>("Brown, badly scaled", 3, Vec{{1, 1}}, 2, [](Index e, const auto& z) {
    using T = ScalarOf<decltype(z)>;
    return e == 0 ? T(z[0] - 1e6) : e == 1 ? T(z[1] - 2e-6) : T(z[0] * z[1] - 2.0);
  });
}

namespace {

template <class Z>
auto beale_residual(Index e, const Z& z) {
  constexpr std::array<double, 3> y{1.5, 2.25, 2.625};
  auto power = z[1];
  for (Index k = 0; k < e; ++k) power = power * z[1];
  return y[to_size(e)] - z[0] * (1.0 - power);
}

}  // namespace

SuiteInstance beale() {
  return residuals<2>("Beale", 3, Vec{{1, 1}}, 0.3,
                      [](Index e, const auto& z) { return beale_residual(e, z); },
                      {0.5, 0.7, 0.9, 0.2});
}

SuiteInstance beale_as_term() {
  Problem problem = problem_of(
      2, make_term<2>("Beale", all_unknowns(1, 2), [](Index, const auto& z) {
        const auto a = beale_residual(0, z), b = beale_residual(1, z), c = beale_residual(2, z);
        return 0.5 * (a * a + b * b + c * c);
      }));
  std::vector<Vec> starts = scaled_starts(problem, Vec{{1, 1}}, {0.5, 0.7, 0.9, 0.2}, 0.3);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance jennrich_sampson() {
  return residuals<2>("Jennrich and Sampson", 10, Vec{{0.3, 0.4}}, 0.2,
                      [](Index e, const auto& z) {
                        using std::exp;
                        const double i = static_cast<double>(e + 1);
                        return 2.0 + 2.0 * i - (exp(i * z[0]) + exp(i * z[1]));
                      },
                      {0.5, 1.2, 0, -1});
}

SuiteInstance helical_valley() {
  return residuals<3>("helical valley", 3, Vec{{-1, 0, 0}}, 0.9,
                      [](Index e, const auto& z) {
                        using std::atan;
                        using std::sqrt;
                        using T = ScalarOf<decltype(z)>;
                        if (e == 2) return T(z[2]);
                        if (e == 1) return T(10.0 * (sqrt(z[0] * z[0] + z[1] * z[1]) - 1.0));
                        const T turn =
                            atan(z[1] / z[0]) / (2 * std::numbers::pi) + (z[0] < 0.0 ? 0.5 : 0.0);
                        return T(10.0 * (z[2] - 10.0 * turn));
                      },
                      {0.5, 2, 3, 10});
}

SuiteInstance bard() {
  return residuals<3>("Bard", 15, Vec{{1, 1, 1}}, 0.3,
                      [](Index e, const auto& z) {
                        constexpr std::array<double, 15> y{0.14, 0.18, 0.22, 0.25, 0.29,
                                                           0.32, 0.35, 0.39, 0.37, 0.58,
                                                           0.73, 0.96, 1.34, 2.10, 4.39};
                        const double u = static_cast<double>(e + 1), v = 16 - u, w = std::min(u, v);
                        return y[to_size(e)] - (z[0] + u / (v * z[1] + w * z[2]));
                      },
                      {0.5, 2, 0.8, 1.5});
}

SuiteInstance gaussian() {
  return residuals<3>("Gaussian", 15, Vec{{0.4, 1, 0}}, 0.3,
                      [](Index e, const auto& z) {
                        using std::exp;
                        constexpr std::array<double, 8> y{0.0009, 0.0044, 0.0175, 0.0540,
                                                          0.1295, 0.2420, 0.3521, 0.3989};
                        const double t = 0.5 * (8.0 - static_cast<double>(e + 1));
                        const auto off = t - z[2];
                        return z[0] * exp(-0.5 * z[1] * off * off) -
                               y[to_size(std::min<Index>(e, 14 - e))];
                      },
                      {0.5, 2, 1.5, 0.7});
}

SuiteInstance gulf() {
  return residuals<3>("Gulf research", 99, Vec{{5, 2.5, 0.15}}, 0.05,
                      [](Index e, const auto& z) {
                        using std::abs;
                        using std::exp;
                        using std::pow;
                        const double t = 0.01 * static_cast<double>(e + 1);
                        const double y = 25 + std::pow(-50 * std::log(t), 2.0 / 3);
                        return exp(-pow(abs(y - z[1]), z[2]) / z[0]) - t;
                      },
                      {0.9, 0.95, 1.05, 1.1});
}

SuiteInstance box_3d() {
  return residuals<3>("Box", 10, Vec{{0, 10, 20}}, 1,
                      [](Index e, const auto& z) {
                        using std::exp;
                        const double t = 0.1 * static_cast<double>(e + 1);
                        return exp(-t * z[0]) - exp(-t * z[1]) -
                               z[2] * (std::exp(-t) - std::exp(-10 * t));
                      },
                      {0.5, 0.8, 1.2, 2});
}

SuiteInstance powell_singular(int fours) {
  Cells unknowns(4 * fours, 4);
  Vec x(4 * fours);
  for (Index e = 0; e < 4 * fours; ++e)
    for (int k = 0; k < 4; ++k) unknowns(e, k) = e / 4 * 4 + k;
  for (Index i = 0; i < fours; ++i) x.segment<4>(4 * i) << 3, -1, 0, 1;
  Problem problem = problem_of(
      4 * fours, make_least_squares<4>("Powell, singular", unknowns, [](Index e, const auto& z) {
        using T = ScalarOf<decltype(z)>;
        const T middle = z[1] - 2.0 * z[2], ends = z[0] - z[3];
        switch (e % 4) {
          case 0:
            return T(z[0] + 10.0 * z[1]);
          case 1:
            return T(std::sqrt(5.0) * (z[2] - z[3]));
          case 2:
            return T(middle * middle);
          default:
            return T(std::sqrt(10.0) * ends * ends);
        }
      }));
  std::vector<Vec> starts = scaled_starts(problem, x, kFactors, 3);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance wood() {
  return residuals<4>("Wood", 6, Vec{{-3, -1, -3, -1}}, 3, [](Index e, const auto& z) {
    using T = ScalarOf<decltype(z)>;
    switch (e) {
      case 0:
        return T(10.0 * (z[1] - z[0] * z[0]));
      case 1:
        return T(1.0 - z[0]);
      case 2:
        return T(std::sqrt(90.0) * (z[3] - z[2] * z[2]));
      case 3:
        return T(1.0 - z[2]);
      case 4:
        return T(std::sqrt(10.0) * (z[1] + z[3] - 2.0));
      default:
        return T((z[1] - z[3]) / std::sqrt(10.0));
    }
  });
}

SuiteInstance wood_as_term() {
  Problem problem =
      problem_of(4, make_term<4>("Wood", all_unknowns(1, 4), [](Index, const auto& z) {
                   const auto square = [](const auto& v) { return v * v; };
                   return 50.0 * square(z[1] - z[0] * z[0]) + 0.5 * square(1.0 - z[0]) +
                          45.0 * square(z[3] - z[2] * z[2]) + 0.5 * square(1.0 - z[2]) +
                          5.0 * square(z[1] + z[3] - 2.0) + 0.05 * square(z[1] - z[3]);
                 }));
  std::vector<Vec> starts = scaled_starts(problem, Vec{{-3, -1, -3, -1}}, kFactors, 3);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance kowalik_osborne() {
  return residuals<4>(
      "Kowalik and Osborne", 11, Vec{{0.25, 0.39, 0.415, 0.39}}, 0.1,
      [](Index e, const auto& z) {
        constexpr std::array<double, 11> y{0.1957, 0.1947, 0.1735, 0.1600, 0.0844, 0.0627,
                                           0.0456, 0.0342, 0.0323, 0.0235, 0.0246};
        constexpr std::array<double, 11> u{4,     2,   1,      0.5,    0.25,  0.167,
                                           0.125, 0.1, 0.0833, 0.0714, 0.0625};
        const double v = u[to_size(e)];
        return y[to_size(e)] - z[0] * (v * v + v * z[1]) / (v * v + v * z[2] + z[3]);
      },
      {0.5, 0.8, 1.2, 1.5});
}

SuiteInstance brown_dennis() {
  return residuals<4>("Brown and Dennis", 20, Vec{{25, 5, -5, -1}}, 5, [](Index e, const auto& z) {
    const double t = 0.2 * static_cast<double>(e + 1);
    const auto a = z[0] + t * z[1] - std::exp(t);
    const auto b = z[2] + z[3] * std::sin(t) - std::cos(t);
    return a * a + b * b;
  });
}

SuiteInstance biggs_exp6() {
  return residuals<6>(
      "Biggs EXP6", 13, Vec{{1, 2, 1, 1, 1, 1}}, 0.2,
      [](Index e, const auto& z) {
        using std::exp;
        const double t = 0.1 * static_cast<double>(e + 1);
        const double y = std::exp(-t) - 5 * std::exp(-10 * t) + 3 * std::exp(-4 * t);
        return z[2] * exp(-t * z[0]) - z[3] * exp(-t * z[1]) + z[5] * exp(-t * z[4]) - y;
      },
      {0.8, 0.9, 1.1, 1.3});
}

SuiteInstance watson() {
  return residuals<6>("Watson", 31, Vec::Zero(6), 1, [](Index e, const auto& z) {
    using T = ScalarOf<decltype(z)>;
    if (e == 29) return T(z[0]);
    if (e == 30) return T(z[1] - z[0] * z[0] - 1.0);
    const double t = static_cast<double>(e + 1) / 29;
    T sum = T(0.0), slope = T(0.0);
    double power = 1;  // t^j
    for (int j = 0; j < 6; ++j) {
      sum = sum + power * z[j];
      if (j < 5) slope = slope + (j + 1) * power * z[j + 1];
      power *= t;
    }
    return T(slope - sum * sum - 1.0);
  });
}

SuiteInstance penalty_1() {
  Vec x = Vec::LinSpaced(10, 1, 10);
  return residuals<10>("penalty I", 11, x, 3, [](Index e, const auto& z) {
    using T = ScalarOf<decltype(z)>;
    if (e < 10) return T(std::sqrt(1e-5) * (z[e] - 1.0));
    T sum = T(-0.25);
    for (int j = 0; j < 10; ++j) sum = sum + z[j] * z[j];
    return sum;
  });
}

SuiteInstance penalty_2() {
  return residuals<10>("penalty II", 20, Vec::Constant(10, 0.5), 0.3, [](Index e, const auto& z) {
    using std::exp;
    using T = ScalarOf<decltype(z)>;
    const double a = std::sqrt(1e-5);
    if (e == 0) return T(z[0] - 0.2);
    if (e < 10) {
      const double y =
          std::exp(0.1 * static_cast<double>(e + 1)) + std::exp(0.1 * static_cast<double>(e));
      return T(a * (exp(z[e] / 10.0) + exp(z[e - 1] / 10.0) - y));
    }
    if (e < 19) return T(a * (exp(z[e - 9] / 10.0) - std::exp(-0.1)));
    T sum = T(-1.0);
    for (int j = 0; j < 10; ++j) sum = sum + (10.0 - j) * z[j] * z[j];
    return sum;
  });
}

SuiteInstance variably_dimensioned() {
  Vec x(10);
  for (Index i = 0; i < 10; ++i) x[i] = 1 - static_cast<double>(i + 1) / 10;
  return residuals<10>("variably dimensioned", 12, x, 1, [](Index e, const auto& z) {
    using T = ScalarOf<decltype(z)>;
    if (e < 10) return T(z[e] - 1.0);
    T sum = T(0.0);
    for (int j = 0; j < 10; ++j) sum = sum + (j + 1.0) * (z[j] - 1.0);
    return e == 10 ? sum : T(sum * sum);
  });
}

SuiteInstance trigonometric() {
  return residuals<10>("trigonometric", 10, Vec::Constant(10, 0.1), 0.02,
                       [](Index e, const auto& z) {
                         using std::cos;
                         using std::sin;
                         using T = ScalarOf<decltype(z)>;
                         T sum = T(10.0);
                         for (int j = 0; j < 10; ++j) sum = sum - cos(z[j]);
                         return T(sum + static_cast<double>(e + 1) * (1.0 - cos(z[e])) - sin(z[e]));
                       },
                       {0.8, 0.9, 1.1, 1.2});
}

SuiteInstance brown_almost_linear() {
  return residuals<10>("Brown, almost linear", 10, Vec::Constant(10, 0.5), 0.3,
                       [](Index e, const auto& z) {
                         using T = ScalarOf<decltype(z)>;
                         T sum = T(0.0), product = T(1.0);
                         for (int j = 0; j < 10; ++j) {
                           sum = sum + z[j];
                           product = product * z[j];
                         }
                         return e < 9 ? T(z[e] + sum - 11.0) : T(product - 1.0);
                       },
                       {0.5, 1.5, 2, 1.9});
}

SuiteInstance discrete_boundary_value(int size) {
  const double h = 1.0 / (size + 1);
  Vec x(size + 2);
  for (Index i = 0; i < size + 2; ++i) {
    const double t = static_cast<double>(i) * h;
    x[i] = t * (t - 1);
  }
  ProblemBuilder builder(size + 2);
  builder.add(make_least_squares<3>("boundary value", runs(size, 3),
                                    [h](Index e, const auto& z) {
                                      const auto s = z[1] + (static_cast<double>(e + 1) * h + 1);
                                      return 2.0 * z[1] - z[0] - z[2] + h * h / 2 * s * s * s;
                                    }),
              1);
  builder.add(FixedUnknowns({{0, 0}, {size + 1, 0}}));
  Problem problem = builder.build();
  std::vector<Vec> starts = scaled_starts(problem, x, kFactors, 1);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance broyden_tridiagonal(int size) {
  ProblemBuilder builder(size + 2);
  builder.add(make_least_squares<3>("Broyden, tridiagonal", runs(size, 3),
                                    [](Index, const auto& z) {
                                      return (3.0 - 2.0 * z[1]) * z[1] - z[0] - 2.0 * z[2] + 1.0;
                                    }),
              1);
  builder.add(FixedUnknowns({{0, 0}, {size + 1, 0}}));
  Problem problem = builder.build();
  std::vector<Vec> starts =
      scaled_starts(problem, Vec::Constant(size + 2, -1), {0.5, 2, 3, 5}, 0.5);
  return {std::move(problem), std::move(starts)};
}

// Residual i has the existing unknowns among i - 5 to i + 1.
SuiteInstance broyden_banded(int size) {
  ProblemBuilder builder(size + 6);
  builder.add(make_least_squares<7>("Broyden, banded", runs(size, 7),
                                    [](Index, const auto& z) {
                                      auto sum = z[5] * (2.0 + 5.0 * z[5] * z[5]) + 1.0;
                                      for (int j : {0, 1, 2, 3, 4, 6})
                                        sum = sum - z[j] * (1.0 + z[j]);
                                      return sum;
                                    }),
              1);
  std::vector<FixedUnknown> held{{size + 5, 0}};
  for (Index i = 0; i < 5; ++i) held.push_back({i, 0});
  builder.add(FixedUnknowns(held));
  Problem problem = builder.build();
  std::vector<Vec> starts =
      scaled_starts(problem, Vec::Constant(size + 6, -1), {0.5, 2, 3, 5}, 0.5);
  return {std::move(problem), std::move(starts)};
}

SuiteInstance linear_rank_1() {
  return residuals<10>("linear, rank 1", 20, Vec::Ones(10), 5, [](Index e, const auto& z) {
    using T = ScalarOf<decltype(z)>;
    T sum = T(0.0);
    for (int j = 0; j < 10; ++j) sum = sum + (j + 1.0) * z[j];
    return T(static_cast<double>(e + 1) * sum - 1.0);
  });
}

SuiteInstance chebyquad() {
  constexpr int n = 8;
  Vec x(n);
  for (Index i = 0; i < n; ++i) x[i] = static_cast<double>(i + 1) / (n + 1);
  return residuals<n>("Chebyquad", n, x, 0.05,
                      [](Index e, const auto& z) {
                        using T = ScalarOf<decltype(z)>;
                        T sum = T(0.0);
                        for (int j = 0; j < n; ++j) {
                          const T s = 2.0 * z[j] - 1.0;
                          T before = T(1.0), at = s;  // Chebyshev polynomials of degree k and k + 1
                          for (Index k = 0; k < e; ++k) {
                            const T next = 2.0 * s * at - before;
                            before = at;
                            at = next;
                          }
                          sum = sum + at;
                        }
                        const double i = static_cast<double>(e + 1);
                        const double integral = (e + 1) % 2 == 0 ? -1 / (i * i - 1) : 0.0;
                        return T(sum / static_cast<double>(n) - integral);
                      },
                      {0.9, 0.95, 1.02, 1.05});
}

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
