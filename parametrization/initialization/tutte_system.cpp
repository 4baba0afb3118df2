#include "majorant/parametrization/initialization/tutte_system.h"

#include <algorithm>
#include <utility>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

MeanOfNeighbours::MeanOfNeighbours(Cells faces, const std::vector<char>& held)
    : faces_(std::move(faces)), row_of_(held.size(), -1) {
  for (std::size_t v = 0; v < held.size(); ++v) {
    if (held[v]) continue;
    row_of_[v] = static_cast<Index>(vertices_.size());
    vertices_.push_back(static_cast<Index>(v));
  }
}

// Gives each edge weight 1: each of its half-edges counts 1/2, in whichever part it lies.
Vec MeanOfNeighbours::values(const EdgeLaplacian& laplacian) const {
  return laplacian.values(Vec::Constant(3 * faces_.rows(), 0.5));
}

Vec MeanOfNeighbours::right_hand_side(const Vec& x, int c) const {
  std::vector<std::pair<Index, Index>> links;  // row, neighbour
  for (Index h = 0; h < 3 * static_cast<Index>(faces_.rows()); ++h) {
    const Index row = row_of_[from_vertex(faces_, h)], neighbour = to_vertex(faces_, h);
    if (row >= 0 && row_of_[neighbour] < 0) links.emplace_back(row, neighbour);
  }
  std::sort(links.begin(), links.end());  // sums do not depend on the order of faces
  Vec rhs = Vec::Zero(static_cast<Index>(vertices_.size()));
  for (const auto& [row, neighbour] : links) rhs[row] += x[2 * neighbour + c];
  return rhs;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
