#include "majorant/mesh/box_tree.h"

#include <numeric>

namespace majorant {
namespace {

// Ignores coordinates that are NaN.
template <int D>
void extend(Box<D>& box, const Box<D>& by) {
  for (int d = 0; d < D; ++d) {
    if (by.low[d] < box.low[d]) box.low[d] = by.low[d];
    if (by.high[d] > box.high[d]) box.high[d] = by.high[d];
  }
}

template <int D>
Box<D> empty_box() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {Box<D>::Point::Constant(kInfinity), Box<D>::Point::Constant(-kInfinity)};
}

}  // namespace

std::vector<Box3> boxes_of_faces(const Points3& positions, const Cells& faces) {
  std::vector<Box3> boxes;
  boxes.reserve(static_cast<std::size_t>(faces.rows()));
  for (Index f = 0; f < faces.rows(); ++f) {
    const Vector3 a = positions.row(faces(f, 0)), b = positions.row(faces(f, 1)),
                  c = positions.row(faces(f, 2));
    boxes.push_back({a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)});
  }
  return boxes;
}

template <int D>
BoxTree<D>::BoxTree(std::vector<Box<D>> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (boxes_.empty()) return;
  add_node(0, size());
  std::vector<Box<D>> by_place;
  by_place.reserve(boxes_.size());
  for (const Index i : order_) by_place.push_back(boxes_[to_size(i)]);
  boxes_ = std::move(by_place);
}

// Returns the middle of the range, before which it puts the boxes with lesser centres. Returns
// `end` for at most kLeaf boxes.
template <int D>
Index BoxTree<D>::halve(Index begin, Index end) {
  if (end - begin <= kLeaf) return end;
  Box<D> all = empty_box<D>();
  for (Index place = begin; place < end; ++place) extend(all, boxes_[to_size(box_at(place))]);
  int axis = 0;
  for (int d = 1; d < D; ++d)
    if (all.high[d] - all.low[d] > all.high[axis] - all.low[axis]) axis = d;
  const auto key = [&](Index i) {
    const double center = boxes_[to_size(i)].low[axis] / 2 + boxes_[to_size(i)].high[axis] / 2;
    return std::pair(center == center ? center : 0, i);  // no NaN
  };
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](Index i, Index j) { return key(i) < key(j); });
  return middle;
}

// Adds the node of these places and its descendants. Returns its box.
template <int D>
Box<D> BoxTree<D>::add_node(Index begin, Index end) {
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  const Index middle = halve(begin, end);
  const std::array<Index, kChildren + 1> cut = {begin, halve(begin, middle), middle,
                                                halve(middle, end), end};
  Box<D> all = empty_box<D>();
  for (int k = 0; k < kChildren; ++k) {
    Child child{cut[to_size(k)], cut[to_size(k + 1)]};
    Box<D> of_child = empty_box<D>();
    if (child.last - child.first > kLeaf) {
      const Index below = static_cast<Index>(nodes_.size());
      of_child = add_node(child.first, child.last);
      child = {below, -1};
    } else {
      for (Index place = child.first; place < child.last; ++place)
        extend(of_child, boxes_[to_size(box_at(place))]);
    }
    extend(all, of_child);
    Node& added = nodes_[number];
    added.child[to_size(k)] = child;
    for (int d = 0; d < D; ++d) {
      added.low[to_size(d)][k] = of_child.low[d];
      added.high[to_size(d)][k] = of_child.high[d];
    }
  }
  return all;
}

template <int D>
typename BoxTree<D>::Part BoxTree<D>::part(Index number, Index begin, Index end, int slot,
                                           int count) const {
  const Child& child = node(number).child[to_size(slot)];
  if (count == 1 && child.is_node()) return part(child.first, begin, end, 0, kChildren);
  Part made{number, begin, end, slot, count, {}};
  for (int d = 0; d < D; ++d) {
    const auto low = node(number).low[to_size(d)].segment(slot, count);
    const auto high = node(number).high[to_size(d)].segment(slot, count);
    made.box.low[d] = low.minCoeff();
    made.box.high[d] = high.maxCoeff();
  }
  return made;
}

template <int D>
std::array<typename BoxTree<D>::Part, 2> BoxTree<D>::halves_of(const Part& whole) const {
  const Index middle = whole.begin + (whole.end - whole.begin) / 2;
  const int count = whole.count / 2;
  return {part(whole.node, whole.begin, middle, whole.slot, count),
          part(whole.node, middle, whole.end, whole.slot + count, count)};
}

template class BoxTree<2>;
template class BoxTree<3>;

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
