#include "majorant/results/volume_page.h"

#include <algorithm>
#include <array>
#include <limits>

#include "majorant/results/volume_report.h"
#include "majorant/volumes/side_lattice.h"

namespace majorant {
namespace {

// Segments of an edge: enough for chords of quartic ones to look curved.
constexpr int kSteps = 8;
// Between the sides in the plane, whose edges have length 1.
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

  // In homogeneous coordinates, squared, from the middle of a triangle.
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
  // Of the element that is being added: its face next to where det J is least, how far from it.
  Index nearest_face_ = 0;
  double nearest_ = 0;
};

}  // namespace

MapPage page_of_elements(const VolumeMesh& mesh, const std::vector<const CheckedCell*>& elements) {
  ElementPage page(mesh);
  for (const CheckedCell* element : elements) page.add(*element);
  return page.take();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
