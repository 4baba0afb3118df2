#include "majorant/parametrization/box_pairs.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace majorant {
namespace {

class BoxTree {
 public:
  BoxTree(const std::vector<Box2>& boxes, const std::function<bool(Index, Index)>& visit)
      : boxes_(boxes), visit_(visit), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!boxes.empty()) build(0, static_cast<Index>(boxes.size()));
  }

  // False once `visit` has said so; as below.
  bool within(Index node) const {
    const Node& n = at(node);
    if (n.right < 0) return all_pairs(n, n);
    return within(node + 1) && within(n.right) && between(node + 1, n.right);
  }
  bool empty() const { return order_.empty(); }

 private:
  static constexpr Index kLeaf = 4;  // boxes
  struct Node {
    Box2 box;
    Index begin, end;
    Index right = -1;  // child; the left one follows its parent. -1: a leaf
  };

  const Node& at(Index node) const { return nodes_[static_cast<std::size_t>(node)]; }
  const Box2& box(Index place) const {
    return boxes_[static_cast<std::size_t>(order_[static_cast<std::size_t>(place)])];
  }

  void build(Index begin, Index end) {
    const std::size_t node = nodes_.size();
    nodes_.push_back({box(begin), begin, end});
    for (Index k = begin; k < end; ++k) {
      nodes_[node].box.low = nodes_[node].box.low.cwiseMin(box(k).low);
      nodes_[node].box.high = nodes_[node].box.high.cwiseMax(box(k).high);
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

  bool between(Index a, Index b) const {
    const Node &m = at(a), &n = at(b);
    if (!m.box.meets(n.box)) return true;
    if (m.right < 0 && n.right < 0) return all_pairs(m, n);
    const bool split_a = n.right < 0 || (m.right >= 0 && m.end - m.begin >= n.end - n.begin);
    return split_a ? between(a + 1, b) && between(m.right, b)
                   : between(a, b + 1) && between(a, n.right);
  }

  // Of two leaves, which may be the same.
  bool all_pairs(const Node& m, const Node& n) const {
    for (Index i = m.begin; i < m.end; ++i)
      for (Index j = m.begin == n.begin ? i + 1 : n.begin; j < n.end; ++j) {
        if (!box(i).meets(box(j))) continue;
        const auto [a, b] =
            std::minmax(order_[static_cast<std::size_t>(i)], order_[static_cast<std::size_t>(j)]);
        if (!visit_(a, b)) return false;
      }
    return true;
  }

  const std::vector<Box2>& boxes_;
  const std::function<bool(Index, Index)>& visit_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

}  // namespace

void visit_meeting_boxes(const std::vector<Box2>& boxes,
                         const std::function<bool(Index, Index)>& visit) {
  const BoxTree tree(boxes, visit);
  if (!tree.empty()) tree.within(0);
}

}  // namespace majorant
