#include "majorant/apps/jobs/volume_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "majorant/apps/jobs/volume_report.h"
#include "majorant/volumes/side_lattice.h"

namespace majorant {
namespace {

// ---- Elements on a page ----

// Segments of an edge, which suffice for chords of quartic edges to look curved.
constexpr int kSteps = 8;
// The distance of neighbouring elements in the layout, whose edges have length 1.
constexpr double kDistance = 1.25;

bool is_affine(const CellType& type) {
  return type.degree == 1 &&
         (type.shape == CellShape::Tetrahedron || type.shape == CellShape::Triangle);
}

class ElementPage {
 public:
  explicit ElementPage(const VolumeMesh& mesh) : mesh_(mesh) {}

  void add(const CheckedCell& element) {
    const CellBlock& block = mesh_.blocks[to_size(element.name.block)];
    std::vector<double> nodes;
    for (const Index node : block.nodes.row(element.name.cell))
      for (int d = 0; d < 3; ++d) nodes.push_back(mesh_.points(node, d));
    nearest_ = std::numeric_limits<double>::infinity();
    double column = 0;
    for (const SideLattice& side :
         side_lattices(block.type, nodes.data(), is_affine(block.type) ? 1 : kSteps))
      add_side(side, element, Vector2(kDistance * column++, -kDistance * row_));
    if (element.range.positive != ProofStatus::Proven)
      page_.faults.push_back({nearest_face_, element_in_words(mesh_, element)});
    ++row_;
  }

  MapPage take() {
    MapFile& map = page_.map;
    const auto count = static_cast<Index>(points_.size());
    map.points.resize(count, 3);
    map.uv.resize(count, 2);
    for (Index p = 0; p < count; ++p) {
      map.points.row(p) = points_[to_size(p)].transpose();
      map.uv.row(p) = uv_[to_size(p)].transpose();
    }
    const auto faces = static_cast<Index>(cells_.size());
    map.cells.resize(faces, 3);
    map.input_face.resize(faces);
    map.chart.resize(faces);
    for (Index f = 0; f < faces; ++f) {
      for (Index k = 0; k < 3; ++k) map.cells(f, k) = cells_[to_size(f)][to_size(k)];
      map.input_face[f] = numbers_[to_size(f)];
      map.chart[f] = rows_[to_size(f)];
    }
    page_.alignment = Alignment::Never;
    return std::move(page_);
  }

 private:
  void add_side(const SideLattice& side, const CheckedCell& element, const Vector2& corner) {
    const auto first = static_cast<Index>(points_.size());
    for (Index p = 0; p < side.points.rows(); ++p) {
      points_.emplace_back(side.points.row(p).transpose());
      uv_.emplace_back(side.place.row(p).transpose() + corner);
    }
    const CellBlock& block = mesh_.blocks[to_size(element.name.block)];
    for (const auto& triangle : side.triangles.rowwise()) {
      const double distance = distance_to(side, triangle, element.range.at);
      if (distance < nearest_) {
        nearest_ = distance;
        nearest_face_ = static_cast<Index>(cells_.size());
      }
      cells_.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
      numbers_.push_back(static_cast<int>(block.numbers[to_size(element.name.cell)]));
      rows_.push_back(row_);
    }
  }

  // Returns the squared distance from the centre of a triangle in homogeneous coordinates.
  template <class Triangle>
  static double distance_to(const SideLattice& side, const Triangle& triangle,
                            const std::array<double, 6>& at) {
    double sum = 0;
    for (std::size_t c = 0; c < at.size(); ++c) {
      double middle = 0;
      for (Index k = 0; k < 3; ++k) middle += side.at[to_size(triangle[k])][c] / 3;
      sum += (middle - at[c]) * (middle - at[c]);
    }
    return sum;
  }

  const VolumeMesh& mesh_;
  MapPage page_;
  int row_ = 0;
  std::vector<Vector3> points_;
  std::vector<Vector2> uv_;
  std::vector<std::array<Index, 3>> cells_;
  std::vector<int> numbers_, rows_;  // by cell
  // The face of the current element that is nearest to its least det J, and its distance.
  Index nearest_face_ = 0;
  double nearest_ = 0;
};

// ---- The mesh cut open ----

constexpr int kEdgeSegments = 6;  // segments of a curved edge

using EdgeUses = std::map<std::pair<Index, Index>, int>;

std::pair<Index, Index> edge_of(Index a, Index b) { return std::minmax(a, b); }

// Counts the triangles of the lattice at each edge; edges on the border of the side have one.
EdgeUses edge_uses(const SideLattice& side) {
  EdgeUses uses;
  for (const auto& triangle : side.triangles.rowwise())
    for (Index k = 0; k < 3; ++k) ++uses[edge_of(triangle[k], triangle[(k + 1) % 3])];
  return uses;
}

class CutAway {
 public:
  CutAway(const VolumeMesh& mesh, const VolumeCheck& check, const StopCheck& stop)
      : mesh_(mesh), check_(check), stop_(stop) {
    legend();
  }

  SpacePicture make(int marked) {
    const std::vector<const CheckedCell*> worst = check_.worst(to_size(marked));
    add_sides(cut_place());
    for (const CheckedCell* cell : worst) {
      stop_.poll();
      mark(*cell);
    }
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

  // Returns a colour from dark red at 0 to pale grey at 1.
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

  // Returns the largest x of the centres of elements that are shown. Elements in front of the worst
  // one are cut away.
  double cut_place() const {
    if (dimension(block_of(check_.cells.front().name).type.shape) == 2)
      return std::numeric_limits<double>::infinity();
    return middle_of(check_.worst(1).front()->name).x();
  }

  // Adds the sides that belong to one remaining element only. Sides are identified by the places of
  // their corners; sides that are equal up to a translation are different.
  void add_sides(double cut) {
    std::map<std::vector<std::array<double, 3>>, std::pair<SideLattice, Color>> seen;
    for (const CheckedCell& cell : check_.cells) {
      stop_.poll();
      if (middle_of(cell.name).x() > cut) continue;
      for (SideLattice& side : sides_of(cell.name)) {
        std::vector<std::array<double, 3>> key;
        for (const int corner : side.corners) {
          const Index row = block_of(cell.name).nodes(cell.name.cell, corner);
          key.push_back({mesh_.points(row, 0), mesh_.points(row, 1), mesh_.points(row, 2)});
        }
        std::sort(key.begin(), key.end());
        if (seen.erase(key) == 0)
          seen.emplace(std::move(key), std::pair(std::move(side), color_of(cell)));
      }
    }
    for (const auto& [key, side] : seen) {
      stop_.poll();
      add_side(side.first, side.second);
    }
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
  const StopCheck& stop_;
  const ColorScale scale_ = color_scale(Quantity::Angle, {});
  SpacePicture picture_;
};

}  // namespace

MapPage page_of_elements(const VolumeMesh& mesh, const std::vector<const CheckedCell*>& elements) {
  ElementPage page(mesh);
  for (const CheckedCell* element : elements) page.add(*element);
  return page.take();
}

SpacePicture picture_of_elements(const VolumeMesh& mesh, const VolumeCheck& check, int marked,
                                 const StopCheck& stop) {
  return CutAway(mesh, check, stop).make(marked);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
