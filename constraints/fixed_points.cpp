#include "majorant/constraints/fixed_points.h"

#include <fmt/format.h>

#include "majorant/framework/internal/argument_check.h"

namespace majorant {

FixedPoints FixedPoints::at(const std::vector<Index>& nodes, VecIn x) {
  std::vector<FixedPoint> points;
  for (const Index node : nodes) {
    require_index("FixedPoints::at: node", node, x.size() / 2);
    points.push_back({node, {x[2 * node], x[2 * node + 1]}});
  }
  return FixedPoints(std::move(points));
}

void FixedPoints::append_rows(ConstraintRows& rows) const {
  for (const FixedPoint& p : points_) {
    require_at_least("FixedPoints: a node", p.node, 0);
    for (int c = 0; c < 2; ++c) {
      rows.begin_row(fmt::format("{} of node {}", c == 0 ? 'u' : 'v', p.node));
      rows.add(2 * p.node + c, 1);
      rows.end_row(p.position[c]);
    }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
