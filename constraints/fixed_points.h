// Hard point constraints: control points held at given positions by elimination.
//
//   builder.add(FixedPoints({{12, {0.1, 0.2}}}));            // a pin
//   builder.add(FixedPoints::at({12, 13, 14}, x));           // points held where x has them
#pragma once

#include <vector>

#include "majorant/framework/constraint.h"

namespace majorant {

struct FixedPoint {
  Index node;
  Vector2 position;
};

class FixedPoints final : public Constraint {
 public:
  explicit FixedPoints(std::vector<FixedPoint> points) : points_(std::move(points)) {}
  // Holds `nodes` where x (2 numbers per node) has them.
  static FixedPoints at(const std::vector<Index>& nodes, VecIn x);

  void append_rows(ConstraintRows& rows) const override;

 private:
  std::vector<FixedPoint> points_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
