#include "majorant/volumes/node_orders.h"

#include "majorant/volumes/internal/reference_cell.h"

namespace majorant {
namespace {

std::vector<int> factors_of(CellShape shape) {
  switch (shape) {
    case CellShape::Point:
      return {};
    case CellShape::Segment:
      return {2};
    default:
      return bernstein_element(shape, 1).factors;
  }
}

}  // namespace

std::vector<Exponents> vtk_order(CellShape shape, int degree) {
  if (shape == CellShape::Point) return {Exponents{}};
  if (shape != CellShape::Segment) {
    const BernsteinElement element = bernstein_element(shape, degree);
    return element.functions(element.degrees());
  }
  std::vector<Exponents> out{{degree, 0}, {0, degree}};
  for (int s = 1; s < degree; ++s) out.push_back({degree - s, s});
  return out;
}

std::vector<std::array<int, 8>> corner_weights(CellShape shape, int degree) {
  const std::vector<Exponents> nodes = vtk_order(shape, degree);
  const std::vector<int> factors = factors_of(shape);
  std::vector<std::array<int, 8>> out;
  for (const Exponents& node : nodes) {
    auto& weights = out.emplace_back();
    weights.fill(0);
    for (int k = 0; k < corner_count(shape); ++k) {
      int product = 1;
      std::size_t c = 0;
      for (const int corners : factors)
        for (int i = 0; i < corners; ++i, ++c)
          if (nodes[to_size(k)][c] != 0) product *= node[c];
      weights[to_size(k)] = product;
    }
  }
  return out;
}

const std::vector<int>& reflected_nodes(const CellType& type) {
  return ReferenceCell::of(type).reflection();
}

Points3 control_points_of(const CellType& type, Points3 nodes) {
  nodes = ReferenceCell::of(type).control_points() * nodes;
  return nodes;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
