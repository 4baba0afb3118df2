#include "majorant/certify/internal/segment_sweep.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "majorant/mesh/internal/exact_predicates.h"

namespace majorant {
namespace {

// The sweep line goes through the vertices in lexicographic order, as if it leant a little to the
// left. Edge k runs from vertex k to vertex next[k].
class Sweep {
 public:
  Sweep(const BoundaryLoops& loops, SubdivisionBudget& budget)
      : next_(loops.next()),
        before_(next_.size()),
        active_(Below{this}),
        place_(next_.size()),
        budget_(budget) {
    for (std::size_t k = 0; k < next_.size(); ++k) {
      vertices_.push_back(loops.curves[k].front());
      before_[next_[k]] = static_cast<Index>(k);
    }
  }

  SweepResult run() {
    std::vector<Index> order(vertices_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [this](Index i, Index j) { return earlier(i, j) || (!earlier(j, i) && i < j); });
    // From here on no two vertices are at the same place.
    for (std::size_t k = 1; k < order.size(); ++k)
      if (point(order[k - 1]) == point(order[k])) {
        found(order[k - 1], order[k]);
        return result_;
      }
    for (const Index v : order)
      if (!pass(v)) break;
    return result_;
  }

 private:
  struct Below {
    using is_transparent = void;
    const Sweep* sweep;
    bool operator()(Index e, Index f) const { return sweep->is_below(e, f); }
    bool operator()(Index e, const Vector2& p) const { return sweep->side(e, p) > 0; }
    bool operator()(const Vector2& p, Index e) const { return sweep->side(e, p) < 0; }
  };
  using Active = std::set<Index, Below>;

  const Vector2& point(Index v) const { return vertices_[v]; }
  bool earlier(Index i, Index j) const {
    const Vector2 &p = point(i), &q = point(j);
    return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
  }
  Index left(Index e) const { return earlier(e, next_[e]) ? e : next_[e]; }
  Index right(Index e) const { return earlier(e, next_[e]) ? next_[e] : e; }
  int side(Index e, const Vector2& p) const {
    return orientation(point(left(e)), point(right(e)), p);
  }
  // Two edges that the sweep line meets at the same time, without a contact to the left of it.
  bool is_below(Index e, Index f) const {
    if (left(e) == left(f)) return side(e, point(right(f))) > 0;
    return earlier(left(e), left(f)) ? side(e, point(left(f))) > 0 : side(f, point(left(e))) < 0;
  }

  // What the edges at a vertex change. False: a contact, or the budget is used up.
  bool pass(Index v) {
    const Index in = before_[v], out = v;
    const bool in_ends = right(in) == v, out_ends = right(out) == v;
    if (in_ends && out_ends) {
      active_.erase(place_[in]);
      const auto above = active_.erase(place_[out]);
      return above == active_.begin() || above == active_.end() || test(*std::prev(above), *above);
    }
    if (in_ends || out_ends) return replace(in_ends ? in : out, in_ends ? out : in);
    return start(v, in, out);
  }

  bool replace(Index ending, Index starting) {
    const auto above = active_.erase(place_[ending]);
    return insert(starting, above);
  }

  bool start(Index v, Index in, Index out) {
    const auto above = active_.lower_bound(point(v));
    if (above != active_.end() && side(*above, point(v)) == 0) return found(*above, out);
    const int turn = side(in, point(right(out)));
    if (turn == 0) return found(in, out);
    const Index lower = turn > 0 ? in : out, upper = turn > 0 ? out : in;
    return insert(lower, above) && insert(upper, above);
  }

  // Between `above` and what lies below it, if it meets neither of them.
  bool insert(Index e, typename Active::iterator above) {
    if (above != active_.end() && !test(e, *above)) return false;
    if (above != active_.begin() && !test(e, *std::prev(above))) return false;
    place_[e] = active_.insert(above, e);
    return true;
  }

  bool test(Index e, Index f) {
    if (!budget_.spend(1)) {
      result_.apart = ProofStatus::Undecided;
      return false;
    }
    ++result_.pairs_tested;
    return meet(e, f) ? found(e, f) : true;
  }

  bool meet(Index e, Index f) const {
    const Index e_end = next_[e], f_end = next_[f];
    // Neighbours: the far end of one on the other.
    if (e_end == f)
      return on_segment(point(e), point(e_end), point(f_end)) ||
             on_segment(point(f), point(f_end), point(e));
    if (f_end == e) return meet(f, e);
    return segments_meet(point(e), point(e_end), point(f), point(f_end));
  }

  bool found(Index e, Index f) {
    result_.apart = ProofStatus::Violated;
    result_.a = e;
    result_.b = f;
    return false;
  }

  std::vector<Vector2> vertices_;
  std::vector<Index> next_, before_;  // before_: the edge that ends at a vertex
  Active active_;                     // edges on the sweep line, upwards
  std::vector<typename Active::iterator> place_;
  SubdivisionBudget& budget_;
  SweepResult result_;
};

}  // namespace

SweepResult sweep_segments(const BoundaryLoops& loops, SubdivisionBudget& budget) {
  return Sweep(loops, budget).run();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
