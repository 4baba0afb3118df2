#include "majorant/certify/internal/curve_contact.h"

#include <cmath>
#include <initializer_list>
#include <utility>

#include "majorant/certify/internal/curve_graph.h"
#include "majorant/certify/internal/curve_piece.h"
#include "majorant/mesh/exact_predicates.h"

namespace majorant {
namespace {

using curve_piece::along;
using curve_piece::Direction;
using curve_piece::Graph;
using curve_piece::Heights;
using curve_piece::Interval;
using curve_piece::Piece;
using curve_piece::split;

// Steps of the search for a crossing after a place was found that cannot be decided. Chosen, not
// tuned.
constexpr long kStepsAfterDoubt = 1 << 6;

// kSteps: pairs of pieces after which a pair of curves is given up. kCost: the cost of a step in
// the budget, by time. Decidable pairs take a few dozen steps; curves along each other at 1e-12 of
// their size take 20 to 300 (degrees 2 and 8).
template <class Real>
struct Limits {
  static constexpr long kSteps = 1 << 12, kCost = 1;
};
template <>
struct Limits<Float128> {
  static constexpr long kSteps = 1 << 8, kCost = 64;
};

template <class Real>
Direction<Real> normal(const Direction<Real>& d) {
  return {-d.y, d.x};
}

template <class Real>
Direction<Real> sum(const Direction<Real>& a, const Direction<Real>& b) {
  return {a.x + b.x, a.y + b.y};
}

// Returns a vector of length about 1; zero for zero.
template <class Real>
Direction<Real> unit(const Direction<Real>& d) {
  const double length = std::hypot(static_cast<double>(d.x), static_cast<double>(d.y));
  if (!(length > 0)) return {0, 0};
  return {d.x / Real(length), d.y / Real(length)};
}

template <class Real>
bool before(const Interval<Real>& a, const Interval<Real>& b) {
  return a.high < b.low;
}

template <class Real>
bool separated(const Piece<Real>& a, const Piece<Real>& b) {
  const Direction<Real> of_a = a.chord(), of_b = b.chord();
  for (const Direction<Real>& axis :
       {Direction<Real>{1, 0}, Direction<Real>{0, 1}, normal(of_a), normal(of_b), of_a, of_b}) {
    const Interval<Real> on_a = along(a, axis), on_b = along(b, axis);
    if (before(on_a, on_b) || before(on_b, on_a)) return true;
  }
  return false;
}

// Returns whether the curves cross, seen along these axes. In x, `a` stays strictly between the
// ends of `b`. In y, the ends of `a` lie strictly on either side of all of `b`. Then `b` joins the
// left and right sides of a rectangle, and `a` its top and bottom.
template <class Real>
bool crosses(const Heights<Real>& a, const Heights<Real>& b) {
  const bool between = (before(b.front_x, a.x) && before(a.x, b.back_x)) ||
                       (before(b.back_x, a.x) && before(a.x, b.front_x));
  return between && ((before(a.front, b.all) && before(b.all, a.back)) ||
                     (before(a.back, b.all) && before(b.all, a.front)));
}

// Returns whether they cross, seen along the chord of `b`.
template <class Real>
bool crosses_straight(const Piece<Real>& a, const Piece<Real>& b) {
  const Direction<Real> chord = b.chord(), up = normal(chord);
  const auto seen = [&](const Piece<Real>& p) {
    return Heights<Real>{
        along(p, chord), along(p, chord, 0, 0), along(p, chord, p.degree, p.degree),
        along(p, up),    along(p, up, 0, 0),    along(p, up, p.degree, p.degree)};
  };
  return crosses(seen(a), seen(b));
}

// Returns whether they cross, seen along a graph that follows `b`, without the ends of `a`. Pieces
// of curves that run along each other often end at the same place.
template <class Real>
bool crosses_curved(const Piece<Real>& a, const Piece<Real>& b) {
  // Chosen, not tuned.
  constexpr double kFirst = 1.0 / 16, kLast = 15.0 / 16;
  const Graph<Real> graph = curve_piece::graph_between(b, b);
  const Heights<Real> of_b = heights(b, graph), of_a = heights(a, graph);
  if (!(before(of_a.front, of_b.all) && before(of_b.all, of_a.back)) &&
      !(before(of_a.back, of_b.all) && before(of_b.all, of_a.front)))
    return false;
  const Piece<Real> middle = split(split(a, kFirst).second, kLast).first;
  return crosses(heights(middle, graph), of_b);
}

enum class Relation { Apart, Crossing, Unknown };

// A graph costs as much as a few dozen axes. It pays off for flat pieces of similar size with the
// same or opposite directions.
template <class Real>
bool may_be_graphs(const Piece<Real>& a, const Piece<Real>& b) {
  // Chosen, not tuned; all decisions are proofs.
  constexpr double kFlat = 0.5, kLike = 8, kSlope = 0.25;
  const Direction<Real> u = a.chord(), v = b.chord();
  if (magnitude(u.x * v.y - u.y * v.x) > Real(kSlope) * magnitude(u.x * v.x + u.y * v.y))
    return false;
  const auto flat = [](const Piece<Real>& p) {
    const Direction<Real> chord = p.chord();
    const Interval<Real> slab = along(p, normal(chord));
    return slab.high - slab.low < Real(kFlat) * (chord.x * chord.x + chord.y * chord.y);
  };
  const Real of_a = a.size(), of_b = b.size();
  return of_a < kLike * of_b && of_b < kLike * of_a && flat(a) && flat(b);
}

template <class Real>
bool changes_side(const Heights<Real>& p) {
  return (p.front.high < 0 && p.back.low > 0) || (p.back.high < 0 && p.front.low > 0);
}

template <class Real>
Relation relation(const Piece<Real>& a, const Piece<Real>& b) {
  if (separated(a, b)) return Relation::Apart;
  if (crosses_straight(a, b) || crosses_straight(b, a)) return Relation::Crossing;
  if (!may_be_graphs(a, b)) return Relation::Unknown;
  const Graph<Real> graph = curve_piece::graph_between(a, b);
  const Heights<Real> of_a = heights(a, graph), of_b = heights(b, graph);
  if (before(of_a.all, of_b.all) || before(of_b.all, of_a.all)) return Relation::Apart;
  const bool crossing =
      (changes_side(of_a) && crosses_curved(a, b)) || (changes_side(of_b) && crosses_curved(b, a));
  return crossing ? Relation::Crossing : Relation::Unknown;
}

// Finds an approximate place where two pieces that cross do so, to within `size`. Returns false
// once `work` is used up.
template <class Real>
bool find_crossing(const Piece<Real>& a, const Piece<Real>& b, Real size, int& work,
                   Direction<Real>& place) {
  if (--work < 0 || separated(a, b)) return false;
  if (a.size() < size && b.size() < size) {
    place = {a.x[0], a.y[0]};
    return true;
  }
  const bool of_a = a.size() >= b.size();
  const auto [first, second] = split(of_a ? a : b);
  return find_crossing(first, of_a ? b : a, size, work, place) ||
         find_crossing(second, of_a ? b : a, size, work, place);
}

template <class Real>
Direction<Real> crossing_place(const Piece<Real>& a, const Piece<Real>& b) {
  constexpr double kRelativeSize = 1e-7;  // the places are for messages
  int work = 1000;
  Direction<Real> place{a.x[0], a.y[0]};
  find_crossing(a, b, Real(kRelativeSize) * std::max(a.size(), b.size()), work, place);
  return place;
}

// The end of `a` is the start of `b`. Tests whether a line through this point separates all other
// control points of `a` from those of `b`, strictly.
template <class Real>
bool part_ways(const Piece<Real>& a, const Piece<Real>& b) {
  const Direction<Real> from = unit(a.leg(a.degree, 0)), to = unit(b.leg(0, b.degree));
  // Two lines are tried: perpendicular to the bisector of a small angle, or along that of a large
  // one.
  const Direction<Real> bisector = normal(sum(from, to)), across{to.x - from.x, to.y - from.y};
  const bool left = from.x * to.y - from.y * to.x > 0;
  const Direction<Real> beside = left ? bisector : Direction<Real>{-bisector.x, -bisector.y};
  for (const Direction<Real>& axis : {across, beside})
    if (along(a, axis, 0, a.degree - 1, a.degree).high < 0 &&
        along(b, axis, 1, b.degree, 0).low > 0)
      return true;
  return false;
}

template <class Real>
bool advances(const Piece<Real>& a) {
  const Direction<Real> chord = a.chord();
  for (int k = 0; k < a.degree; ++k)
    if (!(along(a, chord, k + 1, k + 1, k).low > 0)) return false;
  return true;
}

// Searches depth first and ends with the first crossing.
template <class Real>
class Search {
 public:
  Search(const Vector2& origin, SubdivisionBudget& budget) : origin_(origin), budget_(budget) {}

  void apart(const Piece<Real>& a, const Piece<Real>& b) {
    if (ended()) return;
    const Relation known = relation(a, b);
    if (known == Relation::Apart) return;
    if (known == Relation::Crossing) return found(ProofStatus::Violated, crossing_place(a, b));
    const int larger = to_split(a, b);
    if (larger < 0) return found(ProofStatus::Undecided, {a.x[0], a.y[0]});
    const auto [first, second] = split(larger == 0 ? a : b);
    if (larger == 0) {
      apart(first, b);
      apart(second, b);
    } else {
      apart(a, first);
      apart(a, second);
    }
  }

  // Requires that a's end is b's start.
  void neighbours(const Piece<Real>& a, const Piece<Real>& b) {
    if (ended() || part_ways(a, b)) return;
    const int larger = to_split(a, b);
    if (larger < 0) return found(ProofStatus::Undecided, {b.x[0], b.y[0]});
    const auto [first, second] = split(larger == 0 ? a : b);
    if (larger == 0) {
      apart(first, b);
      neighbours(second, b);
    } else {
      apart(a, second);
      neighbours(a, first);
    }
  }

  void itself(const Piece<Real>& a) {
    if (ended() || advances(a)) return;
    if (!can_split(a)) return found(ProofStatus::Undecided, {a.x[0], a.y[0]});
    const auto [first, second] = split(a);
    itself(first);
    itself(second);
    neighbours(first, second);
  }

  // Call this once. Unfinished work counts as undecided.
  CurveContact result() const { return result_; }

 private:
  bool ended() {
    if (result_.apart == ProofStatus::Violated) return true;
    if (--steps_ >= 0 && budget_.spend(Limits<Real>::kCost)) return false;
    if (result_.apart == ProofStatus::Proven) result_ = {ProofStatus::Undecided, origin_};
    return true;
  }
  void found(ProofStatus kind, const Direction<Real>& place) {
    result_ = {kind, origin_ + Vector2(static_cast<double>(place.x), static_cast<double>(place.y))};
    steps_ = std::min(steps_, kStepsAfterDoubt);
  }
  // Pieces as small as their errors are not split further.
  static bool can_split(const Piece<Real>& a) {
    return a.depth < Piece<Real>::kDeepest && a.size() > 4 * a.largest_error();
  }
  // Returns the piece to split: 0 for a, 1 for b, -1 for none.
  static int to_split(const Piece<Real>& a, const Piece<Real>& b) {
    const bool split_a = can_split(a), split_b = can_split(b);
    if (!split_a && !split_b) return -1;
    return split_a && (!split_b || a.size() >= b.size()) ? 0 : 1;
  }

  Vector2 origin_;
  SubdivisionBudget& budget_;
  CurveContact result_;
  long steps_ = Limits<Real>::kSteps;
};

// Decides in double, then in quadruple precision. run(Search&, Real) starts the search.
template <class Run>
CurveContact decide(const Vector2& origin, SubdivisionBudget& budget, const Run& run) {
  Search<double> quick(origin, budget);
  run(quick, double());
  if (quick.result().apart != ProofStatus::Undecided || budget.stopped()) return quick.result();
  Search<Float128> search(origin, budget);
  run(search, Float128());
  return search.result();
}

// Returns whether p, an end of one curve, is a point of the other.
bool touches(const PlanarCurve& curve, const Vector2& p) {
  if (curve.degree == 1) return on_segment(curve.front(), curve.back(), p);
  return p == curve.front() || p == curve.back();
}

// Returns the contact of two segments if no end of one lies on the other.
CurveContact contact_of_lines(const PlanarCurve& a, const PlanarCurve& b) {
  if (!segments_meet(a.front(), a.back(), b.front(), b.back())) return {};
  const Vector2 u = a.back() - a.front(), v = b.back() - b.front(), w = b.front() - a.front();
  const double t = cross(w, v) / cross(u, v);
  return {ProofStatus::Violated, a.front() + (t > 0 && t < 1 ? t : 0.5) * u};
}

SubdivisionBudget unlimited() { return SubdivisionBudget(std::numeric_limits<long>::max()); }

}  // namespace

bool SubdivisionBudget::spend(long subdivisions) {
  constexpr long kUnasked = 32;  // subdivisions between two calls of `stopped`, a few dozen
                                 // microseconds
  if (state_ == State::Open && subdivisions > limit_ - spent_) state_ = State::UsedUp;
  if (state_ != State::Open) return false;
  spent_ += subdivisions;
  unasked_ += subdivisions;
  return unasked_ < kUnasked || !stopped();
}

bool SubdivisionBudget::stopped() {
  unasked_ = 0;
  if (state_ == State::Open && stopped_ && stopped_()) state_ = State::Stopped;
  return state_ == State::Stopped;
}

CurveContact contact_between(const PlanarCurve& a, const PlanarCurve& b,
                             SubdivisionBudget& budget) {
  if (!a.in_range() || !b.in_range()) return {ProofStatus::Undecided, a.front()};
  for (const Vector2& p : {a.front(), a.back()})
    if (touches(b, p)) return {ProofStatus::Violated, p};
  for (const Vector2& p : {b.front(), b.back()})
    if (touches(a, p)) return {ProofStatus::Violated, p};
  if (a.degree == 1 && b.degree == 1) return contact_of_lines(a, b);
  const Vector2& origin = a.front();
  return decide(origin, budget, [&](auto& search, auto real) {
    using Real = decltype(real);
    search.apart(Piece<Real>(a, origin), Piece<Real>(b, origin));
  });
}

CurveContact contact_of_neighbours(const PlanarCurve& a, const PlanarCurve& b,
                                   SubdivisionBudget& budget) {
  if (!a.in_range() || !b.in_range()) return {ProofStatus::Undecided, a.back()};
  if (touches(b, a.front())) return {ProofStatus::Violated, a.front()};
  if (touches(a, b.back())) return {ProofStatus::Violated, b.back()};
  // Lines with more in common than an end lie on one line; then an end of one lies on the other.
  if (a.degree == 1 && b.degree == 1) return {};
  const Vector2& origin = a.back();
  return decide(origin, budget, [&](auto& search, auto real) {
    using Real = decltype(real);
    search.neighbours(Piece<Real>(a, origin), Piece<Real>(b, origin));
  });
}

CurveContact contact_with_itself(const PlanarCurve& a, SubdivisionBudget& budget) {
  if (!a.in_range()) return {ProofStatus::Undecided, a.front()};
  if (a.front() == a.back()) return {ProofStatus::Violated, a.front()};
  if (a.degree == 1) return {};
  const Vector2& origin = a.front();
  return decide(origin, budget, [&](auto& search, auto real) {
    using Real = decltype(real);
    search.itself(Piece<Real>(a, origin));
  });
}

CurveContact contact_between(const PlanarCurve& a, const PlanarCurve& b) {
  SubdivisionBudget budget = unlimited();
  return contact_between(a, b, budget);
}

CurveContact contact_of_neighbours(const PlanarCurve& a, const PlanarCurve& b) {
  SubdivisionBudget budget = unlimited();
  return contact_of_neighbours(a, b, budget);
}

CurveContact contact_with_itself(const PlanarCurve& a) {
  SubdivisionBudget budget = unlimited();
  return contact_with_itself(a, budget);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
