#include "majorant/parametrization/curve_contact.h"

#include <cmath>
#include <initializer_list>

#include "majorant/parametrization/curve_piece.h"

namespace majorant {
namespace {

using curve_piece::along;
using curve_piece::Direction;
using curve_piece::Interval;
using curve_piece::magnitude;
using curve_piece::Piece;
using curve_piece::Quad;
using curve_piece::split;

// Products of two coordinates must not overflow; the rounding bounds cover everything else.
constexpr double kLargest = 1e150;
// Pairs of pieces looked at before a pair of curves is given up; what is decided at all takes a few
// dozen, curves along each other at a distance d about sqrt(size / d).
constexpr long kWork = 1 << 18;
constexpr long kQuadWork = 1 << 14;  // quadruple precision takes 30 times as long
// Once a place is found that cannot be decided, the rest is searched for a crossing, but not long.
constexpr long kWorkAfterDoubt = 1 << 10;

template <class Real>
struct Limits {
  static constexpr int kDepth = 60;
  static constexpr long kWork = majorant::kWork;
};
template <>
struct Limits<Quad> {
  static constexpr int kDepth = 120;
  static constexpr long kWork = kQuadWork;
};

template <class Real>
Direction<Real> normal(const Direction<Real>& d) {
  return {-d.y, d.x};
}

template <class Real>
Direction<Real> sum(const Direction<Real>& a, const Direction<Real>& b) {
  return {a.x + b.x, a.y + b.y};
}

// About length 1, zero for zero.
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

// `a` stays strictly between the ends of `b`, seen along the chord of `b`, and its own ends lie
// strictly on either side of all of `b`: inside that strip `b` joins the left to the right, `a` the
// top to the bottom of a rectangle.
template <class Real>
bool crosses(const Piece<Real>& a, const Piece<Real>& b) {
  const Direction<Real> chord = b.chord(), up = normal(chord);
  const Interval<Real> extent = along(a, chord);
  if (!before(along(b, chord, 0, 0), extent) ||
      !before(extent, along(b, chord, b.degree, b.degree)))
    return false;
  const Interval<Real> slab = along(b, up);
  const Interval<Real> front = along(a, up, 0, 0), back = along(a, up, a.degree, a.degree);
  return (before(front, slab) && before(slab, back)) || (before(back, slab) && before(slab, front));
}

// Where the chords meet.
template <class Real>
Direction<Real> crossing_place(const Piece<Real>& a, const Piece<Real>& b) {
  const Direction<Real> along_a = a.chord(), up = normal(b.chord());
  const Real rise = up.x * along_a.x + up.y * along_a.y;
  const Real height = up.x * (b.x[0] - a.x[0]) + up.y * (b.y[0] - a.y[0]);
  const Real s = rise == 0 ? Real(0) : height / rise;
  return {a.x[0] + s * along_a.x, a.y[0] + s * along_a.y};
}

// The end of `a` is the start of `b`: strictly on one side of a line through it lie all other
// control points of `a`, on the other side those of `b`.
template <class Real>
bool part_ways(const Piece<Real>& a, const Piece<Real>& b) {
  const Direction<Real> from = unit(a.leg(a.degree, 0)), to = unit(b.leg(0, b.degree));
  // Two choices: perpendicular to the bisector of a small angle, or along that of a large one.
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

// Depth first; ends with the first crossing.
template <class Real>
class Search {
 public:
  explicit Search(const Vector2& origin) : origin_(origin) {}

  void apart(const Piece<Real>& a, const Piece<Real>& b) {
    if (ended() || separated(a, b)) return;
    if (crosses(a, b) || crosses(b, a)) return found(Contact::Certain, crossing_place(a, b));
    const int larger = to_split(a, b);
    if (larger < 0) return found(Contact::Possible, {a.x[0], a.y[0]});
    const auto [first, second] = split(larger == 0 ? a : b);
    if (larger == 0) {
      apart(first, b);
      apart(second, b);
    } else {
      apart(a, first);
      apart(a, second);
    }
  }

  // a's end is b's start.
  void neighbours(const Piece<Real>& a, const Piece<Real>& b) {
    if (ended() || part_ways(a, b)) return;
    const int larger = to_split(a, b);
    if (larger < 0) return found(Contact::Possible, {b.x[0], b.y[0]});
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
    if (!can_split(a)) return found(Contact::Possible, {a.x[0], a.y[0]});
    const auto [first, second] = split(a);
    itself(first);
    itself(second);
    neighbours(first, second);
  }

  // To be called once. Work given up counts as doubt.
  CurveContact result() const { return result_; }

 private:
  bool ended() {
    if (result_.kind == Contact::Certain) return true;
    if (--work_ >= 0) return false;
    if (result_.kind == Contact::None) result_ = {Contact::Possible, origin_};
    return true;
  }
  void found(Contact kind, const Direction<Real>& place) {
    result_ = {kind, origin_ + Vector2(static_cast<double>(place.x), static_cast<double>(place.y))};
    work_ = std::min(work_, kWorkAfterDoubt);
  }
  // Pieces about as small as their errors cannot be told apart any better.
  static bool can_split(const Piece<Real>& a) {
    return a.depth < Limits<Real>::kDepth && a.size() > 4 * a.largest_error();
  }
  // 0: a, 1: b, -1: none.
  static int to_split(const Piece<Real>& a, const Piece<Real>& b) {
    const bool split_a = can_split(a), split_b = can_split(b);
    if (!split_a && !split_b) return -1;
    return split_a && (!split_b || a.size() >= b.size()) ? 0 : 1;
  }

  Vector2 origin_;
  CurveContact result_;
  long work_ = Limits<Real>::kWork;
};

// In double, then in quadruple precision. run(Search&, Real) starts the search.
template <class Run>
CurveContact decide(const Vector2& origin, const Run& run) {
  Search<double> quick(origin);
  run(quick, double());
  if (quick.result().kind != Contact::Possible) return quick.result();
  Search<Quad> search(origin);
  run(search, Quad());
  return search.result();
}

bool in_range(const PlanarCurve& curve) {
  for (int k = 0; k <= curve.degree; ++k) {
    const Vector2& p = curve.control_points[static_cast<std::size_t>(k)];
    if (!(p.cwiseAbs().maxCoeff() < kLargest)) return false;
  }
  return true;
}

// a - b where that is exact: its rounding error, computed exactly [Knu97, 4.2.2 Theorem B], is
// zero.
bool exact_difference(double a, double b, double& difference) {
  difference = a - b;
  const double minus_b = difference - a;
  return (a - (difference - minus_b)) + (-b - minus_b) == 0;
}

// Proves that p lies on a line segment; false also where that takes more than differences that are
// exact in double precision, the products of which are exact in quadruple precision.
bool lies_on(const PlanarCurve& line, const Vector2& p) {
  if (line.degree != 1) return false;
  const Vector2 &a = line.front(), &b = line.back();
  double ux = 0, uy = 0, vx = 0, vy = 0;
  if (!exact_difference(b.x(), a.x(), ux) || !exact_difference(b.y(), a.y(), uy) ||
      !exact_difference(p.x(), a.x(), vx) || !exact_difference(p.y(), a.y(), vy))
    return false;
  const auto within = [](double x, double s, double t) {
    return std::min(s, t) <= x && x <= std::max(s, t);
  };
  return Quad(ux) * Quad(vy) == Quad(uy) * Quad(vx) && within(p.x(), a.x(), b.x()) &&
         within(p.y(), a.y(), b.y());
}

// The point p, an end of one curve, is a point of the other.
bool touches(const PlanarCurve& curve, const Vector2& p) {
  return p == curve.front() || p == curve.back() || lies_on(curve, p);
}

}  // namespace

CurveContact contact_between(const PlanarCurve& a, const PlanarCurve& b) {
  if (!in_range(a) || !in_range(b)) return {Contact::Possible, a.front()};
  for (const Vector2& p : {a.front(), a.back()})
    if (touches(b, p)) return {Contact::Certain, p};
  for (const Vector2& p : {b.front(), b.back()})
    if (touches(a, p)) return {Contact::Certain, p};
  const Vector2& origin = a.front();
  return decide(origin, [&](auto& search, auto real) {
    using Real = decltype(real);
    search.apart(Piece<Real>(a, origin), Piece<Real>(b, origin));
  });
}

CurveContact contact_of_neighbours(const PlanarCurve& a, const PlanarCurve& b) {
  if (!in_range(a) || !in_range(b)) return {Contact::Possible, a.back()};
  if (touches(b, a.front())) return {Contact::Certain, a.front()};
  if (touches(a, b.back())) return {Contact::Certain, b.back()};
  const Vector2& origin = a.back();
  return decide(origin, [&](auto& search, auto real) {
    using Real = decltype(real);
    search.neighbours(Piece<Real>(a, origin), Piece<Real>(b, origin));
  });
}

CurveContact contact_with_itself(const PlanarCurve& a) {
  if (!in_range(a)) return {Contact::Possible, a.front()};
  if (a.front() == a.back()) return {Contact::Certain, a.front()};
  const Vector2& origin = a.front();
  return decide(origin, [&](auto& search, auto real) {
    using Real = decltype(real);
    search.itself(Piece<Real>(a, origin));
  });
}

}  // namespace majorant
