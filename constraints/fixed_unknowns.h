// Hard constraints on single unknowns, whatever they are: coordinates of nodes of any dimension.
//
//   const std::vector<FixedUnknown> held{{3 * 12 + 2, 0.5}};                     // z of node 12
//   builder.add(FixedUnknowns(held));
//   builder.add(std::make_shared<QuadraticPenalty>(FixedUnknowns(held)), 1e3);   // the same, soft
//
// For points of the plane or of space fixed_points.h is shorter.
#pragma once

#include <vector>

#include "majorant/framework/constraint.h"

namespace majorant {

struct FixedUnknown {
  Index unknown;  // of the full unknowns x
  double value;
};

class FixedUnknowns final : public Constraint {
 public:
  explicit FixedUnknowns(std::vector<FixedUnknown> unknowns) : unknowns_(std::move(unknowns)) {}
  void append_rows(ConstraintRows& rows) const override;

 private:
  std::vector<FixedUnknown> unknowns_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
