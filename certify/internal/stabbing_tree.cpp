#include "majorant/certify/internal/stabbing_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace majorant {

StabbingTree::StabbingTree(const std::vector<Box2>& boxes) : order_(boxes.size()) {
  if (boxes.empty()) return;
  std::iota(order_.begin(), order_.end(), 0);
  Box2 all = boxes.front();
  for (const Box2& box : boxes) {
    all.low = all.low.cwiseMin(box.low);
    all.high = all.high.cwiseMax(box.high);
  }
  // An extent that is 0, or leaves the range of numbers, is not scaled: that costs time alone.
  for (Index axis = 0; axis < 2; ++axis) {
    const double extent = all.high[axis] - all.low[axis], scale = 1 / extent;
    if (!std::isnormal(extent) || !std::isnormal(scale)) continue;
    origin_[axis] = all.low[axis];
    scale_[axis] = scale;
  }
  std::vector<std::size_t> nodes_of_level;  // from the last one
  Index capacity = 1;                       // boxes below a child of the root
  for (std::size_t count = boxes.size(); nodes_of_level.empty() || count > 1;) {
    count = (count - 1) / kWidth + 1;
    nodes_of_level.push_back(count);
    if (count > 1) capacity *= static_cast<Index>(kWidth);
  }
  sort(boxes, 0, size(), capacity);
  std::size_t nodes = 0;
  for (auto count = nodes_of_level.rbegin(); count != nodes_of_level.rend(); ++count) {
    first_.push_back(nodes);
    nodes += *count;
  }
  constexpr float kFar = std::numeric_limits<float>::infinity();
  constexpr std::array<float, kWidth> kNever{kFar, kFar, kFar, kFar};
  constexpr std::array<float, kWidth> kBefore{-kFar, -kFar, -kFar, -kFar};
  nodes_.assign(nodes, {kNever, kBefore, kNever, kBefore});
  for (std::size_t place = 0; place < order_.size(); ++place) {
    const Box2& box = boxes[to_size(order_[place])];
    const float low_x = scaled(box.low.x(), 0), high_x = scaled(box.high.x(), 0);
    const float low_y = scaled(box.low.y(), 1), high_y = scaled(box.high.y(), 1);
    std::size_t child = place;
    for (auto level = first_.rbegin(); level != first_.rend(); ++level, child /= kWidth) {
      Node& node = nodes_[*level + child / kWidth];
      const std::size_t k = child % kWidth;
      node.low_x[k] = std::min(node.low_x[k], low_x);
      node.high_x[k] = std::max(node.high_x[k], high_x);
      node.low_y[k] = std::min(node.low_y[k], low_y);
      node.high_y[k] = std::max(node.high_y[k], high_y);
    }
  }
}

// Puts the boxes of [begin, end) into an order in which each run of `capacity`, and in these each
// of a quarter as many, is compact: halves by the wider side of what contains all centres.
void StabbingTree::sort(const std::vector<Box2>& boxes, Index begin, Index end, Index capacity) {
  const auto center = [&](Index i, Index axis) {
    const Box2& box = boxes[to_size(i)];
    return box.low[axis] / 2 + box.high[axis] / 2;
  };
  const auto halve = [&](Index from, Index middle, Index to) {
    if (middle >= to) return;
    Vector2 low(center(order_[to_size(from)], 0), center(order_[to_size(from)], 1)), high = low;
    for (Index place = from; place < to; ++place) {
      const Index i = order_[to_size(place)];
      const Vector2 at(center(i, 0), center(i, 1));
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    const Index axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
    std::nth_element(order_.begin() + from, order_.begin() + middle, order_.begin() + to,
                     [&](Index i, Index j) {
                       return std::pair(center(i, axis), i) < std::pair(center(j, axis), j);
                     });
  };
  if (capacity == 1) return;                // a node, whose order is of no matter
  const auto after = [&](Index quarters) {  // without overflow
    return (end - begin) / capacity >= quarters ? begin + quarters * capacity : end;
  };
  halve(begin, after(2), end);
  halve(begin, after(1), after(2));
  halve(after(2), after(3), end);
  for (Index quarter = 0; after(quarter) < end; ++quarter)
    sort(boxes, after(quarter), after(quarter + 1), capacity / static_cast<Index>(kWidth));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
