#include "majorant/volumes/turned_cells.h"

#include <Eigen/LU>
#include <algorithm>
#include <span>
#include <utility>

#include "majorant/volumes/determinant_range.h"
#include "majorant/volumes/internal/mesh_sides.h"
#include "majorant/volumes/internal/reference_cell.h"
#include "majorant/volumes/mesh_source.h"

namespace majorant {
namespace {

class CellOrientation {
 public:
  explicit CellOrientation(const VolumeMesh& mesh) : mesh_(mesh), dim_(mesh.dimension()) {
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      first_.push_back(names_.size());
      if (dimension(mesh.blocks[b].type.shape) != dim_) continue;
      for (Index c = 0; c < mesh.blocks[b].size(); ++c)
        names_.push_back({static_cast<Index>(b), c});
    }
  }

  std::vector<CellName> turned(const StopCheck& stop) {
    join_neighbours();
    stop.poll();
    signs_.assign(names_.size(), 0);
    std::vector<CellName> out;
    for (std::size_t seed = 0; seed < names_.size(); ++seed) {
      if (signs_[seed] != 0) continue;
      const std::vector<std::size_t> piece = piece_of(seed);
      if (piece.empty()) continue;
      double measure = 0;
      for (const std::size_t k : piece) measure += signs_[k] * corner_measure(names_[k]);
      const int turned = measure < 0 ? 1 : -1;
      std::vector<CellName> of_piece;
      bool is_any_positive = false;
      for (const std::size_t k : piece) {
        if (signs_[k] != turned) continue;
        stop.poll();
        of_piece.push_back(names_[k]);
        is_any_positive = is_any_positive || is_positive(names_[k], stop);
        if (is_any_positive) break;
      }
      if (measure != 0 && !is_any_positive) out.insert(out.end(), of_piece.begin(), of_piece.end());
    }
    return out;
  }

 private:
  struct Neighbour {
    std::size_t cell;
    int sign;  // -1: one of the two must be turned
  };

  void join_neighbours() {
    neighbours_.resize(names_.size());
    for_each_side(sides_of(mesh_), [&](std::span<const CellSide> cells) {
      if (cells.size() != 2) return;
      const SideSense sense = sense_of(mesh_, cells[0], cells[1]);
      if (sense == SideSense::Twisted) return;
      const int sign = sense == SideSense::Apart ? 1 : -1;
      const std::size_t a = place(cells[0].name), b = place(cells[1].name);
      neighbours_[a].push_back({b, sign});
      neighbours_[b].push_back({a, sign});
    });
  }

  // Gives the cells of a connected piece signs, equal ones for cells that run around their common
  // side alike. Returns the cells; none if no signs fit.
  std::vector<std::size_t> piece_of(std::size_t seed) {
    std::vector<std::size_t> piece{seed};
    signs_[seed] = 1;
    bool has_signs = true;
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (const Neighbour& next : neighbours_[piece[k]]) {
        const int sign = signs_[piece[k]] * next.sign;
        if (signs_[next.cell] == 0) {
          signs_[next.cell] = sign;
          piece.push_back(next.cell);
        }
        has_signs = has_signs && signs_[next.cell] == sign;
      }
    return has_signs ? piece : std::vector<std::size_t>();
  }

  std::size_t place(CellName name) const {
    return first_[to_size(name.block)] + to_size(name.cell);
  }

  // Returns the mean of det J at the corners of the straight cell.
  double corner_measure(CellName name) const {
    const CellBlock& block = mesh_.blocks[to_size(name.block)];
    const ReferenceCell& straight = ReferenceCell::of({block.type.shape, 1});
    const RowMatrix& gradients = straight.sampled_gradients();
    RowMatrix corners(corner_count(block.type.shape), dim_);
    for (Index k = 0; k < corners.rows(); ++k)
      corners.row(k) = mesh_.points.row(block.nodes(name.cell, k)).head(dim_);
    double sum = 0;
    const auto points = static_cast<Index>(gradients.rows()) / dim_;
    for (Index s = 0; s < points; ++s) {
      const RowMatrix J = gradients.middleRows(dim_ * s, dim_) * corners;
      sum += J.determinant();
    }
    return sum / points;
  }

  bool is_positive(CellName name, const StopCheck& stop) const {
    const CellBlock& block = mesh_.blocks[to_size(name.block)];
    std::vector<double> nodes;
    for (const Index row : block.nodes.row(name.cell))
      for (int d = 0; d < dim_; ++d) nodes.push_back(mesh_.points(row, d));
    return determinant_range(block.type, nodes.data(), stop).positive == ProofStatus::Proven;
  }

  const VolumeMesh& mesh_;
  int dim_;
  std::vector<CellName> names_;
  std::vector<std::size_t> first_;  // by block
  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<int> signs_;
};

}  // namespace

std::vector<CellName> turned_cells(const VolumeMesh& mesh, const StopCheck& stop) {
  const int dim = mesh.dimension();
  if (dim < 2 || (dim == 2 && !mesh.is_planar())) return {};
  for (const CellBlock& block : mesh.blocks)
    if (dimension(block.type.shape) == dim) require_tables(mesh.file, block.type);
  return CellOrientation(mesh).turned(stop);
}

VolumeMesh with_cells_turned(const VolumeMesh& mesh, const std::vector<CellName>& cells,
                             const StopCheck& stop) {
  if (cells.empty()) return mesh;
  VolumeMesh turned = mesh;
  for (const CellName& name : cells) {
    CellBlock& block = turned.blocks[to_size(name.block)];
    const std::vector<int>& reflection = ReferenceCell::of(block.type).reflection();
    const Cells before = block.nodes.row(name.cell);
    for (std::size_t k = 0; k < reflection.size(); ++k)
      block.nodes(name.cell, static_cast<Index>(k)) = before(0, reflection[k]);
    if (block.vertices.rows() == 0) continue;
    const Cells corners = block.vertices.row(name.cell);
    for (Index k = 0; k < block.vertices.cols(); ++k)
      block.vertices(name.cell, k) = corners(0, reflection[to_size(k)]);
  }
  if (!mesh.source) return turned;
  // Reads the file with the new lists; points that it numbers otherwise are matched by place.
  VolumeMesh read = mesh.source->with_turned(mesh.blocks, cells, stop);
  for (std::size_t b = 0; b < read.blocks.size(); ++b)
    for (Index k = 0; k < read.blocks[b].nodes.size(); ++k)
      read.points.row(read.blocks[b].nodes.data()[k]) =
          mesh.points.row(turned.blocks[b].nodes.data()[k]);
  return read;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
