#include "majorant/results/volume_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "majorant/results/volume_report.h"
#include "majorant/volumes/side_lattice.h"

namespace majorant {
namespace {

constexpr int kEdgeSegments = 6;  // segments of a curved edge

using EdgeUses = std::map<std::pair<Index, Index>, int>;

std::pair<Index, Index> edge_of(Index a, Index b) { return std::minmax(a, b); }

// How many triangles of the lattice have each edge: one, on the border of the side.
EdgeUses edge_uses(const SideLattice& side) {
  EdgeUses uses;
  for (const auto& triangle : side.triangles.rowwise())
    for (Index k = 0; k < 3; ++k) ++uses[edge_of(triangle[k], triangle[(k + 1) % 3])];
  return uses;
}

class CutAway {
 public:
  CutAway(const VolumeMesh& mesh, const VolumeCheck& check) : mesh_(mesh), check_(check) {
    legend();
  }

  SpacePicture make(int marked) {
    const std::vector<const CheckedCell*> worst = check_.worst(to_size(marked));
    add_sides(cut_place());
    for (const CheckedCell* cell : worst) mark(*cell);
    return std::move(picture_);
  }

 private:
  void legend() {
    const std::string faults = faults_in_words(mesh_, check_);
    if (mesh_.is_planar()) picture_.eye = Vector3::UnitZ();
    picture_.title =
        fmt::format("{}{}", elements_in_words(mesh_), faults.empty() ? "" : "; " + faults);
    picture_.legend = "scaled Jacobian";
    for (int k = 0; k < ColorScale::kColors; ++k)
      picture_.colors.push_back(color_at(static_cast<double>(k) / (ColorScale::kColors - 1)));
    picture_.ticks = {{0, "0"}, {0.5, "0.5"}, {1, "1"}};
  }

  // From dark red at 0 to pale grey at 1.
  Color color_at(double scaled_jacobian) const {
    return scale_.color_at(1 - std::clamp(scaled_jacobian, 0.0, 1.0));
  }
  Color color_of(const CheckedCell& cell) const {
    return cell.range.positive == ProofStatus::Violated ? kFlippedColor
                                                        : color_at(cell.scaled_jacobian);
  }

  const CellBlock& block_of(CellName name) const { return mesh_.blocks[to_size(name.block)]; }

  Vector3 middle_of(CellName name) const {
    const CellBlock& block = block_of(name);
    const int corners = corner_count(block.type.shape);
    Vector3 sum = Vector3::Zero();
    for (int k = 0; k < corners; ++k)
      sum += mesh_.points.row(block.nodes(name.cell, k)).transpose();
    return sum / corners;
  }

  std::vector<SideLattice> sides_of(CellName name) const {
    const CellBlock& block = block_of(name);
    std::vector<double> nodes;
    for (const Index node : block.nodes.row(name.cell))
      for (int d = 0; d < 3; ++d) nodes.push_back(mesh_.points(node, d));
    return side_lattices(block.type, nodes.data(), block.type.degree == 1 ? 1 : kEdgeSegments);
  }

  // Elements whose middle has a larger x are cut away: those before the worst one.
  double cut_place() const {
    if (dimension(block_of(check_.cells.front().name).type.shape) == 2)
      return std::numeric_limits<double>::infinity();
    return middle_of(check_.worst(1).front()->name).x();
  }

  // The sides that only one of the elements has that stay.
  void add_sides(double cut) {
    std::map<std::vector<Index>, std::pair<SideLattice, Color>> seen;
    for (const CheckedCell& cell : check_.cells) {
      if (middle_of(cell.name).x() > cut) continue;
      for (SideLattice& side : sides_of(cell.name)) {
        std::vector<Index> key;
        for (const int corner : side.corners)
          key.push_back(block_of(cell.name).vertex(cell.name.cell, corner));
        std::sort(key.begin(), key.end());
        if (seen.erase(key) == 0)
          seen.emplace(std::move(key), std::pair(std::move(side), color_of(cell)));
      }
    }
    for (const auto& [key, side] : seen) add_side(side.first, side.second);
  }

  void add_side(const SideLattice& side, Color color) {
    const EdgeUses uses = edge_uses(side);
    for (const auto& triangle : side.triangles.rowwise()) {
      SpaceTriangle& out = picture_.triangles.emplace_back();
      out.color = color;
      for (Index k = 0; k < 3; ++k) {
        out.corners[to_size(k)] = side.points.row(triangle[k]).transpose();
        out.has_edge[to_size(k)] = uses.at(edge_of(triangle[k], triangle[(k + 1) % 3])) == 1;
      }
    }
  }

  void mark(const CheckedCell& cell) {
    SpaceMark& out = picture_.marks.emplace_back();
    out.text = name_of(mesh_, cell.name);
    out.at = place_of(mesh_, cell);
    for (const SideLattice& side : sides_of(cell.name))
      for (const auto& [edge, count] : edge_uses(side))
        if (count == 1)
          out.lines.push_back(
              {side.points.row(edge.first).transpose(), side.points.row(edge.second).transpose()});
  }

  const VolumeMesh& mesh_;
  const VolumeCheck& check_;
  const ColorScale scale_ = color_scale(Quantity::Angle, {});
  SpacePicture picture_;
};

}  // namespace

SpacePicture picture_of_elements(const VolumeMesh& mesh, const VolumeCheck& check, int marked) {
  return CutAway(mesh, check).make(marked);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
