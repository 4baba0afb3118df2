// Boxes that meet each other, or a given one, by a tree of bounding boxes.
//
//   const Vector2 p(0.5, 0.5);
//   const BoxTree tree({{Vector2(0, 0), Vector2(2, 1)}, {p, p}});
//   tree.visit_pairs([&](Index i, Index j) { return i < j; });   // boxes that meet; false: enough
//   tree.visit_meeting({p, p}, [&](Index i) { say("{}\n", i); });
#pragma once

#include <functional>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

struct Box2 {
  Vector2 low, high;
  bool meets(const Box2& other) const {  // touching included
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

class BoxTree {
 public:
  using VisitPair = std::function<bool(Index, Index)>;

  // O(#boxes log #boxes). Finite numbers only.
  explicit BoxTree(std::vector<Box2> boxes);

  // Calls visit(i, j) once for every pair i < j that meets, in an order that depends on the boxes
  // alone, until it returns false. O(#boxes log #boxes + #pairs) for boxes of similar size.
  void visit_pairs(const VisitPair& visit) const;

  // Calls visit(i) for every box that meets `box`, which may be infinite.
  void visit_meeting(const Box2& box, const std::function<void(Index)>& visit) const;

 private:
  static constexpr Index kLeaf = 4;  // boxes
  struct Node {
    Box2 box;
    Index begin, end;
    Index right = -1;  // child; the left one follows its parent. -1: a leaf
  };

  const Node& at(Index node) const { return nodes_[static_cast<std::size_t>(node)]; }
  const Box2& box(Index place) const { return boxes_[static_cast<std::size_t>(place)]; }
  void build(Index begin, Index end);
  // False once `visit` has said so.
  bool within(Index node, const VisitPair& visit) const;
  bool between(Index a, Index b, const VisitPair& visit) const;
  bool all_pairs(const Node& m, const Node& n, const VisitPair& visit) const;

  std::vector<Box2> boxes_;   // by their place, in the order of the leaves
  std::vector<Index> order_;  // by place: the number of the box
  std::vector<Node> nodes_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
