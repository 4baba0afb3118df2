// All pairs of boxes that meet, by a tree of bounding boxes.
//
//   visit_meeting_boxes(boxes, [&](Index i, Index j) { pairs.push_back({i, j}); return true; });
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

// Calls visit(i, j) once for every pair i < j, in an order that depends on the boxes alone, until
// it returns false. O(#boxes log #boxes + #pairs) for boxes of similar size. Finite numbers only.
void visit_meeting_boxes(const std::vector<Box2>& boxes,
                         const std::function<bool(Index, Index)>& visit);

}  // namespace majorant
