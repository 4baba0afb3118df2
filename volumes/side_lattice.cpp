#include "majorant/volumes/side_lattice.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "majorant/volumes/determinant_range.h"
#include "majorant/volumes/internal/reference_cell.h"
#include "majorant/volumes/node_orders.h"

namespace majorant {
namespace {

// Returns the corners of a side in cyclic order: three, or four of which neighbours differ in one
// factor of the cell.
std::vector<Exponents> in_turn(std::vector<Exponents> corners) {
  const auto changes = [&](const Exponents& e) {
    int count = 0;
    for (std::size_t c = 0; c < e.size(); ++c) count += e[c] != corners.front()[c] ? 1 : 0;
    return count;
  };
  if (corners.size() == 4)
    std::stable_sort(
        corners.begin() + 1, corners.end(),
        [&](const Exponents& a, const Exponents& b) { return changes(a) < changes(b); });
  return corners;
}

class LatticeMaker {
 public:
  LatticeMaker(std::vector<Exponents> corners, int steps)
      : corners_(in_turn(std::move(corners))), steps_(steps) {}

  SideLattice make(const CellType& type, const double* nodes) {
    for (int j = 0; j <= steps_; ++j)
      for (int i = 0; i <= row_length(j); ++i) add_point(i, j);
    const auto count = static_cast<Index>(side_.at.size());
    side_.points.resize(count, 3);
    side_.place.resize(count, 2);
    for (Index p = 0; p < count; ++p) {
      side_.points.row(p) = point_of_cell(type, nodes, side_.at[to_size(p)]).transpose();
      side_.place.row(p) = places_[to_size(p)].transpose();
    }
    add_triangles();
    return std::move(side_);
  }

 private:
  bool is_triangle() const { return corners_.size() == 3; }
  int row_length(int j) const { return is_triangle() ? steps_ - j : steps_; }

  void add_point(int i, int j) {
    const double s = static_cast<double>(i) / steps_, t = static_cast<double>(j) / steps_;
    std::vector<double> weights{(1 - s) * (1 - t), s * (1 - t), (1 - s) * t, s * t};
    if (is_triangle()) weights = {1 - s - t, s, t};
    std::array<double, 6> at{};
    for (std::size_t k = 0; k < corners_.size(); ++k)
      for (std::size_t c = 0; c < at.size(); ++c) at[c] += weights[k] * corners_[k][c];
    side_.at.push_back(at);
    places_.push_back(is_triangle() ? Vector2(s + t / 2, t * std::sqrt(0.75)) : Vector2(s, t));
  }

  void add_triangles() {
    std::vector<std::array<Index, 3>> triangles;
    Index row = 0;
    for (int j = 0; j < steps_; ++j) {
      const Index next = row + row_length(j) + 1;
      for (int i = 0; i < row_length(j); ++i) {
        triangles.push_back({row + i, row + i + 1, next + i});
        if (i < row_length(j + 1)) triangles.push_back({row + i + 1, next + i + 1, next + i});
      }
      row = next;
    }
    side_.triangles.resize(static_cast<Index>(triangles.size()), 3);
    for (Index t = 0; t < side_.triangles.rows(); ++t)
      for (Index k = 0; k < 3; ++k) side_.triangles(t, k) = triangles[to_size(t)][to_size(k)];
  }

  std::vector<Exponents> corners_;
  int steps_;
  SideLattice side_;
  std::vector<Vector2> places_;
};

}  // namespace

std::vector<SideLattice> side_lattices(const CellType& type, const double* nodes, int steps) {
  const std::vector<Exponents> corners = vtk_order(type.shape, 1);
  std::vector<SideLattice> sides;
  if (dimension(type.shape) == 2) {
    sides.push_back(LatticeMaker(corners, steps).make(type, nodes));
    for (int k = 0; k < corner_count(type.shape); ++k) sides.back().corners.push_back(k);
    return sides;
  }
  for (const ReferenceCell::Side& side : ReferenceCell::of(type).sides()) {
    std::vector<Exponents> of_side;
    for (const int corner : side.corners) of_side.push_back(corners[to_size(corner)]);
    sides.push_back(LatticeMaker(of_side, steps).make(type, nodes));
    sides.back().corners.assign(side.corners.begin(), side.corners.end());
  }
  return sides;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
