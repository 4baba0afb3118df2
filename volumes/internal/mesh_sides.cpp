#include "majorant/volumes/internal/mesh_sides.h"

#include <algorithm>
#include <limits>

#include "majorant/volumes/internal/reference_cell.h"

namespace majorant {

CellSide::Key side_key(std::span<const Index> corners) {
  CellSide::Key key;
  key.fill(std::numeric_limits<Index>::max());
  std::copy(corners.begin(), corners.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<CellSide> sides_of(const VolumeMesh& mesh) {
  std::vector<CellSide> out;
  const int dim = mesh.dimension();
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& block = mesh.blocks[b];
    if (dimension(block.type.shape) != dim) continue;
    const auto& all = ReferenceCell::of(block.type).sides();
    std::vector<Index> corners;
    for (Index cell = 0; cell < block.size(); ++cell)
      for (std::size_t s = 0; s < all.size(); ++s) {
        corners.clear();
        for (const int corner : all[s].corners) corners.push_back(block.vertex(cell, corner));
        out.push_back({side_key(corners), {static_cast<Index>(b), cell}, static_cast<int>(s)});
      }
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const CellSide& a, const CellSide& b) { return a.key < b.key; });
  return out;
}

std::vector<SideNode> nodes_of(const VolumeMesh& mesh, const CellSide& of) {
  const CellBlock& block = mesh.blocks[to_size(of.name.block)];
  const ReferenceCell::Side& side = ReferenceCell::of(block.type).sides()[to_size(of.side)];
  std::vector<SideNode> out;
  for (std::size_t k = 0; k < side.nodes.size(); ++k) {
    std::array<int, 4> weights{};
    for (std::size_t c = 0; c < side.corners.size(); ++c) {
      const Index vertex = block.vertex(of.name.cell, side.corners[c]);
      const auto place = std::find(of.key.begin(), of.key.end(), vertex) - of.key.begin();
      weights[static_cast<std::size_t>(place)] = side.weights[k][c];
    }
    out.emplace_back(weights, block.nodes(of.name.cell, side.nodes[k]));
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
