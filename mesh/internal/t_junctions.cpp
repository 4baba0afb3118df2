#include "majorant/mesh/internal/t_junctions.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace majorant {
namespace {

// Points in space, halved again and again across the longer side of their box.
class PointTree {
 public:
  PointTree(const Points3& positions, std::vector<Index> points)
      : positions_(positions), points_(std::move(points)) {
    build(0, points_.size());
  }

  // Calls visit(point) for all points closer than `reach` to the segment, and some others.
  template <class Visit>
  void near_segment(const Vector3& a, const Vector3& b, double reach, const Visit& visit) const {
    std::vector<std::size_t> left = {0};
    while (!left.empty() && !nodes_.empty()) {
      const std::size_t n = left.back();
      const Node& node = nodes_[n];
      left.pop_back();
      if (!passes(node, a, b, reach)) continue;
      if (node.second_child == 0) {
        for (std::size_t k = node.first; k < node.last; ++k) visit(points_[k]);
      } else {
        left.push_back(node.second_child);
        left.push_back(n + 1);
      }
    }
  }

 private:
  static constexpr std::size_t kLeaf = 8;

  struct Node {
    Vector3 low, high;
    std::size_t first, last;
    std::size_t second_child = 0;  // the first one follows its parent; 0: a leaf
  };

  void build(std::size_t first, std::size_t last) {
    if (first == last) return;
    Node node{positions_.row(points_[first]), positions_.row(points_[first]), first, last};
    for (std::size_t k = first; k < last; ++k) {
      const Vector3 p = positions_.row(points_[k]);
      node.low = node.low.cwiseMin(p);
      node.high = node.high.cwiseMax(p);
    }
    const std::size_t here = nodes_.size();
    nodes_.push_back(node);
    if (last - first <= kLeaf) return;
    Eigen::Index axis;
    (node.high - node.low).maxCoeff(&axis);
    const std::size_t middle = first + (last - first) / 2;
    const auto place = [&](std::size_t k) {
      return points_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    std::nth_element(place(first), place(middle), place(last),
                     [&](Index p, Index q) { return positions_(p, axis) < positions_(q, axis); });
    build(first, middle);
    nodes_[here].second_child = nodes_.size();
    build(middle, last);
  }

  // Whether the segment meets the box, made larger by `reach`.
  static bool passes(const Node& node, const Vector3& a, const Vector3& b, double reach) {
    double from = 0, to = 1;
    for (int k = 0; k < 3; ++k) {
      const double low = node.low[k] - reach - a[k], high = node.high[k] + reach - a[k];
      const double along = b[k] - a[k];
      if (along == 0) {
        if (low > 0 || high < 0) return false;
        continue;
      }
      from = std::max(from, std::min(low / along, high / along));
      to = std::min(to, std::max(low / along, high / along));
    }
    return from <= to;
  }

  const Points3& positions_;
  std::vector<Index> points_;
  std::vector<Node> nodes_;
};

}  // namespace

std::vector<TJunction> find_t_junctions(const SurfaceMesh& mesh, const StopCheck& stop) {
  std::vector<Index> boundary;
  for (const auto& loop : mesh.boundary_loops())
    boundary.insert(boundary.end(), loop.begin(), loop.end());
  const PointTree tree(mesh.positions(), std::move(boundary));
  std::vector<TJunction> found;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (mesh.opposite(h) >= 0) continue;
    stop.poll_at(to_size(h));
    const Vector3 a = mesh.positions().row(mesh.from_vertex(h));
    const Vector3 b = mesh.positions().row(mesh.to_vertex(h));
    const double length = (b - a).norm(), reach = kOnEdge * length;
    if (!(length > 0)) continue;
    tree.near_segment(a, b, reach, [&](Index v) {
      const Vector3 p = Vector3(mesh.positions().row(v)) - a;
      const double along = p.dot(b - a) / length;
      const double off = (p - along * (b - a) / length).norm();
      if (along > reach && along < length - reach && off <= reach) found.push_back({v, h});
    });
  }
  std::stable_sort(found.begin(), found.end());
  const auto same = [](const TJunction& i, const TJunction& j) { return i.vertex == j.vertex; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
