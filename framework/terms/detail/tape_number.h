// Numbers of a few elements that record their operations on a tape. Lambdas that are called for
// several elements at a time get them as arguments.
//
// A comparison gives a mask, for select(). A mask can also decide a branch, which is then that of
// the first element; Tape::branches_differ is set if other elements would take another branch.
//
// Not for inclusion: local_term.h.
#pragma once

#include "majorant/framework/terms/detail/tape.h"

namespace majorant::detail {

struct TapeMask {
  LaneMask lanes;
  Tape* tape;

  explicit operator bool() const {
    for (const bool lane : lanes.lane)
      if (lane != lanes.lane[0] && tape) tape->branches_differ = true;
    return lanes.lane[0];
  }
  friend TapeMask operator!(TapeMask a) {
    for (bool& lane : a.lanes.lane) lane = !lane;
    return a;
  }
};

class TapeNumber {
 public:
  // A constant that all elements share.
  TapeNumber(double constant = 0) : tape_(nullptr), constant_(constant) {}
  // A number of each element that is not an unknown.
  static TapeNumber data(Tape& tape, const Lanes& values);
  static TapeNumber unknown(Tape& tape, const Lanes& values, int number);

  Lanes values() const { return tape_ ? tape_->values[to_size(place_.node)] : Lanes(constant_); }
  // The node on its tape; negative for a constant.
  std::int32_t node() const { return varies() ? place_.node : -1; }

  friend TapeNumber operator+(TapeNumber a, TapeNumber b);
  friend TapeNumber operator-(TapeNumber a, TapeNumber b);
  friend TapeNumber operator*(TapeNumber a, TapeNumber b);
  friend TapeNumber operator/(TapeNumber a, TapeNumber b);
  friend TapeNumber operator-(TapeNumber a);
  friend TapeNumber operator+(TapeNumber a) { return a; }
  TapeNumber& operator+=(TapeNumber b) { return *this = *this + b; }
  TapeNumber& operator-=(TapeNumber b) { return *this = *this - b; }
  TapeNumber& operator*=(TapeNumber b) { return *this = *this * b; }
  TapeNumber& operator/=(TapeNumber b) { return *this = *this / b; }

  friend TapeMask operator<(TapeNumber a, TapeNumber b);
  friend TapeMask operator<=(TapeNumber a, TapeNumber b);
  friend TapeMask operator==(TapeNumber a, TapeNumber b);
  friend TapeMask operator>(TapeNumber a, TapeNumber b) { return b < a; }
  friend TapeMask operator>=(TapeNumber a, TapeNumber b) { return b <= a; }
  friend TapeMask operator!=(TapeNumber a, TapeNumber b) { return !(a == b); }

  friend TapeNumber select(const TapeMask& first, TapeNumber a, TapeNumber b);
  friend TapeNumber abs(TapeNumber a) { return select(a < 0.0, -a, a); }
  friend TapeNumber fabs(TapeNumber a) { return abs(a); }
  friend TapeNumber min(TapeNumber a, TapeNumber b) { return select(b < a, b, a); }
  friend TapeNumber max(TapeNumber a, TapeNumber b) { return select(a < b, b, a); }
  // Returns its value, as a constant for derivatives.
  friend TapeNumber passive(TapeNumber a);
  // Returns the same number, with second derivatives scaled by `factor` in those of the result.
  friend TapeNumber damped(TapeNumber a, double factor);
  // Returns a function of a, given by its values and derivatives.
  friend TapeNumber with_derivatives(TapeNumber a, const Lanes& value, const Lanes& slope,
                                     const Lanes& bend);

  friend TapeNumber sqrt(TapeNumber a);
  friend TapeNumber log(TapeNumber a);
  friend TapeNumber exp(TapeNumber a);
  friend TapeNumber sin(TapeNumber a);
  friend TapeNumber cos(TapeNumber a);
  friend TapeNumber tan(TapeNumber a);
  friend TapeNumber asin(TapeNumber a);
  friend TapeNumber acos(TapeNumber a);
  friend TapeNumber atan(TapeNumber a);
  friend TapeNumber sinh(TapeNumber a);
  friend TapeNumber cosh(TapeNumber a);
  friend TapeNumber tanh(TapeNumber a);
  friend TapeNumber inverse(TapeNumber a);
  friend TapeNumber pow(TapeNumber a, double p);
  friend TapeNumber pow(double a, TapeNumber p);
  friend TapeNumber pow(TapeNumber a, TapeNumber p);
  friend TapeNumber atan2(TapeNumber y, TapeNumber x);
  friend TapeNumber hypot(TapeNumber a, TapeNumber b);

 private:
  struct Place {
    std::int32_t node;
    bool varies;  // with the unknowns
  };

  TapeNumber(Tape* tape, std::int32_t node, bool varies) : tape_(tape), place_{node, varies} {}
  bool varies() const { return tape_ && place_.varies; }
  // Adds a node to the tape; it is a constant unless `varies`.
  static TapeNumber push(Tape& tape, TapeNode::Kind kind, std::int32_t a, std::int32_t b,
                         const Lanes& values, bool varies = true);
  // Adds a constant to the tape of a or b.
  static TapeNumber constant(Tape* tape, const Lanes& values);
  template <class F>
  static TapeNumber function(const F& f, TapeNumber a);
  template <class F>
  static TapeNumber function(const F& f, TapeNumber a, TapeNumber b);

  Tape* tape_;  // null: a constant, whose value is constant_
  union {
    double constant_;
    Place place_;
  };
};

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
