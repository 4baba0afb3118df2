// [HS81] problems 51 to 81.
#include <cmath>
#include <numbers>

#include "model.h"

namespace majorant::hock_schittkowski {
namespace {

using std::numbers::sqrt2;

// Returns the energy of problems 51 to 53.
Number sum_of_four_squares(const Unknowns& x, double a) {
  return square(a * x[0] - x[1]) + square(x[1] + x[2] - 2.0) + square(x[3] - 1.0) +
         square(x[4] - 1.0);
}

Instance problem_51() {
  return Model(Vec{{2.5, 0.5, 2, -1, 0.5}})
      .energy([](const Unknowns& x) { return sum_of_four_squares(x, 1); })
      .linear(Vec{{1, 3, 0, 0, 0}}, 4)
      .linear(Vec{{0, 0, 1, 1, -2}}, 0)
      .linear(Vec{{0, 1, 0, 0, -1}}, 0)
      .build();
}

Instance problem_52() {
  return Model(Vec{{2, 2, 2, 2, 2}})
      .energy([](const Unknowns& x) { return sum_of_four_squares(x, 4); })
      .linear(Vec{{1, 3, 0, 0, 0}}, 0)
      .linear(Vec{{0, 0, 1, 1, -2}}, 0)
      .linear(Vec{{0, 1, 0, 0, -1}}, 0)
      .build();
}

Instance problem_53() {
  return Model(Vec{{2, 2, 2, 2, 2}})
      .energy([](const Unknowns& x) { return sum_of_four_squares(x, 1); })
      .linear(Vec{{1, 3, 0, 0, 0}}, 0)
      .linear(Vec{{0, 0, 1, 1, -2}}, 0)
      .linear(Vec{{0, 1, 0, 0, -1}}, 0)
      .within(-10, 10)
      .build();
}

Instance problem_54() {
  return Model(Vec{{6e3, 1.5, 4e6, 2, 3e-3, 5e7}})
      .energy([](const Unknowns& x) {
        const auto a = x[0] - 1e4, b = x[1] - 1.0;
        const auto h = (a * a / 6.4e7 + a * b / 2e4 + b * b) / 0.96 + square(x[2] - 2e6) / 4.9e13 +
                       square(x[3] - 10.0) / 2.5e3 + square(x[4] - 1e-3) / 2.5e-3 +
                       square(x[5] - 1e8) / 2.5e17;
        return -exp(-0.5 * h);
      })
      .linear(Vec{{1, 4e3, 0, 0, 0, 0}}, 1.76e4)
      .within(Vec{{0, -10, 0, 0, -1, 0}}, Vec{{2e4, 10, 1e7, 20, 1, 2e8}})
      .build();
}

Instance problem_55() {
  return Model(Vec{{1, 2, 0, 0, 0, 2}})
      .energy([](const Unknowns& x) { return x[0] + 2.0 * x[1] + 4.0 * x[4] + exp(x[0] * x[3]); })
      .linear(Vec{{1, 2, 0, 0, 5, 0}}, 6)
      .linear(Vec{{1, 1, 1, 0, 0, 0}}, 3)
      .linear(Vec{{0, 0, 0, 1, 1, 1}}, 2)
      .linear(Vec{{1, 0, 0, 1, 0, 0}}, 1)
      .linear(Vec{{0, 1, 0, 0, 1, 0}}, 2)
      .linear(Vec{{0, 0, 1, 0, 0, 1}}, 2)
      .within(Vec::Zero(6), Vec{{1, kNone, kNone, 1, kNone, kNone}})
      .build();
}

Instance problem_56() {
  const double a = std::asin(std::sqrt(1 / 4.2)), b = std::asin(std::sqrt(5 / 7.2));
  return Model(Vec{{1, 1, 1, a, a, a, b}})
      .energy([](const Unknowns& x) { return -x[0] * x[1] * x[2]; })
      .zero([](const Unknowns& x) {
        return Values{x[0] - 4.2 * square(sin(x[3])), x[1] - 4.2 * square(sin(x[4])),
                      x[2] - 4.2 * square(sin(x[5])),
                      x[0] + 2.0 * x[1] + 2.0 * x[2] - 7.2 * square(sin(x[6]))};
      })
      .build();
}

Instance problem_57() {
  return Model(Vec{{0.42, 5}})
      .energy([](const Unknowns& x) {
        static constexpr double a[] = {8,  8,  10, 10, 10, 10, 12, 12, 12, 12, 14, 14, 14, 16, 16,
                                       16, 18, 18, 20, 20, 20, 22, 22, 22, 24, 24, 24, 26, 26, 26,
                                       28, 28, 30, 30, 30, 32, 32, 34, 36, 36, 38, 38, 40, 42};
        static constexpr double b[] = {0.49, 0.49, 0.48, 0.47, 0.48, 0.47, 0.46, 0.46, 0.45,
                                       0.43, 0.45, 0.43, 0.43, 0.44, 0.43, 0.43, 0.46, 0.45,
                                       0.42, 0.42, 0.43, 0.41, 0.41, 0.40, 0.42, 0.40, 0.40,
                                       0.41, 0.40, 0.41, 0.41, 0.40, 0.40, 0.40, 0.38, 0.41,
                                       0.40, 0.40, 0.41, 0.38, 0.40, 0.40, 0.39, 0.39};
        Number sum = 0.0;
        for (int i = 0; i < 44; ++i)
          sum += square(b[i] - x[0] - (0.49 - x[0]) * exp(-x[1] * (a[i] - 8)));
        return sum;
      })
      .above_zero([](const Unknowns& x) { return Values{0.49 * x[1] - x[0] * x[1] - 0.09}; })
      .within(Vec{{0.4, -4}}, Vec{{kNone, kNone}})
      .build();
}

Instance problem_59() {
  return Model(Vec{{90, 10}})
      .energy([](const Unknowns& x) {
        const auto a = x[0], b = x[1];
        const auto a2 = a * a, a3 = a2 * a, a4 = a2 * a2, b2 = b * b, b3 = b2 * b, b4 = b2 * b2;
        return -75.196 + 3.8112 * a + 0.0020567 * a3 - 1.0345e-5 * a4 + 6.8306 * b -
               0.030234 * a * b + 1.28134e-3 * b * a2 + 2.266e-7 * a4 * b - 0.25645 * b2 +
               0.0034604 * b3 - 1.3514e-5 * b4 + 28.106 / (b + 1.0) + 5.2375e-6 * a2 * b2 +
               6.3e-8 * a3 * b2 - 7e-10 * a3 * b3 - 3.405e-4 * a * b2 + 1.6638e-6 * a * b3 +
               2.8673 * exp(0.0005 * a * b) - 3.5256e-5 * a3 * b - 0.12694 * a2;
      })
      .above_zero([](const Unknowns& x) {
        return Values{x[0] * x[1] - 700.0, x[1] - x[0] * x[0] / 125.0,
                      square(x[1] - 50.0) - 5.0 * (x[0] - 55.0)};
      })
      .within(Vec{{0, 0}}, Vec{{75, 65}})
      .build();
}

Instance problem_60() {
  return Model(Vec{{2, 2, 2}})
      .energy([](const Unknowns& x) {
        return square(x[0] - 1.0) + square(x[0] - x[1]) + power(x[1] - x[2], 4);
      })
      .zero([](const Unknowns& x) {
        return Values{x[0] * (1.0 + x[1] * x[1]) + power(x[2], 4) - (4 + 3 * sqrt2)};
      })
      .within(-10, 10)
      .build();
}

Instance problem_61() {
  return Model(Vec{{0, 0, 0}})
      .energy([](const Unknowns& x) {
        return 4.0 * x[0] * x[0] + 2.0 * x[1] * x[1] + 2.0 * x[2] * x[2] - 33.0 * x[0] +
               16.0 * x[1] - 24.0 * x[2];
      })
      .zero([](const Unknowns& x) {
        return Values{3.0 * x[0] - 2.0 * x[1] * x[1] - 7.0, 4.0 * x[0] - x[2] * x[2] - 11.0};
      })
      .build();
}

Instance problem_62() {
  return Model(Vec{{0.7, 0.2, 0.1}})
      .energy([](const Unknowns& x) {
        const auto a = x[2] + 0.03, b = x[1] + a, c = x[0] + b;
        return -32.174 * (255.0 * log(c / (b + 0.09 * x[0])) + 280.0 * log(b / (a + 0.07 * x[1])) +
                          290.0 * log(a / (0.13 * x[2] + 0.03)));
      })
      .linear(Vec{{1, 1, 1}}, 1)
      .within(0, 1)
      .build();
}

Instance problem_63() {
  return Model(Vec{{2, 2, 2}})
      .energy([](const Unknowns& x) {
        return 1000.0 - x[0] * x[0] - 2.0 * x[1] * x[1] - x[2] * x[2] - x[0] * (x[1] + x[2]);
      })
      .linear(Vec{{8, 14, 7}}, 56)
      .zero(
          [](const Unknowns& x) { return Values{x[0] * x[0] + x[1] * x[1] + x[2] * x[2] - 25.0}; })
      .within(0, kNone)
      .build();
}

Instance problem_64() {
  return Model(Vec{{1, 1, 1}})
      .energy([](const Unknowns& x) {
        return 5.0 * x[0] + 50000.0 / x[0] + 20.0 * x[1] + 72000.0 / x[1] + 10.0 * x[2] +
               144000.0 / x[2];
      })
      .above_zero(
          [](const Unknowns& x) { return Values{1.0 - 4.0 / x[0] - 32.0 / x[1] - 120.0 / x[2]}; })
      .within(1e-5, kNone)
      .build();
}

Instance problem_65() {
  return Model(Vec{{-5, 5, 0}})
      .energy([](const Unknowns& x) {
        return square(x[0] - x[1]) + square(x[0] + x[1] - 10.0) / 9.0 + square(x[2] - 5.0);
      })
      .above_zero(
          [](const Unknowns& x) { return Values{48.0 - x[0] * x[0] - x[1] * x[1] - x[2] * x[2]}; })
      .within(Vec{{-4.5, -4.5, -5}}, Vec{{4.5, 4.5, 5}})
      .build();
}

Instance problem_66() {
  return Model(Vec{{0, 1.05, 2.9}})
      .energy([](const Unknowns& x) { return 0.2 * x[2] - 0.8 * x[0]; })
      .above_zero([](const Unknowns& x) {
        return Values{x[1] - exp(x[0]), x[2] - exp(x[1])};
      })
      .within(Vec{{0, 0, 0}}, Vec{{100, 100, 10}})
      .build();
}

Instance problem_71() {
  return Model(Vec{{1, 5, 5, 1}})
      .energy([](const Unknowns& x) { return x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]; })
      .zero([](const Unknowns& x) {
        return Values{x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3] - 40.0};
      })
      .above_zero([](const Unknowns& x) { return Values{x[0] * x[1] * x[2] * x[3] - 25.0}; })
      .within(1, 5)
      .build();
}

Instance problem_72() {
  return Model(Vec{{1, 1, 1, 1}})
      .energy([](const Unknowns& x) { return 1.0 + x[0] + x[1] + x[2] + x[3]; })
      .above_zero([](const Unknowns& x) {
        return Values{0.0401 - 4.0 / x[0] - 2.25 / x[1] - 1.0 / x[2] - 0.25 / x[3],
                      0.010085 - 0.16 / x[0] - 0.36 / x[1] - 0.64 / x[2] - 0.64 / x[3]};
      })
      .within(Vec::Constant(4, 0.001), Vec{{4e5, 3e5, 2e5, 1e5}})
      .build();
}

Instance problem_73() {
  return Model(Vec{{1, 1, 1, 1}})
      .energy(
          [](const Unknowns& x) { return 24.55 * x[0] + 26.75 * x[1] + 39.0 * x[2] + 40.5 * x[3]; })
      .above_zero([](const Unknowns& x) {
        return Values{2.3 * x[0] + 5.6 * x[1] + 11.1 * x[2] + 1.3 * x[3] - 5.0,
                      12.0 * x[0] + 11.9 * x[1] + 41.8 * x[2] + 52.1 * x[3] - 21.0 -
                          1.645 * sqrt(0.28 * square(x[0]) + 0.19 * square(x[1]) +
                                       20.5 * square(x[2]) + 0.62 * square(x[3]))};
      })
      .linear(Vec{{1, 1, 1, 1}}, 1)
      .within(0, kNone)
      .build();
}

Instance problem_74_or_75(double a) {
  return Model(Vec{{0, 0, 0, 0}})
      .energy([](const Unknowns& x) {
        return 3.0 * x[0] + 1e-6 * cube(x[0]) + 2.0 * x[1] + 2e-6 / 3 * cube(x[1]);
      })
      .zero([](const Unknowns& x) {
        return Values{1e3 * (sin(-x[2] - 0.25) + sin(-x[3] - 0.25)) + 894.8 - x[0],
                      1e3 * (sin(x[2] - 0.25) + sin(x[2] - x[3] - 0.25)) + 894.8 - x[1],
                      1e3 * (sin(x[3] - 0.25) + sin(x[3] - x[2] - 0.25)) + 1294.8};
      })
      .above_zero([a](const Unknowns& x) {
        return Values{x[3] - x[2] + a, x[2] - x[3] + a};
      })
      .within(Vec{{0, 0, -a, -a}}, Vec{{1200, 1200, a, a}})
      .build();
}
Instance problem_74() { return problem_74_or_75(0.55); }
Instance problem_75() { return problem_74_or_75(0.48); }

Instance problem_76() {
  return Model(Vec{{0.5, 0.5, 0.5, 0.5}})
      .energy([](const Unknowns& x) {
        return x[0] * x[0] + 0.5 * x[1] * x[1] + x[2] * x[2] + 0.5 * x[3] * x[3] - x[0] * x[2] +
               x[2] * x[3] - x[0] - 3.0 * x[1] + x[2] - x[3];
      })
      .above_zero([](const Unknowns& x) {
        return Values{5.0 - x[0] - 2.0 * x[1] - x[2] - x[3],
                      4.0 - 3.0 * x[0] - x[1] - 2.0 * x[2] + x[3], x[1] + 4.0 * x[2] - 1.5};
      })
      .within(0, kNone)
      .build();
}

Instance problem_77() {
  return Model(Vec{{2, 2, 2, 2, 2}})
      .energy([](const Unknowns& x) {
        return square(x[0] - 1.0) + square(x[0] - x[1]) + square(x[2] - 1.0) +
               power(x[3] - 1.0, 4) + power(x[4] - 1.0, 6);
      })
      .zero([](const Unknowns& x) {
        return Values{x[0] * x[0] * x[3] + sin(x[3] - x[4]) - 2 * sqrt2,
                      x[1] + power(x[2], 4) * x[3] * x[3] - (8 + sqrt2)};
      })
      .build();
}

Values three_equalities(const Unknowns& x) {
  return Values{square(x[0]) + square(x[1]) + square(x[2]) + square(x[3]) + square(x[4]) - 10.0,
                x[1] * x[2] - 5.0 * x[3] * x[4], cube(x[0]) + cube(x[1]) + 1.0};
}
const double kLargest[] = {2.3, 2.3, 3.2, 3.2, 3.2};

Instance problem_78() {
  return Model(Vec{{-2, 1.5, 2, -1, -1}})
      .energy([](const Unknowns& x) { return x[0] * x[1] * x[2] * x[3] * x[4]; })
      .zero([](const Unknowns& x) { return three_equalities(x); })
      .build();
}

Instance problem_79() {
  return Model(Vec{{2, 2, 2, 2, 2}})
      .energy([](const Unknowns& x) {
        return square(x[0] - 1.0) + square(x[0] - x[1]) + square(x[1] - x[2]) +
               power(x[2] - x[3], 4) + power(x[3] - x[4], 4);
      })
      .zero([](const Unknowns& x) {
        return Values{x[0] + x[1] * x[1] + cube(x[2]) - (2 + 3 * sqrt2),
                      x[1] - x[2] * x[2] + x[3] + (2 - 2 * sqrt2), x[0] * x[4] - 2.0};
      })
      .build();
}

Instance problem_80() {
  const Vec largest = Eigen::Map<const Vec>(kLargest, 5);
  return Model(Vec{{-2, 2, 2, -1, -1}})
      .energy([](const Unknowns& x) { return exp(x[0] * x[1] * x[2] * x[3] * x[4]); })
      .zero([](const Unknowns& x) { return three_equalities(x); })
      .within(-largest, largest)
      .build();
}

Instance problem_81() {
  const Vec largest = Eigen::Map<const Vec>(kLargest, 5);
  return Model(Vec{{-2, 2, 2, -1, -1}})
      .energy([](const Unknowns& x) {
        return exp(x[0] * x[1] * x[2] * x[3] * x[4]) - 0.5 * square(cube(x[0]) + cube(x[1]) + 1.0);
      })
      .zero([](const Unknowns& x) { return three_equalities(x); })
      .within(-largest, largest)
      .build();
}

}  // namespace

std::vector<CollectionProblem> problems_51_to_81() {
  return {{51, 0, problem_51},
          {52, 1859.0 / 349, problem_52},
          {53, 176.0 / 43, problem_53},
          {54, -std::exp(-27.0 / 280), problem_54},
          {55, 19.0 / 3, problem_55},
          {56, -3.456, problem_56},
          {57, 0.02845966972, problem_57},
          {59, -7.804226324, problem_59, {-6.749505274, -7.80278947}},
          {60, 0.03256820025, problem_60},
          {61, -143.6461422, problem_61},
          {62, -26272.51448, problem_62},
          {63, 961.7151721, problem_63},
          {64, 6299.842428, problem_64},
          {65, 0.9535288567, problem_65},
          {66, 0.5181632741, problem_66},
          {71, 17.0140173, problem_71},
          {72, 727.67937, problem_72},
          {73, 29.894378, problem_73},
          {74, 5126.4981, problem_74},
          {75, 5174.4129, problem_75},
          {76, -103.0 / 22, problem_76},
          {77, 0.24150513, problem_77},
          {78, -2.91970041, problem_78},
          {79, 0.0787768209, problem_79},
          {80, 0.0539498478, problem_80},
          {81, 0.0539498478, problem_81}};
}

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
