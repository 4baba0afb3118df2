// The boxes that contain a point, by a tree of four boxes a node. For millions of points: a node is
// a line of the cache, and its boxes are compared without a branch.
//
//   const StabbingTree tree({{Vector2(0, 0), Vector2(2, 1)}, {Vector2(3, 0), Vector2(4, 1)}});
//   tree.visit({0.5, 0.5}, [&](Index place) { say("{}\n", tree.box_at(place)); });   // 0
//
// Boxes are kept in single precision, of points and boxes by the same steps, each of which keeps
// order: who contains the point contains it still. Others may seem to, which it misses by less than
// the rounding of the extent of all boxes; whoever asks decides those for himself.
//
// Not for boxes that meet boxes: BoxTree.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "majorant/certify/box_pairs.h"
#include "majorant/framework/types.h"

namespace majorant {

class StabbingTree {
 public:
  // O(#boxes log #boxes). Finite numbers only.
  explicit StabbingTree(const std::vector<Box2>& boxes);

  // Calls visit(place) for every box that contains p, finite, and some around it. Places are dense:
  // boxes near each other have near ones.
  template <class Visit>
  void visit(const Vector2& p, const Visit& visit) const;

  // The number of the box at a place, as they were given.
  Index box_at(Index place) const { return order_[to_size(place)]; }
  Index size() const { return static_cast<Index>(order_.size()); }

 private:
  static constexpr std::uint32_t kWidth = 4;  // boxes of a node
  // Of 2^31 boxes, and the waiting nodes on the way to one.
  static constexpr std::size_t kMostLevels = 16, kMostWaiting = kMostLevels * (kWidth - 1) + 1;
  // Unused ones contain nothing.
  struct alignas(64) Node {
    std::array<float, kWidth> low_x, high_x, low_y, high_y;
  };

  float scaled(double x, Index axis) const {
    return static_cast<float>((x - origin_[axis]) * scale_[axis]);
  }
  void sort(const std::vector<Box2>& boxes, Index begin, Index end, Index capacity);

  Vector2 origin_ = Vector2::Zero(), scale_ = Vector2::Ones();
  std::vector<Index> order_;        // by place
  std::vector<Node> nodes_;         // level by level from the root; the last: four places a node
  std::vector<std::size_t> first_;  // by level: its first node
};

template <class Visit>
void StabbingTree::visit(const Vector2& p, const Visit& visit) const {
  if (nodes_.empty()) return;
  const float x = scaled(p.x(), 0), y = scaled(p.y(), 1);
  const auto last = static_cast<std::uint32_t>(first_.size()) - 1;
  // Nodes in their levels, and above these 32 bits the level: one number, which a processor hands
  // on from the store to the load.
  std::array<std::uint64_t, kMostWaiting + 1> waiting;  // one more to write to
  waiting[0] = 0;
  for (std::size_t count = 1; count > 0;) {
    const std::uint64_t next = waiting[--count];
    const auto node = static_cast<std::uint32_t>(next),
               level = static_cast<std::uint32_t>(next >> 32);
    const Node& n = nodes_[first_[level] + node];
    std::array<int, kWidth> contains;
    for (std::size_t k = 0; k < kWidth; ++k)
      contains[k] = static_cast<int>(n.low_x[k] <= x) & static_cast<int>(x <= n.high_x[k]) &
                    static_cast<int>(n.low_y[k] <= y) & static_cast<int>(y <= n.high_y[k]);
    if (level == last) {
      for (std::uint32_t k = 0; k < kWidth; ++k)
        if (contains[k] != 0) visit(static_cast<Index>(kWidth * node + k));
      continue;
    }
    const std::uint64_t below = (next >> 32) + 1;
    for (std::uint32_t k = 0; k < kWidth; ++k) {
      waiting[count] = below << 32 | (kWidth * node + k);
      count += static_cast<std::size_t>(contains[k]);
    }
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
