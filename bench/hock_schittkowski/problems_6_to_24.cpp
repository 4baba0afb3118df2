// [HS81] problems 6 to 24.
#include <cmath>
#include <numbers>

#include "model.h"

namespace majorant::hock_schittkowski {
namespace {

using std::numbers::pi, std::numbers::sqrt3;

Number rosenbrock(const Unknowns& x) {
  return 100.0 * square(x[1] - x[0] * x[0]) + square(1.0 - x[0]);
}

Instance problem_6() {
  return Model(Vec{{-1.2, 1}})
      .energy([](const Unknowns& x) { return square(1.0 - x[0]); })
      .zero([](const Unknowns& x) { return Values{10.0 * (x[1] - x[0] * x[0])}; })
      .build();
}

Instance problem_7() {
  return Model(Vec{{2, 2}})
      .energy([](const Unknowns& x) { return log(1.0 + x[0] * x[0]) - x[1]; })
      .zero([](const Unknowns& x) { return Values{square(1.0 + x[0] * x[0]) + x[1] * x[1] - 4.0}; })
      .build();
}

Instance problem_8() {
  return Model(Vec{{2, 1}})
      .energy([](const Unknowns& x) { return 0.0 * x[0] - 1.0; })
      .zero([](const Unknowns& x) {
        return Values{x[0] * x[0] + x[1] * x[1] - 25.0, x[0] * x[1] - 9.0};
      })
      .build();
}

Instance problem_9() {
  return Model(Vec{{0, 0}})
      .energy([](const Unknowns& x) { return sin(pi / 12 * x[0]) * cos(pi / 16 * x[1]); })
      .linear(Vec{{4, -3}}, 0)
      .build();
}

Instance problem_10() {
  return Model(Vec{{-10, 10}})
      .energy([](const Unknowns& x) { return x[0] - x[1]; })
      .above_zero([](const Unknowns& x) {
        return Values{-3.0 * x[0] * x[0] + 2.0 * x[0] * x[1] - x[1] * x[1] + 1.0};
      })
      .build();
}

Instance problem_11() {
  return Model(Vec{{4.9, 0.1}})
      .energy([](const Unknowns& x) { return square(x[0] - 5.0) + x[1] * x[1] - 25.0; })
      .above_zero([](const Unknowns& x) { return Values{x[1] - x[0] * x[0]}; })
      .build();
}

Instance problem_12() {
  return Model(Vec{{0, 0}})
      .energy([](const Unknowns& x) {
        return 0.5 * x[0] * x[0] + x[1] * x[1] - x[0] * x[1] - 7.0 * x[0] - 7.0 * x[1];
      })
      .above_zero([](const Unknowns& x) { return Values{25.0 - 4.0 * x[0] * x[0] - x[1] * x[1]}; })
      .build();
}

Instance problem_13() {
  return Model(Vec{{-2, -2}})
      .energy([](const Unknowns& x) { return square(x[0] - 2.0) + x[1] * x[1]; })
      .above_zero([](const Unknowns& x) { return Values{cube(1.0 - x[0]) - x[1]}; })
      .within(0, kNone)
      .build();
}

Instance problem_14() {
  return Model(Vec{{2, 2}})
      .energy([](const Unknowns& x) { return square(x[0] - 2.0) + square(x[1] - 1.0); })
      .above_zero([](const Unknowns& x) { return Values{1.0 - 0.25 * x[0] * x[0] - x[1] * x[1]}; })
      .linear(Vec{{1, -2}}, -1)
      .build();
}

Instance problem_15() {
  return Model(Vec{{-2, 1}})
      .energy([](const Unknowns& x) { return rosenbrock(x); })
      .above_zero([](const Unknowns& x) {
        return Values{x[0] * x[1] - 1.0, x[0] + x[1] * x[1]};
      })
      .within(Vec{{-kNone, -kNone}}, Vec{{0.5, kNone}})
      .build();
}

Instance problem_16() {
  return Model(Vec{{-2, 1}})
      .energy([](const Unknowns& x) { return rosenbrock(x); })
      .above_zero([](const Unknowns& x) {
        return Values{x[0] + x[1] * x[1], x[0] * x[0] + x[1]};
      })
      .within(Vec{{-0.5, -kNone}}, Vec{{0.5, 1}})
      .build();
}

Instance problem_17() {
  return Model(Vec{{-2, 1}})
      .energy([](const Unknowns& x) { return rosenbrock(x); })
      .above_zero([](const Unknowns& x) {
        return Values{x[1] * x[1] - x[0], x[0] * x[0] - x[1]};
      })
      .within(Vec{{-0.5, -kNone}}, Vec{{0.5, 1}})
      .build();
}

Instance problem_18() {
  return Model(Vec{{2, 2}})
      .energy([](const Unknowns& x) { return 0.01 * x[0] * x[0] + x[1] * x[1]; })
      .above_zero([](const Unknowns& x) {
        return Values{x[0] * x[1] - 25.0, x[0] * x[0] + x[1] * x[1] - 25.0};
      })
      .within(Vec{{2, 0}}, Vec{{50, 50}})
      .build();
}

Instance problem_19() {
  return Model(Vec{{20.1, 5.84}})
      .energy([](const Unknowns& x) { return cube(x[0] - 10.0) + cube(x[1] - 20.0); })
      .above_zero([](const Unknowns& x) {
        return Values{square(x[0] - 5.0) + square(x[1] - 5.0) - 100.0,
                      82.81 - square(x[0] - 6.0) - square(x[1] - 5.0)};
      })
      .within(Vec{{13, 0}}, Vec{{100, 100}})
      .build();
}

Instance problem_20() {
  return Model(Vec{{-2, 1}})
      .energy([](const Unknowns& x) { return rosenbrock(x); })
      .above_zero([](const Unknowns& x) {
        return Values{x[0] + x[1] * x[1], x[0] * x[0] + x[1], x[0] * x[0] + x[1] * x[1] - 1.0};
      })
      .within(Vec{{-0.5, -kNone}}, Vec{{0.5, kNone}})
      .build();
}

Instance problem_21() {
  return Model(Vec{{-1, -1}})
      .energy([](const Unknowns& x) { return 0.01 * x[0] * x[0] + x[1] * x[1] - 100.0; })
      .above_zero([](const Unknowns& x) { return Values{10.0 * x[0] - x[1] - 10.0}; })
      .within(Vec{{2, -50}}, Vec{{50, 50}})
      .build();
}

Instance problem_22() {
  return Model(Vec{{2, 2}})
      .energy([](const Unknowns& x) { return square(x[0] - 2.0) + square(x[1] - 1.0); })
      .above_zero([](const Unknowns& x) {
        return Values{2.0 - x[0] - x[1], x[1] - x[0] * x[0]};
      })
      .build();
}

Instance problem_23() {
  return Model(Vec{{3, 1}})
      .energy([](const Unknowns& x) { return x[0] * x[0] + x[1] * x[1]; })
      .above_zero([](const Unknowns& x) {
        const auto a = square(x[0]), b = square(x[1]);
        return Values{x[0] + x[1] - 1.0, a + b - 1.0, 9.0 * a + b - 9.0, a - x[1], b - x[0]};
      })
      .within(-50, 50)
      .build();
}

Instance problem_24() {
  return Model(Vec{{1, 0.5}})
      .energy(
          [](const Unknowns& x) { return (square(x[0] - 3.0) - 9.0) * cube(x[1]) / (27 * sqrt3); })
      .above_zero([](const Unknowns& x) {
        return Values{x[0] / sqrt3 - x[1], x[0] + sqrt3 * x[1], 6.0 - x[0] - sqrt3 * x[1]};
      })
      .within(0, kNone)
      .build();
}

}  // namespace

std::vector<CollectionProblem> problems_6_to_24() {
  return {{6, 0, problem_6},
          {7, -sqrt3, problem_7},
          {8, -1, problem_8},
          {9, -0.5, problem_9},
          {10, -1, problem_10},
          {11, -8.498464223, problem_11},
          {12, -30, problem_12},
          {13, 1, problem_13},
          {14, 9 - 2.875 * std::sqrt(7.0), problem_14},
          {15, 306.5, problem_15},
          {16, 0.25, problem_16, {23.14466073}},
          {17, 1, problem_17},
          {18, 5, problem_18},
          {19, -6961.81387558, problem_19},
          {20, 81.5 - 25 * sqrt3, problem_20, {40.19872981}},
          {21, -99.96, problem_21},
          {22, 1, problem_22},
          {23, 2, problem_23},
          {24, -1, problem_24}};
}

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
