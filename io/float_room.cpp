#include "majorant/io/float_room.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "majorant/framework/rounding.h"
#include "majorant/mesh/box_tree.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

// Distances below are in units in the last place of the largest coordinate involved. Rounding moves
// a point by half a unit along each axis, which changes a height by less than 1.5.
constexpr double kLeastRoom = 2;
// The height that corrections aim at, so that constraints with common points converge.
constexpr double kRoom = 2.5;
// Triangles below this height are constraints, since their neighbours' points may move by a few
// units.
constexpr double kNearRoom = 16;
// Each round ends with rounding, and adds the constraints that rounding violates.
constexpr int kRounds = 4;
// Sweeps through all constraints of a round. Rows of needles push each other along, so that the
// number of sweeps grows with their length.
constexpr int kSweeps = 2000;
// Limit of evaluated constraints, about one or two seconds.
constexpr double kMaxPushes = 2e8;

using Triangle = std::array<Index, 3>;

// Returns a point after its coordinates were stored as floats.
Vector2 stored(const Vector2& uv, StoredV v) {
  return {uv.x(), v == StoredV::Down ? 1 - uv.y() : uv.y()};
}
Vector2 rounded(const Vector2& uv, StoredV v) {
  return stored(stored(uv, v).cast<float>().cast<double>(), v);
}

Vector2 left_of(const Vector2& along) { return {-along.y(), along.x()}; }

// The distinct points of a layout and the constraints that keep them apart.
class FloatRoom {
 public:
  FloatRoom(const MapFile& map, StoredV v)
      : v_(v), node_(to_size(static_cast<Index>(map.uv.rows()))) {
    collect_nodes(map);
    for (Index c = 0; c < map.cells.rows(); ++c) {
      const Triangle t{node_[map.cells(c, 0)], node_[map.cells(c, 1)], node_[map.cells(c, 2)]};
      if (orientation(given_[t[0]], given_[t[1]], given_[t[2]]) > 0) triangles_.push_back(t);
    }
    std::sort(triangles_.begin(), triangles_.end());
    triangles_.erase(std::unique(triangles_.begin(), triangles_.end()), triangles_.end());
    collect_borders();
    x_ = given_;
  }

  // Returns new coordinates of the points; none if plain rounding suffices or nothing helps.
  std::optional<Points2> run() {
    std::vector<Vector2> floats = rounded_points();
    if (gaps_.empty() && turned_over(floats).empty()) return {};
    std::set<std::size_t> narrow;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (height(triangles_[t]) < kNearRoom * unit(triangles_[t])) narrow.insert(t);
    for (int round = 0; round < kRounds; ++round) {
      for (const std::size_t t : turned_over(floats)) narrow.insert(t);
      settle({narrow.begin(), narrow.end()});
      floats = rounded_points();
      if (turned_over(floats).empty()) return points(floats);
    }
    return {};
  }

 private:
  // Returns the spacing of floats at the largest stored coordinate of these points.
  template <class... Points>
  double last_place(const Points&... points) const {
    const double largest = std::max({stored(points, v_).cwiseAbs().maxCoeff()...});
    return 0x1p-24 * power_of_two(std::max(largest, 0x1p-100), PowerOfTwo::Above);
  }

  // A border vertex to the right of a border edge (a, b); or, if b is a, next to vertex a.
  struct Gap {
    Index vertex, a, b;
  };

  void collect_nodes(const MapFile& map) {
    std::vector<Index> order(node_.size());
    std::iota(order.begin(), order.end(), 0);
    const auto place = [&](Index p) { return std::pair(map.uv(p, 0), map.uv(p, 1)); };
    std::sort(order.begin(), order.end(), [&](Index p, Index q) { return place(p) < place(q); });
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k == 0 || place(order[k]) != place(order[k - 1]))
        given_.emplace_back(map.uv.row(order[k]));
      node_[order[k]] = static_cast<Index>(given_.size()) - 1;
      box_.extend(given_.back());
    }
  }

  // Collects pairs of a border vertex and a border edge of one chart that may meet by rounding.
  void collect_borders() {
    std::vector<std::array<Index, 2>> edges;
    UnionFind charts(static_cast<Index>(given_.size()));
    for (const Triangle& t : triangles_)
      for (std::size_t k = 0; k < 3; ++k) {
        edges.push_back({t[k], t[(k + 1) % 3]});
        charts.join(t[k], t[(k + 1) % 3]);
      }
    std::sort(edges.begin(), edges.end());
    std::vector<std::array<Index, 2>> border;
    for (const auto& [a, b] : edges)
      if (!std::binary_search(edges.begin(), edges.end(), std::array<Index, 2>{b, a}))
        border.push_back({a, b});
    std::vector<Box2> boxes;
    for (const auto& [a, b] : border) {
      const double margin = kLeastRoom * last_place(given_[a], given_[b]);
      boxes.push_back({given_[a].cwiseMin(given_[b]).array() - margin,
                       given_[a].cwiseMax(given_[b]).array() + margin});
    }
    BoxTree(std::move(boxes)).visit_pairs([&](Index i, Index j) {
      const auto &e = border[to_size(i)], &f = border[to_size(j)];
      if (charts.find(e[0]) != charts.find(f[0])) return true;
      for (const auto& [edge, other] : {std::pair(e, f), std::pair(f, e)})
        for (const Index v : edge)
          if (v != other[0] && v != other[1]) add_gap(v, other[0], other[1]);
      return true;
    });
    std::sort(gaps_.begin(), gaps_.end(), [](const Gap& g, const Gap& h) {
      return std::tie(g.vertex, g.a, g.b) < std::tie(h.vertex, h.a, h.b);
    });
    gaps_.erase(std::unique(gaps_.begin(), gaps_.end(),
                            [](const Gap& g, const Gap& h) {
                              return g.vertex == h.vertex && g.a == h.a && g.b == h.b;
                            }),
                gaps_.end());
  }

  void add_gap(Index v, Index a, Index b) {
    const Vector2 &p = given_[v], &from = given_[a], along = given_[b] - from;
    if (orientation(from, given_[b], p) >= 0) return;  // the chart is on that side
    const double least = kLeastRoom * last_place(p, from, given_[b]);
    const double t = along.dot(p - from) / along.squaredNorm();
    if (t <= 0 || t >= 1) {
      const Index end = t <= 0 ? a : b;
      if ((p - given_[end]).norm() < least) gaps_.push_back({v, end, end});
    } else if (left_of(along).dot(from - p) < least * along.norm()) {
      gaps_.push_back({v, a, b});
    }
  }

  std::vector<Vector2> rounded_points() const {
    std::vector<Vector2> floats;
    for (const Vector2& p : x_) floats.push_back(rounded(p, v_));
    return floats;
  }

  std::vector<std::size_t> turned_over(const std::vector<Vector2>& at) const {
    std::vector<std::size_t> turned;
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
      const auto& [a, b, c] = triangles_[k];
      if (orientation(at[a], at[b], at[c]) <= 0) turned.push_back(k);
    }
    return turned;
  }

  double unit(const Triangle& t) const { return last_place(x_[t[0]], x_[t[1]], x_[t[2]]); }

  // Returns the triangle with the longest side first.
  Triangle by_longest(const Triangle& t) const {
    std::size_t longest = 0;
    const auto length = [&](std::size_t k) {
      return (x_[t[(k + 1) % 3]] - x_[t[k]]).squaredNorm();
    };
    for (std::size_t k = 1; k < 3; ++k)
      if (length(k) > length(longest)) longest = k;
    return {t[longest], t[(longest + 1) % 3], t[(longest + 2) % 3]};
  }

  double height(const Triangle& triangle) const {
    const auto [a, b, c] = by_longest(triangle);
    const Vector2 along = x_[b] - x_[a];
    const double length = along.norm();
    return length > 0 ? cross(along, Vector2(x_[c] - x_[a])) / length : 0;
  }

  void move(Index node, const Vector2& by) {
    x_[node] = (x_[node] + by).cwiseMax(box_.min()).cwiseMin(box_.max());
  }

  // Moves a and b apart along their direction; along the original one if they coincide.
  bool widen(Index a, Index b, double least, double aim) {
    Vector2 along = x_[b] - x_[a];
    const double length = along.norm();
    if (length >= least) return false;
    if (!(length > 0)) along = given_[b] - given_[a];
    along = (aim - length) / 2 * along.stableNormalized();
    move(a, -along);
    move(b, along);
    return true;
  }

  // Moves p to the left of the line from a to b, and a and b to its right, in proportion.
  bool lift(Index p, Index a, Index b, double least, double aim) {
    Vector2 along = x_[b] - x_[a];
    if (!(along.norm() > 0)) along = given_[b] - given_[a];
    along = along.stableNormalized();
    const Vector2 up = left_of(along);
    const double height = up.dot(x_[p] - x_[a]), length = (x_[b] - x_[a]).norm();
    if (height >= least) return false;
    const double t = length > 0 ? std::clamp(along.dot(x_[p] - x_[a]) / length, 0.0, 1.0) : 0.5;
    const double step = (aim - height) / (1 + t * t + (1 - t) * (1 - t));
    move(p, step * up);
    move(a, -step * (1 - t) * up);
    move(b, -step * t * up);
    return true;
  }

  bool push(const Triangle& triangle) {
    const auto [a, b, c] = by_longest(triangle);
    const double one = unit(triangle);
    const bool is_long = widen(a, b, 2 * kLeastRoom * one, 2 * kRoom * one);
    return lift(c, a, b, kLeastRoom * one, kRoom * one) || is_long;
  }

  bool push(const Gap& gap) {
    const double one = last_place(x_[gap.vertex], x_[gap.a], x_[gap.b]);
    if (gap.a == gap.b) return widen(gap.a, gap.vertex, kLeastRoom * one, kRoom * one);
    return lift(gap.vertex, gap.b, gap.a, kLeastRoom * one, kRoom * one);
  }

  void settle(const std::vector<std::size_t>& narrow) {
    for (int sweep = 0; sweep < kSweeps && pushes_ < kMaxPushes; ++sweep) {
      bool is_moved = false;
      for (const std::size_t t : narrow) is_moved |= push(triangles_[t]);
      for (const Gap& gap : gaps_) is_moved |= push(gap);
      if (!is_moved) return;
      pushes_ += static_cast<double>(narrow.size() + gaps_.size());
    }
  }

  Points2 points(const std::vector<Vector2>& at) const {
    Points2 uv(static_cast<Index>(node_.size()), 2);
    for (std::size_t p = 0; p < node_.size(); ++p)
      uv.row(static_cast<Index>(p)) = at[to_size(node_[p])].transpose();
    return uv;
  }

  StoredV v_;
  std::vector<Index> node_;          // node of each point
  std::vector<Vector2> given_, x_;   // by node
  Eigen::AlignedBox2d box_;          // of the layout; its size stays the same
  std::vector<Triangle> triangles_;  // positive triangles, each once
  std::vector<Gap> gaps_;
  double pushes_ = 0;
};

}  // namespace

MapFile with_room_in_floats(const MapFile& map, StoredV v) {
  if (map.degree != 1 || map.uv.rows() == 0) return map;
  std::optional<Points2> uv = FloatRoom(map, v).run();
  if (!uv) return map;
  MapFile out = map;
  out.uv = std::move(*uv);
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
