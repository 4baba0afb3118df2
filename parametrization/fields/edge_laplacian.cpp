#include "majorant/parametrization/fields/edge_laplacian.h"

#include <algorithm>

#include "majorant/framework/pattern_of_pairs.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {
namespace {

// Returns the unknowns at both ends of half-edge h, -1 for a vertex without one.
std::array<Index, 2> ends(const Cells& faces, const std::vector<Index>& row_of, Index h) {
  return {row_of[from_vertex(faces, h)], row_of[to_vertex(faces, h)]};
}

}  // namespace

EdgeLaplacian::EdgeLaplacian(const Cells& faces, const std::vector<Index>& row_of) {
  const Index size = row_of.empty() ? 0 : *std::max_element(row_of.begin(), row_of.end()) + 1;
  const Index half_edges = static_cast<Index>(3 * faces.rows());
  pattern_ = pattern_of_pairs(size, 1, [&](const auto& add) {
    for (Index h = 0; h < half_edges; ++h)
      if (const auto [a, b] = ends(faces, row_of, h); a >= 0 && b >= 0) add(a, b);
  });
  for (Index h = 0; h < half_edges; ++h) {
    const auto [a, b] = ends(faces, row_of, h);
    Slots slots{-1, -1, -1};
    if (a != b) {  // else x_a - x_b = 0
      if (a >= 0) slots.from = pattern_.diagonal_slot(a);
      if (b >= 0) slots.to = pattern_.diagonal_slot(b);
      if (a >= 0 && b >= 0) slots.between = pattern_.slot(a, b);
    }
    slots_.push_back(slots);
  }
}

Vec EdgeLaplacian::values(const Vec& weights) const {
  Vec values = Vec::Zero(pattern_.nonzeros());
  for (std::size_t h = 0; h < slots_.size(); ++h) {
    const double w = weights[static_cast<Index>(h)];
    if (slots_[h].from >= 0) values[slots_[h].from] += w;
    if (slots_[h].to >= 0) values[slots_[h].to] += w;
    if (slots_[h].between >= 0) values[slots_[h].between] -= w;
  }
  return values;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
