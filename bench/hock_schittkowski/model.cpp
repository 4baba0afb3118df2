#include "model.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "majorant/framework/constraint.h"
#include "majorant/framework/terms/equality.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/local_term.h"

namespace majorant::hock_schittkowski {
namespace {

// Returns elements with all unknowns; unused unknowns are fixed at 0.
Cells all_unknowns(Index rows) {
  Cells cells(rows, kMostUnknowns);
  for (int k = 0; k < kMostUnknowns; ++k) cells.col(k).setConstant(k);
  return cells;
}

// Converts the variables of a lambda term to the unknowns of a formula.
template <class Z>
Unknowns unknowns(const Z& z) {
  Unknowns x(kMostUnknowns);
  for (int k = 0; k < kMostUnknowns; ++k)
    if constexpr (std::is_same_v<typename Z::Scalar, double>)
      x[to_size(k)] = z[k];
    else
      x[to_size(k)] = Number(Number::Dual::variable(z[k].v, k));
  return x;
}

template <class T>
T value(const Number& n) {
  if constexpr (std::is_same_v<T, double>) {
    return n.dual.v;
  } else {
    T out(n.dual.v);
    out.d = n.dual.d;
    if constexpr (T::order == 2) out.h = n.dual.h;
    return out;
  }
}

auto row_of(std::function<Values(const Unknowns&)> g) {
  return [g = std::move(g)](Index e, const auto& z) {
    return value<typename std::decay_t<decltype(z)>::Scalar>(g(unknowns(z))[to_size(e)]);
  };
}

struct LinearEquality final : Constraint {
  LinearEquality(Vec c, double r) : coefficients(std::move(c)), right_hand_side(r) {}
  void append_rows(ConstraintRows& out) const override {
    out.begin_row("linear equality");
    for (Index i = 0; i < coefficients.size(); ++i)
      if (coefficients[i] != 0) out.add(i, coefficients[i]);
    out.end_row(right_hand_side);
  }
  Vec coefficients;
  double right_hand_side;
};

Vec padded(const Vec& v, double with) {
  Vec all = Vec::Constant(kMostUnknowns, with);
  all.head(v.size()) = v;
  return all;
}

}  // namespace

Model::Model(const Vec& start) : builder_(kMostUnknowns) {
  made_.unknowns = static_cast<int>(start.size());
  made_.start = padded(start, 0);
  std::vector<FixedUnknown> none;
  for (Index k = start.size(); k < kMostUnknowns; ++k) none.push_back({k, 0});
  builder_.add(FixedUnknowns(none));
}

Model& Model::energy(std::function<Number(const Unknowns&)> f) {
  builder_.add(make_term<kMostUnknowns>(
                   "energy", all_unknowns(1),
                   row_of([f = std::move(f)](const Unknowns& x) { return Values{f(x)}; })),
               1);
  return *this;
}

Model& Model::zero(std::function<Values(const Unknowns&)> g) {
  made_.equalities = static_cast<int>(g(Unknowns(kMostUnknowns)).size());
  builder_.add(equality<kMostUnknowns>("equality", all_unknowns(made_.equalities), row_of(g)), 1);
  return *this;
}

Model& Model::above_zero(std::function<Values(const Unknowns&)> g) {
  made_.inequalities = static_cast<int>(g(Unknowns(kMostUnknowns)).size());
  hold(inequality<kMostUnknowns>("inequality", all_unknowns(made_.inequalities), row_of(g))
           .checker());
  return *this;
}

Model& Model::linear(const Vec& coefficients, double right_hand_side) {
  ++made_.linear_equalities;
  builder_.add(LinearEquality(coefficients, right_hand_side));
  return *this;
}

Model& Model::within(const Vec& lower, const Vec& upper) {
  made_.finite_bounds =
      static_cast<int>(lower.array().isFinite().count() + upper.array().isFinite().count());
  hold(Bounds(padded(lower, -kNone), padded(upper, kNone)).checker());
  return *this;
}

Model& Model::within(double lower, double upper) {
  return within(Vec::Constant(made_.unknowns, lower), Vec::Constant(made_.unknowns, upper));
}

Instance Model::build() const {
  Instance made = made_;
  made.problem = builder_.build();
  return made;
}

void Model::hold(const std::shared_ptr<const BarrierChecker>& checker) {
  builder_.add(checker);
  made_.bounds.push_back({builder_.add(checker->barrier(), 1), checker});
}

}  // namespace majorant::hock_schittkowski

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
