#include "majorant/volumes/internal/control_net.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/union_find.h"
#include "majorant/volumes/internal/reference_cell.h"

namespace majorant {
namespace {

class NumberedSpace final : public BernsteinSpace {
 public:
  NumberedSpace(const BernsteinElement& element, NodeNumbering numbering)
      : BernsteinSpace(element, std::move(numbering)) {}
};

void require_usable(const VolumeMesh& mesh, int dim) {
  if (dim < 3 && !mesh.is_planar())
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: a surface in space; meshes of volumes and of the plane are "
                            "optimized",
                            mesh.file));
  for (const CellBlock& block : mesh.blocks)
    if (dimension(block.type.shape) == dim && block.type.set != NodeSet::Full)
      throw Error(
          ErrorKind::Unsupported,
          fmt::format("{}: {} {}, the first of them element {}, are checked, not optimized; "
                      "save the mesh with complete elements (gmsh: "
                      "Mesh.SecondOrderIncomplete = 0)",
                      mesh.file, block.size(), describe(block.type), block.numbers.front()));
}

}  // namespace

ControlNet::ControlNet(const VolumeMesh& mesh, const std::vector<CellSide>& sides)
    : mesh_(mesh), dim_(mesh.dimension()) {
  require_usable(mesh, dim_);
  const auto rows = static_cast<Index>(mesh.points.rows());
  UnionFind same(rows);
  for_each_side(sides, [&](std::span<const CellSide> cells) {
    const std::vector<SideNode> first = nodes_of(mesh, cells.front());
    for (const CellSide& other : cells.subspan(1)) {
      if (are_translated(mesh, cells.front(), other)) continue;
      const std::vector<SideNode> second = nodes_of(mesh, other);
      for (std::size_t k = 0; k < first.size(); ++k) same.join(first[k].second, second[k].second);
    }
  });
  point_of_.assign(to_size(rows), -1);
  std::vector<char> is_used(to_size(rows), 0);
  for (const CellBlock& block : mesh.blocks)
    if (dimension(block.type.shape) == dim_)
      for (Index k = 0; k < block.nodes.size(); ++k) is_used[to_size(block.nodes.data()[k])] = 1;
  for (Index row = 0; row < rows; ++row) {
    if (is_used[to_size(row)] == 0) continue;
    const Index name = same.find(row);
    if (point_of_[name] < 0) point_of_[name] = count_++;
    point_of_[row] = point_of_[name];
  }
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& block = mesh.blocks[b];
    if (dimension(block.type.shape) != dim_) continue;
    NodeNumbering numbering;
    numbering.cells = block.nodes.unaryExpr([&](Index row) { return point_of_[row]; });
    numbering.node_count = count_;
    parts_.push_back({static_cast<Index>(b),
                      std::make_shared<const NumberedSpace>(ReferenceCell::of(block.type).element(),
                                                            std::move(numbering))});
    // Weights that should be 0 have the rounding of the inverse.
    constexpr double kZero = 1e-13;
    RowMatrix values = ReferenceCell::of(block.type).control_points().inverse();
    values = values.unaryExpr([](double w) { return std::abs(w) < kZero ? 0 : w; });
    values_.push_back(std::move(values));
  }
  place_of_.resize(to_size(count_));
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Cells& cells = parts_[p].space->cells();
    for (Index e = 0; e < cells.rows(); ++e)
      for (Index k = 0; k < cells.cols(); ++k) place_of_[to_size(cells(e, k))] = {p, e, k};
  }
}

std::vector<std::pair<Index, double>> ControlNet::weights_of_node(Index point) const {
  const Place& place = place_of_[to_size(point)];
  const RowMatrix& values = values_[place.part];
  const Cells& cells = parts_[place.part].space->cells();
  std::vector<std::pair<Index, double>> out;
  for (Index k = 0; k < cells.cols(); ++k)
    if (values(place.node, k) != 0) out.emplace_back(cells(place.cell, k), values(place.node, k));
  return out;
}

Vec ControlNet::control_points() const {
  Vec x = Vec::Zero(dim_ * count_);
  RowMatrix nodes;
  for (const Part& part : parts_) {
    const CellBlock& block = mesh_.blocks[to_size(part.block)];
    const RowMatrix& matrix = ReferenceCell::of(block.type).control_points();
    const Cells& cells = part.space->cells();
    nodes.resize(cells.cols(), dim_);
    for (Index e = 0; e < block.size(); ++e) {
      for (Index k = 0; k < cells.cols(); ++k)
        nodes.row(k) = mesh_.points.row(block.nodes(e, k)).head(dim_);
      const RowMatrix control = matrix * nodes;
      for (Index k = 0; k < cells.cols(); ++k)
        x.segment(dim_ * cells(e, k), dim_) = control.row(k).transpose();
    }
  }
  return x;
}

RowMatrix ControlNet::node_places(VecIn x) const {
  RowMatrix out = RowMatrix::Zero(count_, dim_);
  for (Index point = 0; point < count_; ++point)
    for (const auto& [of, weight] : weights_of_node(point))
      out.row(point) += weight * x.segment(dim_ * of, dim_).transpose();
  return out;
}

Vec ControlNet::control_change(const RowMatrix& node_change) const {
  Vec out = Vec::Zero(dim_ * count_);
  RowMatrix nodes;
  for (const Part& part : parts_) {
    const RowMatrix& matrix =
        ReferenceCell::of(mesh_.blocks[to_size(part.block)].type).control_points();
    const Cells& cells = part.space->cells();
    nodes.resize(cells.cols(), dim_);
    for (Index e = 0; e < cells.rows(); ++e) {
      for (Index k = 0; k < cells.cols(); ++k) nodes.row(k) = node_change.row(cells(e, k));
      if (nodes.isZero(0)) continue;
      const RowMatrix control = matrix * nodes;
      for (Index k = 0; k < cells.cols(); ++k)
        out.segment(dim_ * cells(e, k), dim_) = control.row(k).transpose();
    }
  }
  return out;
}

Points3 ControlNet::nodes(VecIn start, VecIn x, const std::vector<char>& held) const {
  RowMatrix moved(count_, dim_);
  std::vector<char> is_kept(held.begin(), held.end());
  for (Index point = 0; point < count_; ++point) {
    const std::vector<std::pair<Index, double>> weights = weights_of_node(point);
    for (int d = 0; d < dim_; ++d) {
      double sum = 0;
      bool is_same = true;
      for (const auto& [of, weight] : weights) {
        sum += weight * x[dim_ * of + d];
        is_same = is_same && x[dim_ * of + d] == start[dim_ * of + d];
      }
      moved(point, d) = sum;
      if (is_same) is_kept[to_size(dim_ * point + d)] = 1;
    }
  }
  Points3 out = mesh_.points;
  for (Index row = 0; row < out.rows(); ++row) {
    const Index point = point_of_[row];
    if (point < 0) continue;
    for (int d = 0; d < dim_; ++d)
      if (is_kept[to_size(dim_ * point + d)] == 0) out(row, d) = moved(point, d);
  }
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
