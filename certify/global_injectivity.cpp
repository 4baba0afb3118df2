#include "majorant/certify/global_injectivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/internal/curve_contact.h"
#include "majorant/certify/loop_winding.h"
#include "majorant/framework/rounding.h"
#include "majorant/mesh/box_tree.h"
#include "majorant/mesh/exact_predicates.h"

namespace majorant {
namespace {

// Decides whether polygons are simple and disjoint, by a sweep in exact arithmetic, O(n log n) for
// any shape (Shamos and Hoey, [SH76]). Curves are compared pair by pair instead.
//
//   SubdivisionBudget budget(1000000);
//   const SweepResult swept = sweep_segments(boundary_loops(map), budget);
//   if (swept.apart == ProofStatus::Proven) ...  // no two edges meet but in their vertex

struct SweepResult {
  // Proven: no edges meet. Violated: edges a and b meet, exactly; other pairs may, too. Undecided:
  // the budget, of which each pair takes one, ended.
  ProofStatus apart = ProofStatus::Proven;
  Index a = -1, b = -1;
  long pairs_tested = 0;
};

// The sweep line passes the vertices in lexicographic order, as if it were tilted slightly. Edge k
// runs from vertex k to vertex next[k].
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
    // After this no two vertices are at the same place.
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
  // Compares two edges that the sweep line crosses at the same time, if they do not meet to the
  // left of it.
  bool is_below(Index e, Index f) const {
    if (left(e) == left(f)) return side(e, point(right(f))) > 0;
    return earlier(left(e), left(f)) ? side(e, point(left(f))) > 0 : side(f, point(left(e))) < 0;
  }

  // Updates the sweep line at a vertex. Returns false at a contact, or if the budget is used up.
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

  // Inserts an edge below `above`, if it meets neither of its new neighbours.
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
    // For neighbours in a loop: tests whether the far end of one lies on the other.
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

// Requires loops without defect() whose curves all have degree 1.
SweepResult sweep_segments(const BoundaryLoops& loops, SubdivisionBudget& budget) {
  return Sweep(loops, budget).run();
}

constexpr long kMaxPairsLeft = 1000000;  // counting so many takes milliseconds

// ---- Contacts ----

class Contacts {
 public:
  Contacts(const BoundaryLoops& boundary, SubdivisionBudget& budget, GlobalInjectivity& out)
      : boundary_(boundary), next_(boundary.next()), budget_(budget), out_(out) {}

  void find() {
    const bool polygons = std::all_of(boundary_.curves.begin(), boundary_.curves.end(),
                                      [](const PlanarCurve& c) { return c.degree == 1; });
    if (!polygons || !are_simple_polygons()) compare_curves();
    std::stable_partition(out_.contacts.begin(), out_.contacts.end(), [](const BoundaryContact& c) {
      return c.apart == ProofStatus::Violated;
    });
  }

 private:
  // The sweep finds one contact; there may be others.
  bool are_simple_polygons() {
    const SweepResult swept = sweep_segments(boundary_, budget_);
    out_.pairs_tested += swept.pairs_tested;
    if (swept.apart == ProofStatus::Violated) found(swept.a, swept.b, contact(swept.a, swept.b));
    return swept.apart == ProofStatus::Proven;
  }

  void compare_curves() {
    std::vector<Box2> boxes;
    for (std::size_t k = 0; k < boundary_.curves.size(); ++k) {
      const auto curve = static_cast<Index>(k);
      found(curve, curve, contact_with_itself(boundary_.curves[k], budget_));
      if (has_enough()) return;
      boxes.push_back(box_of(boundary_.curves[k]));
    }
    BoxTree(std::move(boxes)).visit_pairs([this](Index i, Index j) { return test(i, j); });
  }

  // Returns false once enough contacts were found, or enough untested pairs were counted.
  bool test(Index i, Index j) {
    if (!budget_.spend(1)) return ++out_.pairs_left < kMaxPairsLeft;
    ++out_.pairs_tested;
    found(i, j, contact(i, j));
    return !has_enough();
  }

  // Undecided contacts are not enough: the search continues until one is certain.
  bool has_enough() const { return certain_ > 0 && out_.contacts.size() >= kMaxContacts; }

  CurveContact contact(Index i, Index j) {
    const PlanarCurve &a = boundary_.curves[i], &b = boundary_.curves[j];
    if (next_[i] == j) return contact_of_neighbours(a, b, budget_);
    if (next_[j] == i) return contact_of_neighbours(b, a, budget_);
    return contact_between(a, b, budget_);
  }

  void found(Index i, Index j, const CurveContact& contact) {
    if (contact.apart == ProofStatus::Proven) return;
    const auto [a, b] = std::minmax(boundary_.half_edge[i], boundary_.half_edge[j]);
    const auto is_this = [a = a, b = b](const BoundaryContact& c) {
      return c.half_edge_a == a && c.half_edge_b == b;
    };
    const bool certain = contact.apart == ProofStatus::Violated;
    if (!certain && out_.contacts.size() >= kMaxContacts) return;
    if (std::any_of(out_.contacts.begin(), out_.contacts.end(), is_this)) return;
    certain_ += certain;
    out_.contacts.push_back({a, b, contact.where, contact.apart});
  }

  const BoundaryLoops& boundary_;
  const std::vector<Index> next_;
  SubdivisionBudget& budget_;
  GlobalInjectivity& out_;
  int certain_ = 0;
};

// ---- Orientation and nesting ----

const Finding kStopped{ProofStatus::Undecided, "stopped before it was decided"};

struct DoubleCover {
  Vector2 where;
  long times;
};

const PlanarCurve& curve_of(const BoundaryLoops& boundary, Index half_edge) {
  const auto edge = std::find(boundary.half_edge.begin(), boundary.half_edge.end(), half_edge);
  return boundary.curves[static_cast<std::size_t>(edge - boundary.half_edge.begin())];
}

// Returns directions from a contact in which a point that is covered twice may lie. Where two edges
// cross it lies to the left of both.
std::vector<Vector2> directions_at(const PlanarCurve& a, const PlanarCurve& b) {
  // Several are tried, since edges may bend between the contact and their ends. Chosen, not tuned.
  constexpr int kDirections = 6;
  const auto to_the_left = [](const PlanarCurve& curve) {
    const Vector2 along = (curve.back() - curve.front()).stableNormalized();
    return Vector2(-along.y(), along.x());
  };
  std::vector<Vector2> directions{(to_the_left(a) + to_the_left(b)).stableNormalized()};
  for (int d = 0; d < kDirections; ++d) {
    const double angle = 0.3 + 2 * std::numbers::pi * d / kDirections;
    directions.emplace_back(std::cos(angle), std::sin(angle));
  }
  return directions;
}

// Returns a point near a contact that is covered several times. It proves overlaps that pairs of
// curves do not show, such as boundaries that cross at vertices, and tells overlaps from boundaries
// that only touch.
std::optional<DoubleCover> find_double_cover(const BoundaryLoops& boundary,
                                             const std::vector<BoundaryContact>& contacts,
                                             SubdivisionBudget& budget) {
  // Contacts that are tried; a few suffice. Chosen, not tuned.
  constexpr std::size_t kPlaces = 8;
  const LoopWinding winding(boundary);
  const auto all = [](const BoundaryLoop&) { return true; };
  for (std::size_t k = 0; k < std::min(kPlaces, contacts.size()); ++k) {
    const PlanarCurve& curve = curve_of(boundary, contacts[k].half_edge_a);
    const auto directions = directions_at(curve, curve_of(boundary, contacts[k].half_edge_b));
    const double size = (curve.back() - curve.front()).norm();
    // Distances relative to the size of the edge.
    for (const double relative : {0x1p-3, 0x1p-8, 0x1p-16, 0x1p-32, 0x1p-42})
      for (const Vector2& direction : directions) {
        if (budget.stopped()) return {};
        const Vector2 p = contacts[k].where + relative * size * direction;
        const std::optional<long> times = winding.around(p, all);
        if (times && *times > 1) return DoubleCover{p, *times};
      }
  }
  return {};
}

// Finds the one counterclockwise loop of every chart.
Finding find_outer_loops(const BoundaryLoops& boundary, SubdivisionBudget& budget,
                         std::vector<const BoundaryLoop*>& outer) {
  outer.assign(to_size(boundary.charts), nullptr);
  for (const BoundaryLoop& loop : boundary.loops) {
    if (budget.stopped()) return kStopped;
    const int sense = sense_of(boundary, loop);
    if (sense == 0)
      return {ProofStatus::Undecided, "a boundary loop encloses too little area to tell its sense"};
    if (sense < 0) continue;
    if (outer[loop.chart])
      return {ProofStatus::Violated, "two boundary loops of one component are counterclockwise"};
    outer[loop.chart] = &loop;
  }
  if (std::count(outer.begin(), outer.end(), nullptr) > 0)
    return {ProofStatus::Violated, "a component has no counterclockwise boundary loop"};
  return {ProofStatus::Proven, ""};
}

// The loops must be simple and disjoint.
Finding check_nesting(const BoundaryLoops& boundary, SubdivisionBudget& budget) {
  std::vector<const BoundaryLoop*> outer;
  const Finding finding = find_outer_loops(boundary, budget, outer);
  if (finding.answer != ProofStatus::Proven || boundary.loops.size() == 1) return finding;
  const LoopWinding winding(boundary);
  for (const BoundaryLoop& loop : boundary.loops) {
    if (budget.stopped()) return kStopped;
    const Vector2& p = boundary.curves[loop.first].front();
    const BoundaryLoop* const own = outer[loop.chart];
    const bool is_outer = own == &loop;
    const std::optional<long> windings = winding.around(p, [&](const BoundaryLoop& other) {
      return is_outer ? other.chart != loop.chart : &other == own;
    });
    if (windings && *windings == (is_outer ? 0 : 1)) continue;
    const std::string place = fmt::format("near ({:.9g}, {:.9g})", p.x(), p.y());
    if (!windings)
      return {ProofStatus::Undecided,
              "which boundary loop is inside of which is not clear " + place};
    return {ProofStatus::Violated, is_outer ? "one component lies inside another, " + place
                                            : "a component is turned over, " + place};
  }
  return finding;
}

std::string unfinished(const GlobalInjectivity& proof, const SubdivisionBudget& budget) {
  const std::string why =
      budget.was_stopped()
          ? "stopped"
          : fmt::format("the budget of {} subdivisions is used up", budget.limit());
  const std::string left = proof.pairs_left < kMaxPairsLeft
                               ? fmt::format("{}", proof.pairs_left)
                               : fmt::format("more than {}", kMaxPairsLeft - 1);
  return fmt::format("{}; {} pairs of boundary edges are not compared", why, left);
}

// Returns the finding from the contacts and the open pairs.
Finding conclude(const BoundaryLoops& boundary, GlobalInjectivity& proof,
                 SubdivisionBudget& budget) {
  const bool is_certain =
      !proof.contacts.empty() && proof.contacts.front().apart == ProofStatus::Violated;
  const bool finished = !budget.stopped() && !budget.used_up();
  if (finished && proof.contacts.empty()) return check_nesting(boundary, budget);
  if (!budget.was_stopped())
    if (const auto cover = find_double_cover(boundary, proof.contacts, budget)) {
      proof.covered_twice = cover->where;
      if (!is_certain)
        return {ProofStatus::Violated,
                fmt::format("({:.9g}, {:.9g}) is covered {} times", cover->where.x(),
                            cover->where.y(), cover->times)};
    }
  if (is_certain) return {ProofStatus::Violated, ""};
  if (!finished) return {ProofStatus::Undecided, unfinished(proof, budget)};
  return budget.was_stopped() ? kStopped : Finding{ProofStatus::Undecided, ""};
}

}  // namespace

GlobalInjectivity check_layout(const BoundaryLoops& boundary, const InjectivityOptions& options) {
  // The subdivisions that a proof may take, about a second. Maps of real models take 2 to 4 an edge
  // (global_injectivity.h).
  constexpr long kSubdivisions = 1 << 18, kPerEdge = 64;
  GlobalInjectivity out;
  out.reason = boundary.defect();
  if (!out.reason.empty()) return out;
  SubdivisionBudget budget(
      options.max_subdivisions.value_or(kSubdivisions +
                                        kPerEdge * static_cast<long>(boundary.curves.size())),
      options.stopped);
  Contacts(boundary, budget, out).find();
  const Finding finding = conclude(boundary, out, budget);
  out.result = finding.answer;
  out.reason = finding.detail;
  out.subdivisions = budget.spent();
  return out;
}

namespace {

// Layouts with a coordinate above 2^400 are scaled to a size near 1. Products of two coordinates
// then stay within the range of doubles, 2^1024.
constexpr int kLargeExponent = 400;

// Returns a power of two by which division loses no digit; 1 if scaling is not needed or not
// possible.
double unit_of(VecIn x) {
  const double largest = x.size() == 0 ? 0 : x.cwiseAbs().maxCoeff();
  if (!std::isfinite(largest) || std::ilogb(largest) <= kLargeExponent) return 1;
  const double unit = power_of_two(largest);
  return Vec(unit * Vec(x / unit)) == x ? unit : 1;
}

}  // namespace

GlobalInjectivity check_boundary(const BezierMap& map, const InjectivityOptions& options) {
  const double unit = unit_of(map.control_points());
  if (unit == 1) return check_layout(boundary_loops(map), options);
  const BezierMap near_one = map.with(map.shared_space(), Vec(map.control_points() / unit));
  GlobalInjectivity proof = check_layout(boundary_loops(near_one), options);
  for (BoundaryContact& contact : proof.contacts) contact.where *= unit;
  if (proof.covered_twice) *proof.covered_twice *= unit;
  return proof;
}

std::string meeting_words(const GlobalInjectivity& proof) {
  const auto near = [](const Vector2& uv) {
    return fmt::format("near ({:.6g}, {:.6g})", uv.x(), uv.y());
  };
  if (proof.covered_twice) return "overlaps itself " + near(*proof.covered_twice);
  if (proof.contacts.empty()) return "overlaps itself: " + proof.reason;
  return "touches or overlaps itself " + near(proof.contacts.front().where);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
