// A tree of bounding boxes in the plane or in space. It finds the pairs of boxes that meet, and the
// boxes that meet a given box, point or line, or are near a point.
//
//   const Vector2 p(0.5, 0.5);
//   const BoxTree<2> tree({{Vector2(0, 0), Vector2(2, 1)}, {p, p}});
//   tree.visit_pairs([&](Index i, Index j) { return i < j; });   // boxes that meet; false: enough
//   tree.visit_meeting({p, p}, [&](Index i) { say("{}\n", i); });
//   tree.visit_along({p, {1, 0}}, 0, [&](Index) { return true; });
//   double square = 4;   // of the distance, which the visitor may make smaller
//   tree.visit_near(p, square, [&](Index i) { say("{}\n", i); });
//
// A node stores the boxes of its four children side by side, which are compared without a branch.
// Boxes are halved at medians of their centres, across the longest side of their common box. A box
// with a coordinate that is NaN meets nothing.
//
// Not for the nearest points of triangles: SurfaceTree (nearest_point.h).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

template <int D>
struct Box {
  using Point = Eigen::Matrix<double, D, 1>;
  Point low, high;

  bool meets(const Box& other) const {  // touching included
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
  double squared_distance(const Point& p) const {
    return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
  }
};
using Box2 = Box<2>;
using Box3 = Box<3>;

// The bounding boxes of the faces, #F by 3, of a surface.
std::vector<Box3> boxes_of_faces(const Points3& positions, const Cells& faces);

// The points from + t along with 0 <= t <= last.
template <int D>
struct Ray {
  typename Box<D>::Point from, along;
  double last = std::numeric_limits<double>::infinity();
};

template <int D>
class BoxTree {
 public:
  using Point = typename Box<D>::Point;

  // Takes O(#boxes log #boxes).
  explicit BoxTree(std::vector<Box<D>> boxes);

  // Calls visit(i, j) once for every pair i < j that meets, until it returns false. The order
  // depends on the boxes alone. Takes O(#boxes log #boxes + #pairs) for boxes of similar size.
  template <class Visit>
  void visit_pairs(const Visit& visit) const;

  // Calls visit(i) for every box that meets `box`, which may be infinite, or a point.
  template <class Visit>
  void visit_meeting(const Box<D>& box, const Visit& visit) const;

  // Calls visit(i) for every box within `reach` of the ray in each coordinate, until it returns
  // false. By rounding it may also visit boxes that the ray misses.
  template <class Visit>
  void visit_along(const Ray<D>& ray, double reach, const Visit& visit) const;

  // Calls visit(i) for every box whose squared distance from p is at most `square`, up to rounding,
  // nearer nodes first. visit() may make `square` smaller.
  template <class Visit>
  void visit_near(const Point& p, const double& square, const Visit& visit) const;

  // The place of a box in the tree: boxes that are near each other have near places. Programs that
  // store data of the boxes by place visit places instead of the boxes' numbers.
  Index size() const { return static_cast<Index>(order_.size()); }
  Index box_at(Index place) const { return order_[to_size(place)]; }
  template <class Visit>
  void visit_places_meeting(const Box<D>& box, const Visit& visit) const;

 private:
  static constexpr Index kLeaf = 4;    // the maximum number of boxes
  static constexpr int kChildren = 4;  // of a node
  // The size of the stack: three of four children wait at each level, and there are at most 2^31
  // boxes.
  static constexpr std::size_t kMostWaiting =
      (kChildren - 1) * (std::numeric_limits<Index>::digits / 2 + 1) + 2;
  // An upper bound of the relative rounding of squared distances, and of parameters of rays.
  static constexpr double kRounding = 1e-14;

  using Four = Eigen::Array<double, kChildren, 1>;
  // The places from first to last - 1; if last < 0, the node `first`.
  struct Child {
    Index first = 0, last = 0;
    bool is_node() const { return last < 0; }
  };
  struct Node {
    std::array<Four, D> low, high;  // by coordinate
    std::array<Child, kChildren> child;
  };
  // The children `slot` to slot + count - 1 of a node, with count 4, 2 or 1. Pairs are searched
  // between halves, then between halves of these.
  struct Part {
    Index node, begin, end;
    int slot, count;
    Box<D> box;
    bool is_leaf() const { return end - begin <= kLeaf; }
  };

  Index halve(Index begin, Index end);
  Box<D> add_node(Index begin, Index end);

  const Node& node(Index number) const { return nodes_[to_size(number)]; }
  const Box<D>& box(Index place) const { return boxes_[to_size(place)]; }
  Part part(Index node, Index begin, Index end, int slot, int count) const;
  std::array<Part, 2> halves_of(const Part& whole) const;

  template <class Visit>
  bool visit_within(const Part& all, const Visit& visit) const;
  template <class Visit>
  bool visit_between(const Part& a, const Part& b, const Visit& visit) const;
  template <class Visit>
  bool visit_all_pairs(const Part& a, const Part& b, const Visit& visit) const;

  std::vector<Box<D>> boxes_;  // by place
  std::vector<Index> order_;   // by place: the number of the box
  std::vector<Node> nodes_;
};

extern template class BoxTree<2>;
extern template class BoxTree<3>;

template <int D>
template <class Visit>
void BoxTree<D>::visit_places_meeting(const Box<D>& box, const Visit& visit) const {
  if (nodes_.empty()) return;
  std::array<Child, kMostWaiting> waiting;
  waiting[0] = {0, -1};
  for (std::size_t count = 1; count > 0;) {
    const Child top = waiting[--count];
    if (!top.is_node()) {
      for (Index place = top.first; place < top.last; ++place)
        if (this->box(place).meets(box)) visit(place);
      continue;
    }
    const Node& n = node(top.first);
    // The largest gap between two boxes in any coordinate: not positive if they meet, NaN if both
    // end at infinity.
    Four gap = (n.low[0] - box.high[0]).max(box.low[0] - n.high[0]);
    for (std::size_t d = 1; d < D; ++d)
      gap = gap.max((n.low[d] - box.high[d]).max(box.low[d] - n.high[d]));
    for (int k = kChildren - 1; k >= 0; --k) {
      waiting[count] = n.child[to_size(k)];
      count += static_cast<std::size_t>(!(gap[k] > 0));
    }
  }
}

template <int D>
template <class Visit>
void BoxTree<D>::visit_meeting(const Box<D>& box, const Visit& visit) const {
  visit_places_meeting(box, [&](Index place) { visit(box_at(place)); });
}

template <int D>
template <class Visit>
void BoxTree<D>::visit_along(const Ray<D>& ray, double reach, const Visit& visit) const {
  if (nodes_.empty()) return;
  // Cuts the parameters from `enter` to `leave` by the slab from `low` to `high` of coordinate d.
  const auto cut = [&](int d, const auto& low, const auto& high, auto& enter, auto& leave) {
    using Values = std::decay_t<decltype(enter)>;
    const double from = ray.from[d], along = ray.along[d];
    const Values a = low - (from + reach), b = high - (from - reach);
    if (along == 0) {
      // Division by 0 would give NaN; if the ray is outside of the slab, nothing is left.
      leave = (a > 0 || b < 0).select(Values::Constant(-1), leave);
      return;
    }
    enter = enter.max((a / along).min(b / along));
    leave = leave.min((a / along).max(b / along));
  };
  using One = Eigen::Array<double, 1, 1>;
  std::array<Child, kMostWaiting> waiting;
  waiting[0] = {0, -1};
  for (std::size_t count = 1; count > 0;) {
    const Child top = waiting[--count];
    if (!top.is_node()) {
      for (Index place = top.first; place < top.last; ++place) {
        One enter = One::Zero(), leave = One::Constant(ray.last);
        for (int d = 0; d < D; ++d)
          cut(d, One::Constant(box(place).low[d]), One::Constant(box(place).high[d]), enter, leave);
        if (enter[0] <= leave[0] * (1 + kRounding) && !visit(box_at(place))) return;
      }
      continue;
    }
    const Node& n = node(top.first);
    Four enter = Four::Zero(), leave = Four::Constant(ray.last);
    for (int d = 0; d < D; ++d)
      cut(d, n.low[static_cast<std::size_t>(d)], n.high[static_cast<std::size_t>(d)], enter, leave);
    for (int k = kChildren - 1; k >= 0; --k) {
      waiting[count] = n.child[to_size(k)];
      count += static_cast<std::size_t>(enter[k] <= leave[k] * (1 + kRounding));
    }
  }
}

template <int D>
template <class Visit>
void BoxTree<D>::visit_near(const Point& p, const double& square, const Visit& visit) const {
  if (nodes_.empty()) return;
  struct Waiting {
    double square;
    Child child;
  };
  std::array<Waiting, kMostWaiting> waiting;
  waiting[0] = {0, {0, -1}};
  double bound = square * (1 + kRounding);
  for (std::size_t count = 1; count > 0;) {
    const Waiting top = waiting[--count];
    if (!(top.square <= bound)) continue;
    if (!top.child.is_node()) {
      for (Index place = top.child.first; place < top.child.last; ++place) {
        if (!(box(place).squared_distance(p) <= bound)) continue;
        visit(box_at(place));
        bound = square * (1 + kRounding);
      }
      continue;
    }
    const Node& n = node(top.child.first);
    Four squares = Four::Zero();
    for (std::size_t d = 0; d < D; ++d) {
      const double x = p[static_cast<Index>(d)];
      squares += (n.low[d] - x).max(x - n.high[d]).max(0.0).square();
    }
    // Sorts the children so that the nearest one is on top.
    const std::size_t first = count;
    for (int k = 0; k < kChildren; ++k) {
      if (!(squares[k] <= bound)) continue;
      std::size_t place = count++;
      for (; place > first && waiting[place - 1].square < squares[k]; --place)
        waiting[place] = waiting[place - 1];
      waiting[place] = {squares[k], n.child[to_size(k)]};
    }
  }
}

template <int D>
template <class Visit>
void BoxTree<D>::visit_pairs(const Visit& visit) const {
  if (!nodes_.empty()) visit_within(part(0, 0, size(), 0, kChildren), visit);
}

template <int D>
template <class Visit>
bool BoxTree<D>::visit_within(const Part& all, const Visit& visit) const {
  if (all.is_leaf()) return visit_all_pairs(all, all, visit);
  const auto [first, second] = halves_of(all);
  return visit_within(first, visit) && visit_within(second, visit) &&
         visit_between(first, second, visit);
}

template <int D>
template <class Visit>
bool BoxTree<D>::visit_between(const Part& a, const Part& b, const Visit& visit) const {
  if (!a.box.meets(b.box)) return true;
  if (a.is_leaf() && b.is_leaf()) return visit_all_pairs(a, b, visit);
  const bool split_a = b.is_leaf() || (!a.is_leaf() && a.end - a.begin >= b.end - b.begin);
  const auto [first, second] = halves_of(split_a ? a : b);
  return split_a ? visit_between(first, b, visit) && visit_between(second, b, visit)
                 : visit_between(a, first, visit) && visit_between(a, second, visit);
}

// Visits all pairs of two leaves, which may be the same leaf.
template <int D>
template <class Visit>
bool BoxTree<D>::visit_all_pairs(const Part& a, const Part& b, const Visit& visit) const {
  for (Index i = a.begin; i < a.end; ++i)
    for (Index j = a.begin == b.begin ? i + 1 : b.begin; j < b.end; ++j) {
      if (!box(i).meets(box(j))) continue;
      const auto [least, largest] = std::minmax({box_at(i), box_at(j)});
      if (!visit(least, largest)) return false;
    }
  return true;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
