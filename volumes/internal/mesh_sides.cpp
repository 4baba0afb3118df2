#include "majorant/volumes/internal/mesh_sides.h"

#include <algorithm>
#include <limits>

#include "majorant/volumes/internal/reference_cell.h"

namespace majorant {
namespace {

// The largest difference between translations of nodes, relative to coordinates, that counts as the
// rounding of a file: MFEM writes eight digits.
constexpr double kSameTranslation = 1e-7;
// The least distance through a cell, relative to a translation: rows of some 1e5 cells.
constexpr double kAside = 1e-6;

}  // namespace

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

SideSense sense_of(const VolumeMesh& mesh, const CellSide& a, const CellSide& b) {
  const auto loop_of = [&](const CellSide& of) {
    const CellBlock& block = mesh.blocks[to_size(of.name.block)];
    std::vector<Index> loop;
    for (const int corner : ReferenceCell::of(block.type).sides()[to_size(of.side)].loop)
      loop.push_back(block.vertex(of.name.cell, corner));
    return loop;
  };
  const std::vector<Index> x = loop_of(a);
  std::vector<Index> y = loop_of(b);
  const auto is_rotated = [&] {
    for (std::size_t k = 0; k < y.size(); ++k) {
      if (x == y) return true;
      std::rotate(y.begin(), y.begin() + 1, y.end());
    }
    return false;
  };
  // An edge is its own rotation, so the order of its two corners is compared.
  if (x.size() == 2) return x == y ? SideSense::Together : SideSense::Apart;
  if (is_rotated()) return SideSense::Together;
  std::reverse(y.begin(), y.end());
  return is_rotated() ? SideSense::Apart : SideSense::Twisted;
}

bool are_translated(const VolumeMesh& mesh, const CellSide& a, const CellSide& b) {
  const CellBlock &of_a = mesh.blocks[to_size(a.name.block)],
                  &of_b = mesh.blocks[to_size(b.name.block)];
  // Cells that share their nodes cannot be translated.
  if (of_a.vertices.rows() == 0 || of_b.vertices.rows() == 0) return false;
  const std::vector<SideNode> x = nodes_of(mesh, a), y = nodes_of(mesh, b);
  if (x.size() != y.size()) return false;
  const auto point = [&](const SideNode& node) {
    return Vector3(mesh.points.row(node.second).transpose());
  };
  const Vector3 translation = point(y[0]) - point(x[0]);
  double size = 0;  // of the coordinates; their digits in the file limit the comparison
  for (std::size_t k = 0; k < x.size(); ++k)
    size = std::max({size, point(x[k]).cwiseAbs().maxCoeff(), point(y[k]).cwiseAbs().maxCoeff()});
  for (std::size_t k = 0; k < x.size(); ++k)
    if (x[k].first != y[k].first ||
        !((point(y[k]) - point(x[k]) - translation).norm() <= kSameTranslation * size))
      return false;
  // Cell a lies before its side, cell b behind its own: the way from a's side to b's leads through
  // both, or through one cell that is its own neighbour. A cell that lies elsewhere fails this
  // test: the way meets it earlier, or on its way out of a.
  const auto middle = [&](const CellBlock& block, const CellSide& side) {
    Vector3 sum = Vector3::Zero();
    for (const Index node : block.nodes.row(side.name.cell))
      sum += mesh.points.row(node).transpose();
    return Vector3(sum / static_cast<double>(block.nodes.cols()));
  };
  Vector3 side = Vector3::Zero();
  for (const SideNode& node : x) side += point(node) / static_cast<double>(x.size());
  const double whole = translation.squaredNorm(), margin = kAside * whole;
  const double to_a = translation.dot(middle(of_a, a) - side),
               to_b = translation.dot(middle(of_b, b) - side);
  const bool is_one = a.name.block == b.name.block && a.name.cell == b.name.cell;
  return to_a > margin && to_b < whole - margin && (is_one || to_a < to_b);
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
