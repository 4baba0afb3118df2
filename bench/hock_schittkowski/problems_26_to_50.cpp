// [HS81] problems 26 to 50.
#include <cmath>
#include <numbers>

#include "model.h"

namespace majorant::hock_schittkowski {
namespace {

using std::numbers::sqrt2;

Instance problem_26() {
  return Model(Vec{{-2.6, 2, 2}})
      .energy([](const Unknowns& x) { return square(x[0] - x[1]) + power(x[1] - x[2], 4); })
      .zero([](const Unknowns& x) {
        return Values{(1.0 + x[1] * x[1]) * x[0] + power(x[2], 4) - 3.0};
      })
      .build();
}

Instance problem_27() {
  return Model(Vec{{2, 2, 2}})
      .energy(
          [](const Unknowns& x) { return 0.01 * square(x[0] - 1.0) + square(x[1] - x[0] * x[0]); })
      .zero([](const Unknowns& x) { return Values{x[0] + x[2] * x[2] + 1.0}; })
      .build();
}

Instance problem_28() {
  return Model(Vec{{-4, 1, 1}})
      .energy([](const Unknowns& x) { return square(x[0] + x[1]) + square(x[1] + x[2]); })
      .linear(Vec{{1, 2, 3}}, 1)
      .build();
}

Instance problem_29() {
  return Model(Vec{{1, 1, 1}})
      .energy([](const Unknowns& x) { return -x[0] * x[1] * x[2]; })
      .above_zero([](const Unknowns& x) {
        return Values{48.0 - x[0] * x[0] - 2.0 * x[1] * x[1] - 4.0 * x[2] * x[2]};
      })
      .build();
}

Instance problem_30() {
  return Model(Vec{{1, 1, 1}})
      .energy([](const Unknowns& x) { return x[0] * x[0] + x[1] * x[1] + x[2] * x[2]; })
      .above_zero([](const Unknowns& x) { return Values{x[0] * x[0] + x[1] * x[1] - 1.0}; })
      .within(Vec{{1, -10, -10}}, Vec{{10, 10, 10}})
      .build();
}

Instance problem_31() {
  return Model(Vec{{1, 1, 1}})
      .energy([](const Unknowns& x) { return 9.0 * x[0] * x[0] + x[1] * x[1] + 9.0 * x[2] * x[2]; })
      .above_zero([](const Unknowns& x) { return Values{x[0] * x[1] - 1.0}; })
      .within(Vec{{-10, 1, -10}}, Vec{{10, 10, 1}})
      .build();
}

Instance problem_32() {
  return Model(Vec{{0.1, 0.7, 0.2}})
      .energy([](const Unknowns& x) {
        return square(x[0] + 3.0 * x[1] + x[2]) + 4.0 * square(x[0] - x[1]);
      })
      .above_zero(
          [](const Unknowns& x) { return Values{6.0 * x[1] + 4.0 * x[2] - cube(x[0]) - 3.0}; })
      .linear(Vec{{1, 1, 1}}, 1)
      .within(0, kNone)
      .build();
}

Instance problem_33() {
  return Model(Vec{{0, 0, 3}})
      .energy([](const Unknowns& x) { return (x[0] - 1.0) * (x[0] - 2.0) * (x[0] - 3.0) + x[2]; })
      .above_zero([](const Unknowns& x) {
        const auto a = x[0] * x[0] + x[1] * x[1], b = x[2] * x[2];
        return Values{b - a, a + b - 4.0};
      })
      .within(Vec{{0, 0, 0}}, Vec{{kNone, kNone, 5}})
      .build();
}

Instance problem_34() {
  return Model(Vec{{0, 1.05, 2.9}})
      .energy([](const Unknowns& x) { return -x[0]; })
      .above_zero([](const Unknowns& x) {
        return Values{x[1] - exp(x[0]), x[2] - exp(x[1])};
      })
      .within(Vec{{0, 0, 0}}, Vec{{100, 100, 10}})
      .build();
}

Instance problem_35() {
  return Model(Vec{{0.5, 0.5, 0.5}})
      .energy([](const Unknowns& x) {
        return 9.0 - 8.0 * x[0] - 6.0 * x[1] - 4.0 * x[2] + 2.0 * x[0] * x[0] + 2.0 * x[1] * x[1] +
               x[2] * x[2] + 2.0 * x[0] * (x[1] + x[2]);
      })
      .above_zero([](const Unknowns& x) { return Values{3.0 - x[0] - x[1] - 2.0 * x[2]}; })
      .within(0, kNone)
      .build();
}

Instance problem_36() {
  return Model(Vec{{10, 10, 10}})
      .energy([](const Unknowns& x) { return -x[0] * x[1] * x[2]; })
      .above_zero([](const Unknowns& x) { return Values{72.0 - x[0] - 2.0 * x[1] - 2.0 * x[2]}; })
      .within(Vec{{0, 0, 0}}, Vec{{20, 11, 42}})
      .build();
}

Instance problem_37() {
  return Model(Vec{{10, 10, 10}})
      .energy([](const Unknowns& x) { return -x[0] * x[1] * x[2]; })
      .above_zero([](const Unknowns& x) {
        const auto sum = x[0] + 2.0 * x[1] + 2.0 * x[2];
        return Values{72.0 - sum, sum};
      })
      .within(0, 42)
      .build();
}

Instance problem_39() {
  return Model(Vec{{2, 2, 2, 2}})
      .energy([](const Unknowns& x) { return -x[0]; })
      .zero([](const Unknowns& x) {
        return Values{x[1] - cube(x[0]) - x[2] * x[2], x[0] * x[0] - x[1] - x[3] * x[3]};
      })
      .build();
}

Instance problem_40() {
  return Model(Vec{{0.8, 0.8, 0.8, 0.8}})
      .energy([](const Unknowns& x) { return -x[0] * x[1] * x[2] * x[3]; })
      .zero([](const Unknowns& x) {
        return Values{cube(x[0]) + x[1] * x[1] - 1.0, x[0] * x[0] * x[3] - x[2],
                      x[3] * x[3] - x[1]};
      })
      .build();
}

Instance problem_41() {
  return Model(Vec{{2, 2, 2, 2}})
      .energy([](const Unknowns& x) { return 2.0 - x[0] * x[1] * x[2]; })
      .linear(Vec{{1, 2, 2, -1}}, 0)
      .within(Vec{{0, 0, 0, 0}}, Vec{{1, 1, 1, 2}})
      .build();
}

Instance problem_42() {
  return Model(Vec{{1, 1, 1, 1}})
      .energy([](const Unknowns& x) {
        return square(x[0] - 1.0) + square(x[1] - 2.0) + square(x[2] - 3.0) + square(x[3] - 4.0);
      })
      .linear(Vec{{1, 0, 0, 0}}, 2)
      .zero([](const Unknowns& x) { return Values{x[2] * x[2] + x[3] * x[3] - 2.0}; })
      .build();
}

Instance problem_43() {
  return Model(Vec{{0, 0, 0, 0}})
      .energy([](const Unknowns& x) {
        return x[0] * x[0] + x[1] * x[1] + 2.0 * x[2] * x[2] + x[3] * x[3] - 5.0 * x[0] -
               5.0 * x[1] - 21.0 * x[2] + 7.0 * x[3];
      })
      .above_zero([](const Unknowns& x) {
        const auto a = square(x[0]), b = square(x[1]), c = square(x[2]), d = square(x[3]);
        return Values{8.0 - a - b - c - d - x[0] + x[1] - x[2] + x[3],
                      10.0 - a - 2.0 * b - c - 2.0 * d + x[0] + x[3],
                      5.0 - 2.0 * a - b - c - 2.0 * x[0] + x[1] + x[3]};
      })
      .build();
}

Instance problem_44() {
  return Model(Vec{{0, 0, 0, 0}})
      .energy([](const Unknowns& x) { return x[0] - x[1] - x[2] - (x[0] - x[1]) * (x[2] - x[3]); })
      .above_zero([](const Unknowns& x) {
        return Values{8.0 - x[0] - 2.0 * x[1],        12.0 - 4.0 * x[0] - x[1],
                      12.0 - 3.0 * x[0] - 4.0 * x[1], 8.0 - 2.0 * x[2] - x[3],
                      8.0 - x[2] - 2.0 * x[3],        5.0 - x[2] - x[3]};
      })
      .within(0, kNone)
      .build();
}

Instance problem_46() {
  return Model(Vec{{sqrt2 / 2, 1.75, 0.5, 2, 2}})
      .energy([](const Unknowns& x) {
        return square(x[0] - x[1]) + square(x[2] - 1.0) + power(x[3] - 1.0, 4) +
               power(x[4] - 1.0, 6);
      })
      .zero([](const Unknowns& x) {
        return Values{x[0] * x[0] * x[3] + sin(x[3] - x[4]) - 1.0,
                      x[1] + power(x[2], 4) * x[3] * x[3] - 2.0};
      })
      .build();
}

Instance problem_47() {
  return Model(Vec{{2, sqrt2, -1, 2 - sqrt2, 0.5}})
      .energy([](const Unknowns& x) {
        return square(x[0] - x[1]) + cube(x[1] - x[2]) + power(x[2] - x[3], 4) +
               power(x[3] - x[4], 4);
      })
      .zero([](const Unknowns& x) {
        return Values{x[0] + x[1] * x[1] + cube(x[2]) - 3.0, x[1] - x[2] * x[2] + x[3] - 1.0,
                      x[0] * x[4] - 1.0};
      })
      .build();
}

Instance problem_48() {
  return Model(Vec{{3, 5, -3, 2, -2}})
      .energy([](const Unknowns& x) {
        return square(x[0] - 1.0) + square(x[1] - x[2]) + square(x[3] - x[4]);
      })
      .linear(Vec{{1, 1, 1, 1, 1}}, 5)
      .linear(Vec{{0, 0, 1, -2, -2}}, -3)
      .build();
}

Instance problem_49() {
  return Model(Vec{{10, 7, 2, -3, 0.8}})
      .energy([](const Unknowns& x) {
        return square(x[0] - x[1]) + square(x[2] - 1.0) + power(x[3] - 1.0, 4) +
               power(x[4] - 1.0, 6);
      })
      .linear(Vec{{1, 1, 1, 4, 0}}, 7)
      .linear(Vec{{0, 0, 1, 0, 5}}, 6)
      .build();
}

Instance problem_50() {
  return Model(Vec{{35, -31, 11, 5, -5}})
      .energy([](const Unknowns& x) {
        return square(x[0] - x[1]) + square(x[1] - x[2]) + power(x[2] - x[3], 4) +
               square(x[3] - x[4]);
      })
      .linear(Vec{{1, 2, 3, 0, 0}}, 6)
      .linear(Vec{{0, 1, 2, 3, 0}}, 6)
      .linear(Vec{{0, 0, 1, 2, 3}}, 6)
      .build();
}

}  // namespace

std::vector<CollectionProblem> problems_26_to_50() {
  return {{26, 0, problem_26},
          {27, 0.04, problem_27},
          {28, 0, problem_28},
          {29, -16 * sqrt2, problem_29},
          {30, 1, problem_30},
          {31, 6, problem_31},
          {32, 1, problem_32},
          {33, sqrt2 - 6, problem_33},
          {34, -std::log(std::log(10.0)), problem_34},
          {35, 1.0 / 9, problem_35},
          {36, -3300, problem_36},
          {37, -3456, problem_37},
          {39, -1, problem_39},
          {40, -0.25, problem_40},
          {41, 52.0 / 27, problem_41},
          {42, 28 - 10 * sqrt2, problem_42},
          {43, -44, problem_43},
          {44, -15, problem_44},
          {46, 0, problem_46},
          {47, 0, problem_47},
          {48, 0, problem_48},
          {49, 0, problem_49},
          {50, 0, problem_50}};
}

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
