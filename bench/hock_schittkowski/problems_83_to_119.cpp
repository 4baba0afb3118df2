// [HS81] problems 83 to 119.
#include <array>
#include <cmath>
#include <span>

#include "model.h"

namespace majorant::hock_schittkowski {
namespace {

Instance problem_83() {
  return Model(Vec{{78, 33, 27, 27, 27}})
      .energy([](const Unknowns& x) {
        return 5.3578547 * x[2] * x[2] + 0.8356891 * x[0] * x[4] + 37.293239 * x[0] - 40792.141;
      })
      .above_zero([](const Unknowns& x) {
        const auto a =
            85.334407 + 0.0056858 * x[1] * x[4] + 0.0006262 * x[0] * x[3] - 0.0022053 * x[2] * x[4];
        const auto b =
            -9.48751 + 0.0071317 * x[1] * x[4] + 0.0029955 * x[0] * x[1] + 0.0021813 * x[2] * x[2];
        const auto c = -10.699039 + 0.0047026 * x[2] * x[4] + 0.0012547 * x[0] * x[2] +
                       0.0019085 * x[2] * x[3];
        return Values{a, 92.0 - a, b, 20.0 - b, c, 5.0 - c};
      })
      .within(Vec{{78, 33, 27, 27, 27}}, Vec{{102, 45, 45, 45, 45}})
      .build();
}

Instance problem_84() {
  return Model(Vec{{2.52, 2, 37.5, 9.25, 6.8}})
      .energy([](const Unknowns& x) {
        return 24345.0 + x[0] * (8720288.849 - 150512.5253 * x[1] + 156.6950325 * x[2] -
                                 476470.3222 * x[3] - 729482.8271 * x[4]);
      })
      .above_zero([](const Unknowns& x) {
        const auto a = x[0] * (-145421.402 + 2931.1506 * x[1] - 40.427932 * x[2] + 5106.192 * x[3] +
                               15711.36 * x[4]);
        const auto b = x[0] * (-155011.1084 + 4360.53352 * x[1] + 12.9492344 * x[2] +
                               10236.884 * x[3] + 13176.786 * x[4]);
        const auto c = x[0] * (-326669.5104 + 7390.68412 * x[1] - 27.8986976 * x[2] +
                               16643.076 * x[3] + 30988.146 * x[4]);
        return Values{a, 294000.0 - a, b, 294000.0 - b, c, 277200.0 - c};
      })
      .within(Vec{{0, 1.2, 20, 9, 6.5}}, Vec{{1000, 2.4, 60, 9.3, 7}})
      .build();
}

// The data of problems 86 and 117.
constexpr double kA[10][5] = {{-16, 2, 0, 1, 0},    {0, -2, 0, 4, 2},     {-3.5, 0, 2, 0, 0},
                              {0, -2, 0, -4, -1},   {0, -9, -2, 1, -2.8}, {2, 0, -4, 0, 0},
                              {-1, -1, -1, -1, -1}, {-1, -2, -3, -2, -1}, {1, 2, 3, 4, 5},
                              {1, 1, 1, 1, 1}};
constexpr double kB[10] = {-40, -2, -0.25, -4, -4, -1, -40, -60, 5, 1};
constexpr double kC[5][5] = {{30, -20, -10, 32, -10},
                             {-20, 39, -6, -31, 32},
                             {-10, -6, 10, -6, -10},
                             {32, -31, -6, 39, -20},
                             {-10, 32, -10, -20, 30}};
constexpr double kD[5] = {4, 8, 10, 6, 2};
constexpr double kE[5] = {-15, -27, -36, -18, -12};

Instance problem_86() {
  return Model(Vec{{0, 0, 0, 0, 1}})
      .energy([](const Unknowns& x) {
        Number sum = 0.0;
        for (int j = 0; j < 5; ++j) {
          sum += kE[j] * x[j] + kD[j] * cube(x[j]);
          for (int i = 0; i < 5; ++i) sum += kC[i][j] * x[i] * x[j];
        }
        return sum;
      })
      .above_zero([](const Unknowns& x) {
        Values g(10);
        for (std::size_t i = 0; i < 10; ++i) {
          g[i] = -kB[i];
          for (int j = 0; j < 5; ++j) g[i] += kA[i][j] * x[j];
        }
        return g;
      })
      .within(0, kNone)
      .build();
}

Instance problem_93() {
  return Model(Vec{{5.54, 4.4, 12.02, 11.82, 0.702, 0.852}})
      .energy([](const Unknowns& x) {
        const auto a = x[0] * x[3] * (x[0] + x[1] + x[2]);
        const auto b = x[1] * x[2] * (x[0] + 1.57 * x[1] + x[3]);
        return a * (0.0204 + 0.0607 * x[4] * x[4]) + b * (0.0187 + 0.0437 * x[5] * x[5]);
      })
      .above_zero([](const Unknowns& x) {
        const auto a = x[0] * x[3] * (x[0] + x[1] + x[2]);
        const auto b = x[1] * x[2] * (x[0] + 1.57 * x[1] + x[3]);
        return Values{0.001 * x[0] * x[1] * x[2] * x[3] * x[4] * x[5] - 2.07,
                      1.0 - 0.00062 * a * x[4] * x[4] - 0.00058 * b * x[5] * x[5]};
      })
      .within(0, kNone)
      .build();
}

Instance problem_95_to_98(double b1, double b2, double b3, double b4) {
  return Model(Vec::Zero(6))
      .energy([](const Unknowns& x) {
        return 4.3 * x[0] + 31.8 * x[1] + 63.3 * x[2] + 15.8 * x[3] + 68.5 * x[4] + 4.7 * x[5];
      })
      .above_zero([=](const Unknowns& x) {
        return Values{17.1 * x[0] + 38.2 * x[1] + 204.2 * x[2] + 212.3 * x[3] + 623.4 * x[4] +
                          1495.5 * x[5] - 169.0 * x[0] * x[2] - 3580.0 * x[2] * x[4] -
                          3810.0 * x[3] * x[4] - 18500.0 * x[3] * x[5] - 24300.0 * x[4] * x[5] - b1,
                      17.9 * x[0] + 36.8 * x[1] + 113.9 * x[2] + 169.7 * x[3] + 337.8 * x[4] +
                          1385.2 * x[5] - 139.0 * x[0] * x[2] - 2450.0 * x[3] * x[4] -
                          16600.0 * x[3] * x[5] - 17200.0 * x[4] * x[5] - b2,
                      -273.0 * x[1] - 70.0 * x[3] - 819.0 * x[4] + 26000.0 * x[3] * x[4] - b3,
                      159.9 * x[0] - 311.0 * x[1] + 587.0 * x[3] + 391.0 * x[4] + 2198.0 * x[5] -
                          14000.0 * x[0] * x[5] - b4};
      })
      .within(Vec::Zero(6), Vec{{0.31, 0.046, 0.068, 0.042, 0.028, 0.0134}})
      .build();
}
Instance problem_95() { return problem_95_to_98(4.97, -1.88, -29.08, -78.02); }
Instance problem_96() { return problem_95_to_98(4.97, -1.88, -69.08, -118.02); }
Instance problem_97() { return problem_95_to_98(32.97, 25.12, -29.08, -78.02); }
Instance problem_98() { return problem_95_to_98(32.97, 25.12, -124.08, -173.02); }

// The path of a rocket: accelerations and times of its stages.
Instance problem_99() {
  static constexpr double a[] = {0, 50, 50, 75, 75, 75, 100, 100};
  static constexpr double t[] = {0, 25, 50, 100, 150, 200, 290, 380};
  return Model(Vec::Constant(7, 0.5))
      .energy([](const Unknowns& x) {
        Number r = 0.0;
        for (int i = 1; i < 8; ++i) r += a[i] * (t[i] - t[i - 1]) * cos(x[i - 1]);
        return -r * r;
      })
      .zero([](const Unknowns& x) {
        Number q = 0.0, s = 0.0;
        for (int i = 1; i < 8; ++i) {
          const double dt = t[i] - t[i - 1];
          const auto up = a[i] * sin(x[i - 1]) - 32.0;
          q += 0.5 * dt * dt * up + dt * s;
          s += dt * up;
        }
        return Values{q - 1e5, s - 1e3};
      })
      .within(0, 1.58)
      .build();
}

Instance problem_100() {
  return Model(Vec{{1, 2, 0, 4, 0, 1, 1}})
      .energy([](const Unknowns& x) {
        return square(x[0] - 10.0) + 5.0 * square(x[1] - 12.0) + power(x[2], 4) +
               3.0 * square(x[3] - 11.0) + 10.0 * power(x[4], 6) + 7.0 * x[5] * x[5] +
               power(x[6], 4) - 4.0 * x[5] * x[6] - 10.0 * x[5] - 8.0 * x[6];
      })
      .above_zero([](const Unknowns& x) {
        return Values{127.0 - 2.0 * square(x[0]) - 3.0 * power(x[1], 4) - x[2] -
                          4.0 * square(x[3]) - 5.0 * x[4],
                      282.0 - 7.0 * x[0] - 3.0 * x[1] - 10.0 * square(x[2]) - x[3] + x[4],
                      196.0 - 23.0 * x[0] - square(x[1]) - 6.0 * square(x[5]) + 8.0 * x[6],
                      -4.0 * square(x[0]) - square(x[1]) + 3.0 * x[0] * x[1] - 2.0 * square(x[2]) -
                          5.0 * x[5] + 11.0 * x[6]};
      })
      .build();
}

// A posynomial of seven unknowns.
struct Monomial {
  double coefficient;
  std::array<double, 7> exponents;
};
Number sum_of(const Unknowns& x, std::span<const Monomial> monomials) {
  Number sum = 0.0;
  for (const Monomial& m : monomials) {
    Number logarithm = 0.0;
    for (int i = 0; i < 7; ++i)
      if (m.exponents[to_size(i)] != 0) logarithm += m.exponents[to_size(i)] * log(x[i]);
    sum += m.coefficient * exp(logarithm);
  }
  return sum;
}
constexpr double kThird = 1.0 / 3;
constexpr std::array<Monomial, 3> kFirst = {{{0.5, {0.5, 0, -1, 0, 0, -2, 1}},
                                             {0.7, {3, 1, -2, 0, 0, 1, 0.5}},
                                             {0.2, {0, -1, 1, -0.5, 0, 2 * kThird, 0.25}}}};
constexpr std::array<Monomial, 3> kSecond = {{{1.3, {-0.5, 1, -1, 0, -1, 1, 0}},
                                              {0.8, {0, 0, 1, -1, -1, 2, 0}},
                                              {3.1, {-1, 0.5, 0, -2, -1, kThird, 0}}}};
constexpr std::array<Monomial, 4> kLast = {{{2, {1, 0, -1.5, 0, 1, -1, kThird}},
                                            {0.1, {0, 1, -0.5, 0, 1, -1, -0.5}},
                                            {1, {-1, 1, 0.5, 0, 1, 0, 0}},
                                            {0.65, {0, -2, 1, 0, 1, -1, 1}}}};
constexpr std::array<Monomial, 4> kFourth = {{{0.2, {-2, 1, 0, -1, 0.5, 0, kThird}},
                                              {0.3, {0.5, 2, 1, kThird, -2 * kThird, 0, 0.25}},
                                              {0.4, {-3, -2, 1, 0, 1, 0, 0.75}},
                                              {0.5, {0, 0, -2, 1, 0, 0, 0.5}}}};

Instance problem_101_to_103(double a) {
  const std::array<Monomial, 4> f = {{{10, {1, -1, 0, 2, 0, -3, a}},
                                      {15, {-1, -2, 1, 1, -1, 0, -0.5}},
                                      {20, {-2, 1, 0, -1, -2, 1, 0}},
                                      {25, {2, 2, -1, 0, 0.5, -2, 1}}}};
  return Model(Vec::Constant(7, 6))
      .energy([f](const Unknowns& x) { return sum_of(x, f); })
      .above_zero([f](const Unknowns& x) {
        const auto energy = sum_of(x, f);
        return Values{1.0 - sum_of(x, kFirst),  1.0 - sum_of(x, kSecond), 1.0 - sum_of(x, kLast),
                      1.0 - sum_of(x, kFourth), energy - 100.0,           3000.0 - energy};
      })
      .within(Vec{{0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.01}}, Vec::Constant(7, 10))
      .build();
}
Instance problem_101() { return problem_101_to_103(-0.25); }
Instance problem_102() { return problem_101_to_103(0.125); }
Instance problem_103() { return problem_101_to_103(0.5); }

Number reactors(const Unknowns& x) {
  return 0.4 * pow(x[0] / x[6], 0.67) + 0.4 * pow(x[1] / x[7], 0.67) + 10.0 - x[0] - x[1];
}

Instance problem_104() {
  return Model(Vec{{6, 3, 0.4, 0.2, 6, 6, 1, 0.5}})
      .energy([](const Unknowns& x) { return reactors(x); })
      .above_zero([](const Unknowns& x) {
        const auto f = reactors(x);
        return Values{
            1.0 - 0.0588 * x[4] * x[6] - 0.1 * x[0],
            1.0 - 0.0588 * x[5] * x[7] - 0.1 * x[0] - 0.1 * x[1],
            1.0 - (4.0 * x[2] + 2.0 * pow(x[2], -0.71)) / x[4] - 0.0588 * pow(x[2], -1.3) * x[6],
            1.0 - (4.0 * x[3] + 2.0 * pow(x[3], -0.71)) / x[5] - 0.0588 * pow(x[3], -1.3) * x[7],
            f - 1.0,
            4.2 - f};
      })
      .within(0.1, 10)
      .build();
}

Instance problem_106() {
  return Model(Vec{{5000, 5000, 5000, 200, 350, 150, 225, 425}})
      .energy([](const Unknowns& x) { return x[0] + x[1] + x[2]; })
      .above_zero([](const Unknowns& x) {
        return Values{1.0 - 0.0025 * (x[3] + x[5]),
                      1.0 - 0.0025 * (x[4] + x[6] - x[3]),
                      1.0 - 0.01 * (x[7] - x[4]),
                      x[0] * x[5] - 833.33252 * x[3] - 100.0 * x[0] + 83333.333,
                      x[1] * x[6] - 1250.0 * x[4] - x[1] * x[3] + 1250.0 * x[3],
                      x[2] * x[7] - 1250000.0 - x[2] * x[4] + 2500.0 * x[4]};
      })
      .within(Vec{{100, 1000, 1000, 10, 10, 10, 10, 10}},
              Vec{{10000, 10000, 10000, 1000, 1000, 1000, 1000, 1000}})
      .build();
}

Instance problem_107() {
  return Model(Vec{{0.8, 0.8, 0.2, 0.2, 1.0454, 1.0454, 1.0454, 0, 0}})
      .energy([](const Unknowns& x) {
        return 3000.0 * x[0] + 1000.0 * cube(x[0]) + 2000.0 * x[1] + 666.667 * cube(x[1]);
      })
      .zero([](const Unknowns& x) {
        const double c = 48.4 / 50.176 * std::sin(0.25), d = 48.4 / 50.176 * std::cos(0.25);
        const auto s1 = sin(x[7]), c1 = cos(x[7]), s2 = sin(x[8]), c2 = cos(x[8]);
        const auto s3 = sin(x[7] - x[8]), c3 = cos(x[7] - x[8]);
        const auto a = x[4] * x[5], b = x[4] * x[6], e = x[5] * x[6];
        return Values{
            0.4 - x[0] + 2 * c * x[4] * x[4] - a * (d * s1 + c * c1) - b * (d * s2 + c * c2),
            0.4 - x[1] + 2 * c * x[5] * x[5] + a * (d * s1 - c * c1) + e * (d * s3 - c * c3),
            0.8 + 2 * c * x[6] * x[6] + b * (d * s2 - c * c2) - e * (d * s3 + c * c3),
            0.2 - x[2] + 2 * d * x[4] * x[4] + a * (c * s1 - d * c1) + b * (c * s2 - d * c2),
            0.2 - x[3] + 2 * d * x[5] * x[5] - a * (c * s1 + d * c1) + e * (c * s3 - d * c3),
            -0.337 + 2 * d * x[6] * x[6] - b * (c * s2 + d * c2) + e * (c * s3 - d * c3)};
      })
      .within(Vec{{0, 0, -kNone, -kNone, 0.90909, 0.90909, 0.90909, -kNone, -kNone}},
              Vec{{kNone, kNone, kNone, kNone, 1.0909, 1.0909, 1.0909, kNone, kNone}})
      .build();
}

Instance problem_108() {
  Vec lower = Vec::Constant(9, -kNone);
  lower[8] = 0;
  return Model(Vec::Ones(9))
      .energy([](const Unknowns& x) {
        return -0.5 *
               (x[0] * x[3] - x[1] * x[2] + x[2] * x[8] - x[4] * x[8] + x[4] * x[7] - x[5] * x[6]);
      })
      .above_zero([](const Unknowns& x) {
        return Values{1.0 - square(x[2]) - square(x[3]),
                      1.0 - square(x[4]) - square(x[5]),
                      1.0 - square(x[8]),
                      1.0 - square(x[0]) - square(x[1] - x[8]),
                      1.0 - square(x[0] - x[4]) - square(x[1] - x[5]),
                      1.0 - square(x[0] - x[6]) - square(x[1] - x[7]),
                      1.0 - square(x[2] - x[4]) - square(x[3] - x[5]),
                      1.0 - square(x[2] - x[6]) - square(x[3] - x[7]),
                      1.0 - square(x[6]) - square(x[7] - x[8]),
                      x[0] * x[3] - x[1] * x[2],
                      x[2] * x[8],
                      -x[4] * x[8],
                      x[4] * x[7] - x[5] * x[6]};
      })
      .within(lower, Vec::Constant(9, kNone))
      .build();
}

Instance problem_109() {
  return Model(Vec::Zero(9))
      .energy([](const Unknowns& x) {
        return 3.0 * x[0] + 1e-6 * cube(x[0]) + 2.0 * x[1] + 0.522074e-6 * cube(x[1]);
      })
      .zero([](const Unknowns& x) {
        const double a = 50.176, b = std::sin(0.25), c = std::cos(0.25), d = 0.7533e-3 * a;
        const auto p = x[4] * x[5], q = x[4] * x[6], r = x[5] * x[6];
        return Values{
            p * sin(-x[2] - 0.25) + q * sin(-x[3] - 0.25) + 2 * b * square(x[4]) - a * x[0] +
                400 * a,
            p * sin(x[2] - 0.25) + r * sin(x[2] - x[3] - 0.25) + 2 * b * square(x[5]) - a * x[1] +
                400 * a,
            q * sin(x[3] - 0.25) + r * sin(x[3] - x[2] - 0.25) + 2 * b * square(x[6]) + 881.779 * a,
            a * x[7] + p * cos(-x[2] - 0.25) + q * cos(-x[3] - 0.25) - 200 * a +
                (d - 2 * c) * square(x[4]),
            a * x[8] + p * cos(x[2] - 0.25) + r * cos(x[2] - x[3] - 0.25) - 200 * a +
                (d - 2 * c) * square(x[5]),
            q * cos(x[3] - 0.25) + r * cos(x[3] - x[2] - 0.25) + 22.938 * a +
                (d - 2 * c) * square(x[6])};
      })
      .above_zero([](const Unknowns& x) {
        return Values{x[3] - x[2] + 0.55, x[2] - x[3] + 0.55,
                      2250000.0 - square(x[0]) - square(x[7]),
                      2250000.0 - square(x[1]) - square(x[8])};
      })
      .within(Vec{{0, 0, -0.55, -0.55, 196, 196, 196, -400, -400}},
              Vec{{kNone, kNone, 0.55, 0.55, 252, 252, 252, 800, 800}})
      .build();
}

// Chemical equilibrium, in logarithms and in amounts.
constexpr double kPotentials[] = {-6.089,  -17.164, -34.054, -5.914,  -24.721,
                                  -14.986, -24.1,   -10.708, -26.662, -22.179};

Instance problem_111() {
  return Model(Vec::Constant(10, -2.3))
      .energy([](const Unknowns& x) {
        Number total = 0.0, sum = 0.0;
        for (int j = 0; j < 10; ++j) total += exp(x[j]);
        const auto logarithm = log(total);
        for (int j = 0; j < 10; ++j) sum += exp(x[j]) * (kPotentials[j] + x[j] - logarithm);
        return sum;
      })
      .zero([](const Unknowns& x) {
        Values e(10);
        for (std::size_t j = 0; j < 10; ++j) e[j] = exp(x[static_cast<Index>(j)]);
        return Values{e[0] + 2.0 * e[1] + 2.0 * e[2] + e[5] + e[9] - 2.0,
                      e[3] + 2.0 * e[4] + e[5] + e[6] - 1.0,
                      e[2] + e[6] + e[7] + 2.0 * e[8] + e[9] - 1.0};
      })
      .within(-100, 100)
      .build();
}

Instance problem_112() {
  return Model(Vec::Constant(10, 0.1))
      .energy([](const Unknowns& x) {
        Number total;
        for (int j = 0; j < 10; ++j) total += x[j];
        const Number logarithm = log(total);
        Number sum = 0.0;
        for (int j = 0; j < 10; ++j) sum += x[j] * (kPotentials[j] + log(x[j]) - logarithm);
        return sum;
      })
      .linear(Vec{{1, 2, 2, 0, 0, 1, 0, 0, 0, 1}}, 2)
      .linear(Vec{{0, 0, 0, 1, 2, 1, 1, 0, 0, 0}}, 1)
      .linear(Vec{{0, 0, 1, 0, 0, 0, 1, 1, 2, 1}}, 1)
      .within(1e-6, kNone)
      .build();
}

Instance problem_113() {
  return Model(Vec{{2, 3, 5, 5, 1, 2, 7, 3, 6, 10}})
      .energy([](const Unknowns& x) {
        return square(x[0]) + square(x[1]) + x[0] * x[1] - 14.0 * x[0] - 16.0 * x[1] +
               square(x[2] - 10.0) + 4.0 * square(x[3] - 5.0) + square(x[4] - 3.0) +
               2.0 * square(x[5] - 1.0) + 5.0 * square(x[6]) + 7.0 * square(x[7] - 11.0) +
               2.0 * square(x[8] - 10.0) + square(x[9] - 7.0) + 45.0;
      })
      .above_zero([](const Unknowns& x) {
        return Values{
            105.0 - 4.0 * x[0] - 5.0 * x[1] + 3.0 * x[6] - 9.0 * x[7],
            -10.0 * x[0] + 8.0 * x[1] + 17.0 * x[6] - 2.0 * x[7],
            8.0 * x[0] - 2.0 * x[1] - 5.0 * x[8] + 2.0 * x[9] + 12.0,
            120.0 - 3.0 * square(x[0] - 2.0) - 4.0 * square(x[1] - 3.0) - 2.0 * square(x[2]) +
                7.0 * x[3],
            40.0 - 5.0 * square(x[0]) - 8.0 * x[1] - square(x[2] - 6.0) + 2.0 * x[3],
            30.0 - 0.5 * square(x[0] - 8.0) - 2.0 * square(x[1] - 4.0) - 3.0 * square(x[4]) + x[5],
            -square(x[0]) - 2.0 * square(x[1] - 2.0) + 2.0 * x[0] * x[1] - 14.0 * x[4] + 6.0 * x[5],
            3.0 * x[0] - 6.0 * x[1] - 12.0 * square(x[8] - 8.0) + 7.0 * x[9]};
      })
      .build();
}

Instance problem_114() {
  return Model(Vec{{1745, 12000, 110, 3048, 1974, 89.2, 92.8, 8, 3.6, 145}})
      .energy([](const Unknowns& x) {
        return 5.04 * x[0] + 0.035 * x[1] + 10.0 * x[2] + 3.36 * x[4] - 0.063 * x[3] * x[6];
      })
      .linear(Vec{{-1, 0, 0, 1.22, -1, 0, 0, 0, 0, 0}}, 0)
      .zero([](const Unknowns& x) {
        return Values{98000.0 * x[2] / (x[3] * x[8] + 1000.0 * x[2]) - x[5],
                      (x[1] + x[4]) / x[0] - x[7]};
      })
      .above_zero([](const Unknowns& x) {
        constexpr double a = 0.99, b = 0.9;
        const auto g1 = 35.82 - 0.222 * x[9] - b * x[8];
        const auto g2 = -133.0 + 3.0 * x[6] - a * x[9];
        const auto g5 =
            1.12 * x[0] + 0.13167 * x[0] * x[7] - 0.00667 * x[0] * square(x[7]) - a * x[3];
        const auto g6 = 57.425 + 1.098 * x[7] - 0.038 * square(x[7]) + 0.325 * x[5] - a * x[6];
        return Values{g1,
                      g2,
                      g5,
                      g6,
                      (1 / b - b) * x[8] - g1,
                      (1 / a - a) * x[9] - g2,
                      (1 / a - a) * x[3] - g5,
                      (1 / a - a) * x[6] - g6};
      })
      .within(Vec{{1e-5, 1e-5, 1e-5, 1e-5, 1e-5, 85, 90, 3, 1.2, 145}},
              Vec{{2000, 16000, 120, 5000, 2000, 93, 95, 12, 4, 162}})
      .build();
}

Instance problem_116() {
  return Model(Vec{{0.5, 0.8, 0.9, 0.1, 0.14, 0.5, 489, 80, 650, 450, 150, 150, 150}})
      .energy([](const Unknowns& x) { return x[10] + x[11] + x[12]; })
      .above_zero([](const Unknowns& x) {
        constexpr double a = 0.002, b = 1.262626, c = 1.231059, d = 0.03475, e = 0.975, f = 0.00975;
        const auto sum = x[10] + x[11] + x[12];
        return Values{
            x[2] - x[1],
            x[1] - x[0],
            1.0 - a * x[6] + a * x[7],
            sum - 50.0,
            250.0 - sum,
            x[12] - b * x[9] + c * x[2] * x[9],
            x[4] - d * x[1] - e * x[1] * x[4] + f * x[1] * x[1],
            x[5] - d * x[2] - e * x[2] * x[5] + f * x[2] * x[2],
            x[3] - d * x[0] - e * x[0] * x[3] + f * x[0] * x[0],
            x[11] - b * x[8] + c * x[1] * x[8],
            x[10] - b * x[7] + c * x[0] * x[7],
            x[4] * x[6] - x[0] * x[7] - x[3] * x[6] + x[3] * x[7],
            1.0 - a * (x[1] * x[8] + x[4] * x[7] - x[0] * x[7] - x[5] * x[8]) - x[4] - x[5],
            x[1] * x[8] - x[2] * x[9] - x[5] * x[8] - 500.0 * x[1] + 500.0 * x[5] + x[1] * x[9],
            x[1] - 0.9 - a * (x[1] * x[9] - x[2] * x[9])};
      })
      .within(Vec{{0.1, 0.1, 0.1, 1e-4, 0.1, 0.1, 0.1, 0.1, 500, 0.1, 1, 1e-4, 1e-4}},
              Vec{{1, 1, 1, 0.1, 0.9, 0.9, 1000, 1000, 1000, 500, 150, 150, 150}})
      .build();
}

Instance problem_117() {
  Vec start = Vec::Constant(15, 0.001);
  start[6] = 60;
  return Model(start)
      .energy([](const Unknowns& x) {
        Number sum = 0.0;
        for (int j = 0; j < 10; ++j) sum -= kB[j] * x[j];
        for (int j = 0; j < 5; ++j) {
          sum += 2 * kD[j] * cube(x[10 + j]);
          for (int k = 0; k < 5; ++k) sum += kC[k][j] * x[10 + k] * x[10 + j];
        }
        return sum;
      })
      .above_zero([](const Unknowns& x) {
        Values g(5);
        for (int j = 0; j < 5; ++j) {
          Number& value = g[to_size(j)];
          value = kE[j] + 3 * kD[j] * square(x[10 + j]);
          for (int k = 0; k < 5; ++k) value += 2 * kC[k][j] * x[10 + k];
          for (int k = 0; k < 10; ++k) value -= kA[k][j] * x[k];
        }
        return g;
      })
      .within(0, kNone)
      .build();
}

Instance problem_118() {
  return Model(Vec{{20, 55, 15, 20, 60, 20, 20, 60, 20, 20, 60, 20, 20, 60, 20}})
      .energy([](const Unknowns& x) {
        Number sum = 0.0;
        for (int k = 0; k < 15; k += 3)
          sum += 2.3 * x[k] + 1e-4 * square(x[k]) + 1.7 * x[k + 1] + 1e-4 * square(x[k + 1]) +
                 2.2 * x[k + 2] + 1.5e-4 * square(x[k + 2]);
        return sum;
      })
      .above_zero([](const Unknowns& x) {
        Values g(29);
        constexpr double widths[] = {13, 14, 13}, sums[] = {60, 50, 70, 85, 100};
        std::size_t row = 0;
        for (int i = 3; i < 15; ++i) {
          const auto rise = x[i] - x[i - 3] + 7.0;
          g[row++] = rise;
          g[row++] = widths[i % 3] - rise;
        }
        for (int k = 0; k < 5; ++k) g[row++] = x[3 * k] + x[3 * k + 1] + x[3 * k + 2] - sums[k];
        return g;
      })
      .within(Vec{{8, 43, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}},
              Vec{{21, 57, 16, 90, 120, 60, 90, 120, 60, 90, 120, 60, 90, 120, 60}})
      .build();
}

Instance problem_119() {
  static constexpr int kPairs[][2] = {
      {0, 0},   {0, 3},   {0, 6},   {0, 7},   {0, 15},  {1, 1},   {1, 2},   {1, 6},
      {1, 9},   {2, 2},   {2, 6},   {2, 8},   {2, 9},   {2, 13},  {3, 3},   {3, 6},
      {3, 10},  {3, 14},  {4, 4},   {4, 5},   {4, 9},   {4, 11},  {4, 15},  {5, 5},
      {5, 7},   {5, 14},  {6, 6},   {6, 10},  {6, 12},  {7, 7},   {7, 9},   {7, 14},
      {8, 8},   {8, 11},  {8, 15},  {9, 9},   {9, 13},  {10, 10}, {10, 12}, {11, 11},
      {11, 13}, {12, 12}, {12, 13}, {13, 13}, {14, 14}, {15, 15}};
  const RowMatrix b{{0.22, 0.2, 0.19, 0.25, 0.15, 0.11, 0.12, 0.13},
                    {-1.46, 0, -1.3, 1.82, -1.15, 0, 0.8, 0},
                    {1.29, -0.89, 0, 0, -1.16, -0.96, 0, -0.49},
                    {-1.1, -1.06, 0.95, -0.54, 0, -1.78, -0.41, 0},
                    {0, 0, 0, -1.43, 1.51, 0.59, -0.33, -0.43},
                    {0, -1.72, -0.33, 0, 1.62, 1.24, 0.21, -0.26},
                    {1.12, 0, 0, 0.31, 0, 0, 1.12, 0},
                    {0, 0.45, 0.26, -1.1, 0.58, 0, -1.03, 0.1}};
  constexpr double c[] = {2.5, 1.1, -3.1, -3.5, 1.3, 2.1, 2.3, -1.5};
  Model model(Vec::Constant(16, 10));
  model.energy([](const Unknowns& x) {
    Number sum = 0.0;
    for (const auto& [i, j] : kPairs)
      sum += (x[i] * x[i] + x[i] + 1.0) * (x[j] * x[j] + x[j] + 1.0);
    return sum;
  });
  for (int i = 0; i < 8; ++i) {
    Vec row = Vec::Zero(16);
    row.head(8) = b.row(i);
    row[8 + i] = 1;
    if (i == 6) row[8] = -0.36;
    model.linear(row, c[i]);
  }
  return model.within(0, 5).build();
}

}  // namespace

std::vector<CollectionProblem> problems_83_to_119() {
  return {{83, -30665.53867, problem_83},
          {84, -5280335.133, problem_84},
          {86, -32.34867897, problem_86},
          {93, 135.075961, problem_93},
          {95, 0.015619514, problem_95},
          {96, 0.015619514, problem_96},
          {97, 3.1358091, problem_97, {4.07124636}},
          {98, 3.1358091, problem_98},
          {99, -831079892, problem_99},
          {100, 680.6300573, problem_100},
          {101, 1809.76476, problem_101},
          {102, 911.880571, problem_102},
          {103, 543.667958, problem_103},
          {104, 3.9511634396, problem_104},
          {106, 7049.24802, problem_106},
          {107, 5055.011803, problem_107},
          {108, -std::sqrt(3.0) / 2, problem_108},
          {109, 5362.06928, problem_109, {5326.85133}},
          {111, -47.76109026, problem_111},
          {112, -47.76109026, problem_112},
          {113, 24.3062091, problem_113},
          {114, -1768.80696, problem_114},
          {116, 97.58751, problem_116},  // published: 97.588409, 9e-6 above
          {117, 32.348679, problem_117},
          {118, 664.82045, problem_118},
          {119, 244.899698, problem_119}};
}

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
