// The sign of det J on all of an element, and bounds of its minimum, computed in integers on the
// doubles as they are. It serves the few elements for which floating point, whose bounds include
// rounding, finds no proof, and distinguishes inverted elements from undecided ones.
//
//   const Points2 points = Points2::Random(6, 2);             // #(n+1)(n+2)/2 by 2
//   const DeterminantRange exact = exact_determinant_of_triangle(points);
//   if (exact.positive == ProofStatus::Violated) exact.at;    // where det J <= 0
//
// The Bernstein coefficients of det J are integers times a unit. The element is bisected until all
// coefficients of every piece are positive, or one at a corner of a piece, which is a value of det
// J, is not. Straight simplices are always decided. The cost is microseconds in easy cases and up
// to seconds for a minimum of zero, so it is not meant for solvers.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/det_coefficients.h"
#include "majorant/elements/determinant_bounds.h"
#include "majorant/elements/positivity.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

// Returns the sign of det J on the planar Bezier triangle with these control points, in VTK's order
// (bernstein.h), and a point where det J <= 0. Its bounds are infinite. Undecided also for
// coordinates that are not finite, such as an overflowing Bezier form of interpolated values.
// Throws InvalidArgument if the number of points is not triangular or the degree exceeds
// BezierTriangleSpace::kMaxDegree, and Stopped.
DeterminantRange exact_determinant_of_triangle(const Points2& control_points,
                                               const StopCheck& stop = {});

// The vertices of a piece in every factor of the cell: homogeneous coordinates by slot.
class PieceFrame {
 public:
  using Point = std::array<double, 6>;

  explicit PieceFrame(int slots) {
    for (std::size_t s = 0; s < to_size(slots); ++s) slot_[s][s] = 1;
  }
  PieceFrame child(const EdgeBisection& cut, const std::vector<int>& slots) const {
    PieceFrame out = *this;
    for (std::size_t s = 0; s < slots.size(); ++s) {
      if (slots[s] != EdgeBisection::kMidpoint) {
        out.slot_[s] = slot_[to_size(slots[s])];
        continue;
      }
      for (std::size_t c = 0; c < Point{}.size(); ++c)
        out.slot_[s][c] = (slot_[to_size(cut.a)][c] + slot_[to_size(cut.b)][c]) / 2;
    }
    return out;
  }
  // Returns the point at which the function has the coefficient of this corner as its value.
  Point corner(const Exponents& e) const {
    Point sum{};
    for (std::size_t s = 0; s < e.size(); ++s)
      if (e[s] != 0)
        for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += slot_[s][c];
    return sum;
  }

 private:
  std::array<Point, 6> slot_{};
};

// Returns the point of a corner coefficient. A corner has no exponents in a factor in which det J
// is constant (degree 0 there).
inline PieceFrame::Point corner_point(const BernsteinElement& element, const DetCoefficients& det,
                                      const PieceFrame& frame, int coefficient) {
  PieceFrame::Point point = frame.corner(det.basis().exponents(coefficient));
  std::size_t c = 0;
  for (const int corners : element.factors) {
    double sum = 0;
    for (int k = 0; k < corners; ++k) sum += point[c + to_size(k)];
    if (sum == 0) point[c] = 1;
    c += to_size(corners);
  }
  return point;
}

// The element whose sign of det J is computed.
struct DeterminantTables {
  const BernsteinElement& element;
  const DetCoefficients& det;
  const Subdivision& subdivision;  // of polynomials of det J's degree
};

// Integer control points, D numbers each. DetCoefficients::scaled() of them gives det J's
// coefficients times `unit`.
template <class Integer>
struct IntegerNet {
  std::vector<Integer> control_points;
  Integer unit = 1;
};

// Integer: an unbounded type, such as cpp_int of Boost.
template <class Integer>
class ExactDeterminant {
 public:
  enum class Bounds { None, OfTheMinimum };

  ExactDeterminant(const DeterminantTables& tables, Bounds bounds, const StopCheck& stop)
      : tables_(tables), bounds_(bounds), stop_(stop) {}

  DeterminantRange find(const IntegerNet<Integer>& net) {
    unit_ = net.unit;
    Piece whole{0, 0, PieceFrame(tables_.element.coordinate_count()), {}};
    for (const Integer& c : tables_.det.scaled(net.control_points)) whole.a.push_back({c});
    DeterminantRange range{ProofStatus::Proven, kInfinity, kInfinity, -kInfinity, -kInfinity, {}};
    if (bounds_ == Bounds::OfTheMinimum) {
      for (const Halved& a : whole.a)
        range.largest = std::max(range.largest, value(a, 0, Towards::Above));
      for (const int k : tables_.subdivision.corners())
        range.largest_low =
            std::max(range.largest_low, value(whole.a[to_size(k)], 0, Towards::Below));
    } else {
      range.low = -kInfinity;
      range.largest = kInfinity;
    }
    search(std::move(whole), range);
    return range;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  // Upper bound on pieces. Elements with a minimum of 1e-12 of their mean take some hundred.
  // Without a bound, a minimum of exactly zero at an irrational point would be bisected forever.
  static constexpr int kMaxPieces = 8000;
  // Upper bound on halvings of every edge, the resolution of coordinates in doubles.
  static constexpr int kMaxHalvings = 52;

  // An integer that Subdivision halves. The integers have enough factors of 2.
  struct Halved {
    Integer value;
    friend Halved operator+(const Halved& a, const Halved& b) { return {a.value + b.value}; }
    friend Halved half(const Halved& a) { return {a.value >> 1}; }
  };

  struct Piece {
    int depth;
    unsigned bits;  // coefficients are a / 2^bits
    PieceFrame frame;
    std::vector<Halved> a;
  };

  // Returns numerator / denominator (> 0) rounded down or up to a double.
  enum class Towards { Below, Above };
  static double rounded(const Integer& numerator, const Integer& denominator, Towards towards) {
    if (numerator == 0) return 0;
    constexpr int kBits = 60;
    const bool is_negative = numerator < 0;
    Integer n = abs(numerator), d = denominator;
    const int shift = kBits - (static_cast<int>(msb(n)) - static_cast<int>(msb(d)));
    if (shift > 0)
      n <<= static_cast<unsigned>(shift);
    else
      d <<= static_cast<unsigned>(-shift);
    const Integer quotient = n / d;  // 60 or 61 bits
    const double value = std::ldexp(quotient.template convert_to<double>(), -shift);
    const double sign = is_negative ? -1 : 1;
    return std::nextafter(sign * value, towards == Towards::Below ? -kInfinity : kInfinity);
  }

  double value(const Halved& a, unsigned bits, Towards towards) const {
    return rounded(a.value, Integer(unit_ << bits), towards);
  }

  void search(Piece whole, DeterminantRange& range) {
    const int deepest = kMaxHalvings * tables_.element.dim();
    std::vector<Piece> open;
    open.push_back(std::move(whole));
    bool is_left = false;
    for (int pieces = 0; !open.empty(); ++pieces) {
      stop_.poll();
      if (pieces == kMaxPieces) {
        is_left = true;
        for (const Piece& piece : open) lower(piece, range);
        break;
      }
      const Piece piece = std::move(open.back());
      open.pop_back();
      bool has_violation = false;
      for (const int k : tables_.subdivision.corners()) {
        const Halved& a = piece.a[to_size(k)];
        has_violation = has_violation || a.value <= 0;
        const double most = at_most(a, piece.bits);
        if (!(most < range.high)) continue;
        range.high = most;
        range.at = corner_point(tables_.element, tables_.det, piece.frame, k);
      }
      if (has_violation) {
        lower(piece, range);
        for (const Piece& other : open) lower(other, range);
        range.positive = ProofStatus::Violated;
        return;
      }
      const bool is_positive =
          std::all_of(piece.a.begin(), piece.a.end(), [](const Halved& a) { return a.value > 0; });
      if (is_positive || piece.depth == deepest) {
        lower(piece, range);
        is_left = is_left || !is_positive;
        continue;
      }
      split(piece, open);
    }
    if (is_left) range.positive = ProofStatus::Undecided;
    // The bound may be rounded down to 0, but the proof is in integers.
    if (range.positive == ProofStatus::Proven) range.low = std::max(range.low, 0.0);
  }

  // Returns an upper bound of a value; without Bounds, 0 for all values that are not positive.
  double at_most(const Halved& a, unsigned bits) const {
    if (bounds_ == Bounds::None) return a.value <= 0 ? 0 : kInfinity;
    const double most = value(a, bits, Towards::Above);
    return a.value <= 0 ? std::min(0.0, most) : most;
  }

  void lower(const Piece& piece, DeterminantRange& range) const {
    if (bounds_ == Bounds::None) return;
    const auto least =
        std::min_element(piece.a.begin(), piece.a.end(),
                         [](const Halved& a, const Halved& b) { return a.value < b.value; });
    range.low = std::min(range.low, value(*least, piece.bits, Towards::Below));
  }

  void split(const Piece& piece, std::vector<Piece>& open) const {
    const Subdivision& subdivision = tables_.subdivision;
    const auto levels = static_cast<unsigned>(subdivision.levels(piece.depth));
    std::vector<Halved> parent = piece.a, first(parent.size()), second(parent.size());
    for (Halved& a : parent) a.value <<= levels;
    subdivision.bisect(piece.depth, parent.data(), first.data(), second.data());
    const std::vector<EdgeBisection>& cuts = tables_.element.bisections;
    const EdgeBisection& cut = cuts[to_size(piece.depth) % cuts.size()];
    open.push_back({piece.depth + 1, piece.bits + levels, piece.frame.child(cut, cut.first),
                    std::move(first)});
    open.push_back({piece.depth + 1, piece.bits + levels, piece.frame.child(cut, cut.second),
                    std::move(second)});
  }

  const DeterminantTables tables_;
  const Bounds bounds_;
  const StopCheck& stop_;
  Integer unit_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
