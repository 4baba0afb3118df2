#include "majorant/certify/proven_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/certify/internal/curve_piece.h"
#include "majorant/certify/loop_winding.h"
#include "majorant/certify/moved_layout.h"
#include "majorant/mesh/exact_predicates.h"

namespace majorant {
namespace {

using curve_piece::Piece;

// Bounds are refined to this part of the distance, which is the accuracy that the header promises.
constexpr double kTight = 0.999;
// The largest number of pieces of a pair of curves. Curves at a distance take some dozens. Pairs
// that take more run along each other within the rounding of their coordinates.
constexpr int kMaxCurvePieces = 1 << 14;
// The largest number of halvings of a pair of curves: 53 times both, after which only rounding is
// left. Curves that cross would be halved at the crossing for ever.
constexpr int kMaxHalvings = 106;
// The rounding error of the distance of a point and a segment, as a multiple of their size. It is
// the sum of four differences and their cross product (6 units), a division and a root (3), and a
// wrong end of the perpendicular (its squared error). The value has a safety factor of three.
constexpr double kRoundings = 32 * kUnitRoundoff<double>;

struct Segment {
  Vector2 from, to;
};

// Returns an approximate distance; `scale` collects the size to which rounding is relative.
double distance_to(const Segment& s, const Vector2& p, double& scale) {
  const Vector2 along = s.to - s.from, to_p = p - s.from;
  const double length = along.norm(), t = along.dot(to_p);
  scale = std::max(scale, length + to_p.norm());
  if (t <= 0) return to_p.norm();
  if (t >= length * length) return (p - s.to).norm();
  return std::abs(cross(along, to_p)) / length;
}

// Returns a lower bound of the distance of the segments.
double distance_below(const Segment& a, const Segment& b) {
  if (segments_meet(a.from, a.to, b.from, b.to)) return 0;
  double scale = 0;
  const double least = std::min({distance_to(a, b.from, scale), distance_to(a, b.to, scale),
                                 distance_to(b, a.from, scale), distance_to(b, a.to, scale)});
  return std::max(0.0, least - kRoundings * scale);
}

Vector2 point(const Piece<double>& p, int k) { return {p.x[k], p.y[k]}; }

Segment chord(const Piece<double>& p) { return {point(p, 0), point(p, p.degree)}; }

// Returns a bound on the distance of the piece from its chord, from its control points.
double reach_of(const Piece<double>& p) {
  double reach = 0, scale = 0;
  for (int k = 1; k < p.degree; ++k)
    reach = std::max(reach, distance_to(chord(p), point(p, k), scale));
  return reach + kRoundings * scale + 2 * p.largest_error();
}

// A lower bound of the least distance of all compared pairs of curves.
class LeastDistance {
 public:
  explicit LeastDistance(double at_least) : least_(at_least) {}

  double value() const { return least_; }
  void none() { least_ = 0; }

  void compare(const PlanarCurve& a, const PlanarCurve& b) {
    pieces_ = 0;
    compare({a, a.front()}, {b, a.front()}, 0);
  }

 private:
  void compare(const Piece<double>& p, const Piece<double>& q, int halvings) {
    const double reach_p = reach_of(p), reach_q = reach_of(q);
    const Segment a = chord(p), b = chord(q);
    const double lower = (distance_below(a, b) - (reach_p + reach_q)) * (1 - kRoundings);
    if (lower >= least_) return;
    const double upper = std::min({(a.from - b.from).norm(), (a.from - b.to).norm(),
                                   (a.to - b.from).norm(), (a.to - b.to).norm()});
    const bool straight = p.degree == 1 && q.degree == 1;
    if (straight || lower >= kTight * upper || ++pieces_ > kMaxCurvePieces ||
        halvings == kMaxHalvings) {
      least_ = std::max(0.0, lower);
      return;
    }
    const bool first = q.degree == 1 || (p.degree > 1 && reach_p >= reach_q);
    const auto [left, right] = curve_piece::split(first ? p : q);
    for (const Piece<double>* half : {&left, &right})
      if (least_ > 0) first ? compare(*half, q, halvings + 1) : compare(p, *half, halvings + 1);
  }

  double least_;
  int pieces_ = 0;
};

Box2 grown(Box2 box, double by) {
  const double margin =
      by + kRoundings * (by + box.low.cwiseAbs().maxCoeff() + box.high.cwiseAbs().maxCoeff());
  return {box.low.array() - margin, box.high.array() + margin};
}

// All loops of all charts, scaled so that nothing overflows, with a search structure.
class Layout {
 public:
  Layout(const std::vector<BezierMap>& charts, double unit, const std::vector<char>& fixed)
      : fixed_(fixed), trees_(charts.size()) {
    loops_.charts = static_cast<Index>(charts.size());
    for (std::size_t k = 0; k < charts.size(); ++k) {
      first_.push_back(static_cast<Index>(loops_.curves.size()));
      append(boundary_loops(charts[k]), static_cast<Index>(k), unit);
    }
    first_.push_back(static_cast<Index>(loops_.curves.size()));
  }

  double least_distance(double at_least, const StopCheck& stop) {
    LeastDistance least(at_least);
    std::vector<Box2> boxes;
    for (const Box2& box : boxes_) boxes.push_back(grown(box, at_least / 2));
    std::size_t pairs = 0;
    BoxTree(std::move(boxes)).visit_pairs([&](Index a, Index b) {
      stop.poll_at(pairs++ * 64);
      if (!both_fixed(a, b)) compare(a, b, at_least, least, stop);
      return least.value() > 0;
    });
    if (least.value() > 0 && any_inside(stop)) least.none();
    return least.value();
  }

 private:
  void append(const BoundaryLoops& boundary, Index chart, double unit) {
    Box2 box = box_of(boundary.curves.front());
    for (PlanarCurve curve : boundary.curves) {
      const Box2 of_curve = box_of(curve);
      box.low = box.low.cwiseMin(of_curve.low);
      box.high = box.high.cwiseMax(of_curve.high);
    }
    boxes_.push_back({box.low / unit, box.high / unit});
    for (const BoundaryLoop& loop : boundary.loops) {
      std::vector<PlanarCurve> curves(boundary.curves.begin() + loop.first,
                                      boundary.curves.begin() + loop.last);
      for (PlanarCurve& curve : curves)
        for (int k = 0; k <= curve.degree; ++k) curve.control_points[k] /= unit;
      loops_.add_loop(chart, curves, std::vector<Index>(curves.size(), 0));
    }
  }

  bool both_fixed(Index a, Index b) const { return !fixed_.empty() && fixed_[a] && fixed_[b]; }
  Index curve_count(Index chart) const { return first_[chart + 1] - first_[chart]; }

  const BoxTree<2>& tree(Index chart) {
    std::optional<BoxTree<2>>& known = trees_[chart];
    if (!known) {
      std::vector<Box2> boxes;
      for (Index k = first_[chart]; k < first_[chart + 1]; ++k)
        boxes.push_back(box_of(loops_.curves[k]));
      known.emplace(std::move(boxes));
    }
    return *known;
  }

  void compare(Index a, Index b, double at_least, LeastDistance& least, const StopCheck& stop) {
    if (curve_count(a) > curve_count(b)) std::swap(a, b);
    for (Index k = first_[a]; k < first_[a + 1] && least.value() > 0; ++k) {
      stop.poll_at(to_size(k));
      const PlanarCurve& curve = loops_.curves[k];
      const Box2 box = grown(box_of(curve), at_least);
      if (!box.meets(boxes_[b])) continue;
      tree(b).visit_meeting(box, [&](Index l) {
        if (least.value() > 0) least.compare(curve, loops_.curves[first_[b] + l]);
      });
    }
  }

  // Charts with disjoint boundaries overlap if a loop of one is inside of another. Charts with det
  // J > 0 have no negative winding numbers, so that none cancel.
  bool any_inside(const StopCheck& stop) const {
    const LoopWinding winding(loops_);
    for (std::size_t k = 0; k < loops_.loops.size(); ++k) {
      stop.poll_at(k * 64);
      const BoundaryLoop& loop = loops_.loops[k];
      const std::optional<long> turns =
          winding.around(loops_.curves[loop.first].front(), [&](const BoundaryLoop& other) {
            return other.chart != loop.chart && !both_fixed(loop.chart, other.chart);
          });
      if (turns != 0) return true;
    }
    return false;
  }

  const std::vector<char>& fixed_;
  BoundaryLoops loops_;
  std::vector<Index> first_;  // #charts + 1: first curve of each chart
  std::vector<Box2> boxes_;   // of each chart
  std::vector<std::optional<BoxTree<2>>> trees_;
};

// The border of a chart as polygons.
class Border {
 public:
  explicit Border(const BoundaryLoops& boundary) {
    for (const BoundaryLoop& loop : boundary.loops) {
      const Index first = static_cast<Index>(points_.size());
      double arc = 0;
      for (Index k = loop.first; k < loop.last; ++k) add_pieces(boundary.curves[k], arc);
      loops_.resize(points_.size(), {first, static_cast<Index>(points_.size()), arc});
    }
    for (const Vector2& p : points_)
      rounding_ = std::max(rounding_, kRoundings * p.cwiseAbs().maxCoeff());
  }

  double clearance(const ClearanceOptions& options, const StopCheck& stop) const {
    double least = options.at_least;
    std::vector<Box2> boxes;
    for (Index k = 0; k < count(); ++k) {
      const Vector2 &a = from(k), &b = to(k);
      boxes.push_back(grown({a.cwiseMin(b), a.cwiseMax(b)}, least / 2));
    }
    std::size_t pairs = 0;
    BoxTree(std::move(boxes)).visit_pairs([&](Index i, Index j) {
      stop.poll_at(pairs++);
      if (next(i) != j && next(j) != i) compare(i, j, options.way, least);
      return least > 0;
    });
    return least;
  }

 private:
  static constexpr int kPiecesPerDegree = 4;  // pieces of a curve, per degree
  struct Loop {
    Index first, last;
    double length;
  };
  // A point of edge k, at a part of its length.
  struct Place {
    Index k;
    double t;
  };

  void add_pieces(const PlanarCurve& curve, double& arc) {
    const int pieces = curve.degree == 1 ? 1 : kPiecesPerDegree * curve.degree;
    for (int k = 0; k < pieces; ++k) {
      points_.push_back(at(curve, k / double(pieces)));
      arcs_.push_back(arc);
      arc += (at(curve, (k + 1) / double(pieces)) - points_.back()).norm();
    }
  }
  static Vector2 at(const PlanarCurve& curve, double t) {
    std::vector<Vector2> p(curve.control_points.begin(),
                           curve.control_points.begin() + curve.degree + 1);
    for (std::size_t n = p.size() - 1; n > 0; --n)
      for (std::size_t k = 0; k < n; ++k) p[k] = (1 - t) * p[k] + t * p[k + 1];
    return p.front();
  }

  Index count() const { return static_cast<Index>(points_.size()); }
  Index next(Index k) const { return k + 1 < loops_[k].last ? k + 1 : loops_[k].first; }
  Index before(Index k) const { return k > loops_[k].first ? k - 1 : loops_[k].last - 1; }
  const Vector2& from(Index k) const { return points_[k]; }
  const Vector2& to(Index k) const { return points_[next(k)]; }
  Vector2 point(const Place& p) const { return from(p.k) + p.t * (to(p.k) - from(p.k)); }

  Place foot(Index k, const Vector2& p) const {
    const Vector2 along = to(k) - from(k);
    const double square = along.squaredNorm();
    return {k, square > 0 ? std::clamp(along.dot(p - from(k)) / square, 0.0, 1.0) : 0.0};
  }

  double way_between(const Place& p, const Place& q) const {
    if (loops_[p.k].first != loops_[q.k].first) return std::numeric_limits<double>::infinity();
    const auto arc = [&](const Place& r) {
      return arcs_[r.k] + r.t * (to(r.k) - from(r.k)).norm();
    };
    const double way = std::abs(arc(p) - arc(q));
    return std::min(way, loops_[p.k].length - way);
  }

  // Returns whether `w` leads from a point of the border out of the chart, which is on its left.
  bool leads_outside(const Place& p, const Vector2& w) const {
    const auto right_of = [&](Index k) { return cross(Vector2(to(k) - from(k)), w) < 0; };
    if (p.t > 0 && p.t < 1) return right_of(p.k);
    const Index out = p.t > 0 ? next(p.k) : p.k, in = before(out);
    const Vector2 coming = to(in) - from(in), going = to(out) - from(out);
    // The chart fills the angle from `going` to the reverse of `coming`, counterclockwise.
    const bool is_convex = cross(coming, going) > 0;
    return is_convex ? right_of(in) || right_of(out) : right_of(in) && right_of(out);
  }

  void compare(Index i, Index j, double way, double& least) const {
    if (segments_meet(from(i), to(i), from(j), to(j))) {
      least = 0;
      return;
    }
    const auto try_pair = [&](const Place& p, const Place& q) {
      const Vector2 w = point(q) - point(p);
      const double distance = w.norm();
      if (distance < least && way_between(p, q) > way * distance &&
          (distance <= rounding_ || (leads_outside(p, w) && leads_outside(q, -w))))
        least = distance;
    };
    for (const double t : {0.0, 1.0}) {
      try_pair({i, t}, foot(j, t > 0 ? to(i) : from(i)));
      try_pair({j, t}, foot(i, t > 0 ? to(j) : from(j)));
    }
  }

  std::vector<Vector2> points_;  // starts of edges
  std::vector<double> arcs_;     // arc length from the start of the loop
  std::vector<Loop> loops_;      // of each edge
  double rounding_ = 0;          // distances below this have no reliable side
};

}  // namespace

double border_clearance(const BezierMap& map, const ClearanceOptions& options,
                        const StopCheck& stop) {
  return Border(boundary_loops(map)).clearance(options, stop);
}

double proven_distance(const std::vector<BezierMap>& charts, double at_least,
                       const std::vector<char>& fixed, const StopCheck& stop) {
  if (charts.size() < 2) return at_least;
  const double unit = layout_unit(charts);
  return unit * Layout(charts, unit, fixed).least_distance(at_least / unit, stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
