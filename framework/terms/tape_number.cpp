#include "majorant/framework/terms/detail/tape_number.h"

#include "majorant/framework/dual2.h"

namespace majorant::detail {
namespace {

Tape* tape_of(Tape* a, Tape* b) { return a ? a : b; }

Dual2<Lanes, 1> variable_of(const Lanes& values) { return Dual2<Lanes, 1>::variable(values, 0); }

}  // namespace

TapeNumber TapeNumber::push(Tape& tape, TapeNode::Kind kind, std::int32_t a, std::int32_t b,
                            const Lanes& values, bool varies) {
  const auto node = static_cast<std::int32_t>(tape.nodes.size());
  tape.nodes.push_back({kind, a, b, static_cast<std::int32_t>(tape.numbers.size())});
  tape.values.push_back(values);
  return {&tape, node, varies};
}

TapeNumber TapeNumber::constant(Tape* tape, const Lanes& values) {
  return tape ? data(*tape, values) : TapeNumber(values[0]);
}

TapeNumber TapeNumber::data(Tape& tape, const Lanes& values) {
  return push(tape, TapeNode::Constant, 0, 0, values, false);
}

TapeNumber TapeNumber::unknown(Tape& tape, const Lanes& values, int number) {
  return push(tape, TapeNode::Unknown, number, 0, values);
}

TapeNumber operator+(TapeNumber a, TapeNumber b) {
  const Lanes values = a.values() + b.values();
  if (a.varies() && b.varies())
    return TapeNumber::push(*a.tape_, TapeNode::Sum, a.node(), b.node(), values);
  if (b.varies()) std::swap(a, b);
  if (a.varies()) return TapeNumber::push(*a.tape_, TapeNode::Shifted, a.node(), 0, values);
  return TapeNumber::constant(tape_of(a.tape_, b.tape_), values);
}

TapeNumber operator-(TapeNumber a) {
  const Lanes values = -a.values();
  if (a.varies()) return TapeNumber::push(*a.tape_, TapeNode::Negative, a.node(), 0, values);
  return TapeNumber::constant(a.tape_, values);
}

TapeNumber operator-(TapeNumber a, TapeNumber b) {
  const Lanes values = a.values() - b.values();
  if (a.varies() && b.varies())
    return TapeNumber::push(*a.tape_, TapeNode::Difference, a.node(), b.node(), values);
  if (a.varies()) return TapeNumber::push(*a.tape_, TapeNode::Shifted, a.node(), 0, values);
  if (b.varies()) return TapeNumber::push(*b.tape_, TapeNode::Negative, b.node(), 0, values);
  return TapeNumber::constant(tape_of(a.tape_, b.tape_), values);
}

TapeNumber operator*(TapeNumber a, TapeNumber b) {
  const Lanes values = a.values() * b.values();
  if (a.varies() && b.varies())
    return TapeNumber::push(*a.tape_, TapeNode::Product, a.node(), b.node(), values);
  if (b.varies()) std::swap(a, b);
  if (!a.varies()) return TapeNumber::constant(tape_of(a.tape_, b.tape_), values);
  const TapeNumber r = TapeNumber::push(*a.tape_, TapeNode::Scaled, a.node(), 0, values);
  r.tape_->numbers.push_back(b.values());
  return r;
}

TapeNumber select(const TapeMask& first, TapeNumber a, TapeNumber b) {
  const Lanes values = select(first.lanes, a.values(), b.values());
  if (!a.varies() && !b.varies())
    return TapeNumber::constant(tape_of(first.tape, tape_of(a.tape_, b.tape_)), values);
  // A constant has no node, so the node of the other operand stands for both, once with the factor
  // 0.
  Tape& tape = *tape_of(a.varies() ? a.tape_ : nullptr, b.tape_);
  const Lanes zero(0.0), one(1.0), chosen = select(first.lanes, one, zero);
  const TapeNumber r = TapeNumber::push(tape, TapeNode::Choice, a.varies() ? a.node() : b.node(),
                                        b.varies() ? b.node() : a.node(), values);
  tape.numbers.push_back(a.varies() ? chosen : zero);
  tape.numbers.push_back(b.varies() ? one - chosen : zero);
  tape.has_choices = true;
  return r;
}

TapeMask operator<(TapeNumber a, TapeNumber b) {
  return {a.values() < b.values(), tape_of(a.tape_, b.tape_)};
}
TapeMask operator<=(TapeNumber a, TapeNumber b) {
  return {a.values() <= b.values(), tape_of(a.tape_, b.tape_)};
}
TapeMask operator==(TapeNumber a, TapeNumber b) {
  return {a.values() == b.values(), tape_of(a.tape_, b.tape_)};
}

TapeNumber passive(TapeNumber a) { return TapeNumber::constant(a.tape_, a.values()); }

TapeNumber damped(TapeNumber a, double factor) {
  if (!a.varies() || factor == 1) return a;
  const TapeNumber r = TapeNumber::push(*a.tape_, TapeNode::Damped, a.node(), 0, a.values());
  r.tape_->numbers.push_back(Lanes(factor));
  r.tape_->is_damped = true;
  return r;
}

TapeNumber with_derivatives(TapeNumber a, const Lanes& value, const Lanes& slope,
                            const Lanes& bend) {
  if (!a.varies()) return TapeNumber::constant(a.tape_, value);
  const TapeNumber r = TapeNumber::push(*a.tape_, TapeNode::Function, a.node(), 0, value);
  r.tape_->numbers.push_back(slope);
  r.tape_->numbers.push_back(bend);
  return r;
}

// The formulas of derivatives are those of dual numbers.
template <class F>
TapeNumber TapeNumber::function(const F& f, TapeNumber a) {
  const auto u = f(variable_of(a.values()));
  if (!a.varies()) return constant(a.tape_, u.v);
  const TapeNumber r = push(*a.tape_, TapeNode::Function, a.node(), 0, u.v);
  r.tape_->numbers.push_back(u.d[0]);
  r.tape_->numbers.push_back(u.h[0]);
  return r;
}

template <class F>
TapeNumber TapeNumber::function(const F& f, TapeNumber a, TapeNumber b) {
  using Variable = Dual2<Lanes, 2>;
  const Variable u = f(Variable::variable(a.values(), 0), Variable::variable(b.values(), 1));
  if (!a.varies() && !b.varies()) return constant(tape_of(a.tape_, b.tape_), u.v);
  const Lanes zero(0.0);
  const TapeNumber& x = a.varies() ? a : b;
  const TapeNumber r =
      push(*x.tape_, TapeNode::Function2, x.node(), b.varies() ? b.node() : a.node(), u.v);
  auto& numbers = r.tape_->numbers;
  numbers.push_back(a.varies() ? u.d[0] : zero);
  numbers.push_back(b.varies() ? u.d[1] : zero);
  numbers.push_back(a.varies() ? u.h[0] : zero);
  numbers.push_back(a.varies() && b.varies() ? u.h[1] : zero);
  numbers.push_back(b.varies() ? u.h[2] : zero);
  return r;
}

TapeNumber sqrt(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return sqrt(x); }, a);
}
TapeNumber log(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return log(x); }, a);
}
TapeNumber exp(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return exp(x); }, a);
}
TapeNumber sin(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return sin(x); }, a);
}
TapeNumber cos(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return cos(x); }, a);
}
TapeNumber tan(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return tan(x); }, a);
}
TapeNumber asin(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return asin(x); }, a);
}
TapeNumber acos(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return acos(x); }, a);
}
TapeNumber atan(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return atan(x); }, a);
}
TapeNumber sinh(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return sinh(x); }, a);
}
TapeNumber cosh(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return cosh(x); }, a);
}
TapeNumber tanh(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return tanh(x); }, a);
}
TapeNumber inverse(TapeNumber a) {
  return TapeNumber::function([](const auto& x) { return 1.0 / x; }, a);
}
TapeNumber operator/(TapeNumber a, TapeNumber b) { return a * inverse(b); }
TapeNumber pow(TapeNumber a, double p) {
  return TapeNumber::function([p](const auto& x) { return pow(x, p); }, a);
}
TapeNumber pow(double a, TapeNumber p) {
  return TapeNumber::function([a](const auto& x) { return pow(a, x); }, p);
}
TapeNumber pow(TapeNumber a, TapeNumber p) {
  return TapeNumber::function([](const auto& x, const auto& y) { return pow(x, y); }, a, p);
}
TapeNumber atan2(TapeNumber y, TapeNumber x) {
  return TapeNumber::function([](const auto& s, const auto& c) { return atan2(s, c); }, y, x);
}
TapeNumber hypot(TapeNumber a, TapeNumber b) {
  return TapeNumber::function([](const auto& x, const auto& y) { return hypot(x, y); }, a, b);
}

}  // namespace majorant::detail

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
