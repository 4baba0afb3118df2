#include "majorant/certify/box_pairs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace majorant {

BoxTree::BoxTree(std::vector<Box2> boxes) : boxes_(std::move(boxes)), order_(boxes_.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (boxes_.empty()) return;
  build(0, static_cast<Index>(boxes_.size()));
  std::vector<Box2> in_order;
  in_order.reserve(boxes_.size());
  for (const Index i : order_) in_order.push_back(boxes_[static_cast<std::size_t>(i)]);
  boxes_ = std::move(in_order);
}

void BoxTree::visit_pairs(const VisitPair& visit) const {
  if (!nodes_.empty()) within(0, visit);
}

void BoxTree::visit_meeting(const Box2& box, const std::function<void(Index)>& visit) const {
  // Halves of at most 2^31 boxes: one node of each level waits, and two of the last.
  std::array<Index, std::numeric_limits<Index>::digits + 2> waiting;
  int count = 0;
  if (!nodes_.empty() && nodes_.front().box.meets(box)) waiting[count++] = 0;
  while (count > 0) {
    const Index node = waiting[--count];
    const Node& n = at(node);
    if (n.right >= 0) {
      if (at(n.right).box.meets(box)) waiting[count++] = n.right;
      if (at(node + 1).box.meets(box)) waiting[count++] = node + 1;
      continue;
    }
    for (Index place = n.begin; place < n.end; ++place)
      if (this->box(place).meets(box)) visit(order_[static_cast<std::size_t>(place)]);
  }
}

void BoxTree::build(Index begin, Index end) {
  const std::size_t node = nodes_.size();
  const auto given = [&](Index place) -> const Box2& {
    return boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(place)])];
  };
  nodes_.push_back({given(begin), begin, end});
  for (Index k = begin; k < end; ++k) {
    nodes_[node].box.low = nodes_[node].box.low.cwiseMin(given(k).low);
    nodes_[node].box.high = nodes_[node].box.high.cwiseMax(given(k).high);
  }
  if (end - begin <= kLeaf) return;
  const Vector2 size = nodes_[node].box.high - nodes_[node].box.low;
  const int axis = size.x() >= size.y() ? 0 : 1;
  const auto key = [&](Index i) {
    const Box2& b = boxes_[static_cast<std::size_t>(i)];
    return std::pair(b.low[axis] / 2 + b.high[axis] / 2, i);
  };
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](Index i, Index j) { return key(i) < key(j); });
  build(begin, middle);
  nodes_[node].right = static_cast<Index>(nodes_.size());
  build(middle, end);
}

bool BoxTree::within(Index node, const VisitPair& visit) const {
  const Node& n = at(node);
  if (n.right < 0) return all_pairs(n, n, visit);
  return within(node + 1, visit) && within(n.right, visit) && between(node + 1, n.right, visit);
}

bool BoxTree::between(Index a, Index b, const VisitPair& visit) const {
  const Node &m = at(a), &n = at(b);
  if (!m.box.meets(n.box)) return true;
  if (m.right < 0 && n.right < 0) return all_pairs(m, n, visit);
  const bool split_a = n.right < 0 || (m.right >= 0 && m.end - m.begin >= n.end - n.begin);
  return split_a ? between(a + 1, b, visit) && between(m.right, b, visit)
                 : between(a, b + 1, visit) && between(a, n.right, visit);
}

// Visits all pairs of two leaves, which may be the same leaf.
bool BoxTree::all_pairs(const Node& m, const Node& n, const VisitPair& visit) const {
  for (Index i = m.begin; i < m.end; ++i)
    for (Index j = m.begin == n.begin ? i + 1 : n.begin; j < n.end; ++j) {
      if (!box(i).meets(box(j))) continue;
      const auto [a, b] =
          std::minmax(order_[static_cast<std::size_t>(i)], order_[static_cast<std::size_t>(j)]);
      if (!visit(a, b)) return false;
    }
  return true;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
