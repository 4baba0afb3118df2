#include "majorant/framework/constraint.h"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"

namespace majorant {

FixedPoints::FixedPoints(const std::vector<FixedPoint>& points) : dim_(2) {
  for (const FixedPoint& p : points)
    points_.push_back({p.node, {p.position.x(), p.position.y(), 0}});
}

FixedPoints FixedPoints::in_space(std::vector<FixedPoint3> points) {
  return {std::move(points), 3};
}

FixedPoints FixedPoints::at(const std::vector<Index>& nodes, VecIn x, int dim) {
  if (dim != 2 && dim != 3)
    throw InvalidArgument(
        fmt::format("FixedPoints::at: {} numbers per node, 2 or 3 are possible", dim));
  std::vector<FixedPoint3> points;
  for (const Index node : nodes) {
    require_index("FixedPoints::at: node", node, x.size() / dim);
    points.push_back({node, Vector3::Zero()});
    points.back().position.head(dim) = x.segment(dim * node, dim);
  }
  return {std::move(points), dim};
}

void FixedPoints::append_rows(ConstraintRows& rows) const {
  const std::string_view names = dim_ == 2 ? "uv" : "xyz";
  if (dim_ == 2)
    rows.expect_nodes(2, "FixedPoints of the plane",
                      "FixedPoints::in_space() holds points of space");
  else
    rows.expect_nodes(3, "FixedPoints of space", "FixedPoints() holds points of the plane");
  for (const FixedPoint3& p : points_) {
    require_at_least("FixedPoints: a node", p.node, 0);
    for (int c = 0; c < dim_; ++c) {
      rows.begin_row(fmt::format("{} of node {}", names[static_cast<std::size_t>(c)], p.node));
      rows.add(dim_ * p.node + c, 1);
      rows.end_row(p.position[c]);
    }
  }
}

void FixedUnknowns::append_rows(ConstraintRows& rows) const {
  for (const FixedUnknown& u : unknowns_) {
    require_at_least("FixedUnknowns: an unknown", u.unknown, 0);
    rows.begin_row("unknown " + std::to_string(u.unknown));
    rows.add(u.unknown, 1);
    rows.end_row(u.value);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
