// Builds a problem of the collection from its formulas.
//
//   return Model(Vec{{2, 2}})
//       .energy([](const Unknowns& x) { return square(x[0] - 2.0) + square(x[1] - 1.0); })
//       .above_zero([](const Unknowns& x) -> Values {
//         return {2.0 - x[0] - x[1], x[1] - x[0] * x[0]};
//       })
//       .build();
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "collection.h"
#include "number.h"

namespace majorant::hock_schittkowski {

inline constexpr double kNone = std::numeric_limits<double>::infinity();

class Model {
 public:
  explicit Model(const Vec& start);

  Model& energy(std::function<Number(const Unknowns&)> f);
  // Adds equalities: each value is 0.
  Model& zero(std::function<Values(const Unknowns&)> g);
  // Adds inequalities: each value is at least 0.
  Model& above_zero(std::function<Values(const Unknowns&)> g);
  // Adds the equality sum_i coefficients[i] x[i] = right_hand_side.
  Model& linear(const Vec& coefficients, double right_hand_side);
  Model& within(const Vec& lower, const Vec& upper);
  Model& within(double lower, double upper);
  Instance build() const;

 private:
  void hold(const std::shared_ptr<const BarrierChecker>& checker);

  ProblemBuilder builder_;
  Instance made_;
};

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
