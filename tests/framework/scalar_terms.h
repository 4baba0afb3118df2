// Terms of one unknown per element and checkers, for the tests of minimizers.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "framework/quadratic_term.h"
#include "majorant/framework/feasibility.h"

namespace majorant::test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The sum over unknowns of phi(x), given by phi, phi' and phi''.
struct Scalar {
  std::function<double(double)> f, f1, f2;
};

class Chain final : public EnergyTerm {
 public:
  Chain(Index count, Scalar phi)
      : phi_(std::move(phi)), element_dofs_(band_elements(count, 1, 1)) {}
  std::string_view name() const override { return "chain"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature) const override { return true; }
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) f[p] = phi_.f(x[batch.elements[p]]);
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState&, Workspace&,
             LocalSystem& out) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const double t = x[batch.elements[p]];
      out.value[p] = phi_.f(t);
      out.gradient[p] = phi_.f1(t);
      if (out.hessian) out.hessian[p] = phi_.f2(t);
    }
  }

 private:
  Scalar phi_;
  ElementDofs element_dofs_;
};

inline Scalar double_well() {
  return {[](double t) { return (t * t - 1) * (t * t - 1) + 1; },
          [](double t) { return 4 * t * (t * t - 1); }, [](double t) { return 12 * t * t - 4; }};
}

inline Scalar parabola(double minimum, double offset) {
  return {[=](double t) { return (t - minimum) * (t - minimum) + offset; },
          [=](double t) { return 2 * (t - minimum); }, [](double) { return 2.0; }};
}

// The box |x_i| < limit, with or without certified paths.
class Box final : public FeasibilityChecker {
 public:
  Box(double limit, bool paths) : limit_(limit), paths_(paths) {}
  std::string_view name() const override { return "box"; }
  Verdict check(VecIn x) const override {
    Verdict v;
    for (Index i = 0; i < x.size(); ++i)
      if (!(std::abs(x[i]) < limit_)) v.blocking.push_back(i);
    v.feasible = v.blocking.empty();
    return v;
  }
  StepBound max_step(VecIn x, VecIn d, double s) const override {
    StepBound b{s, {}};
    if (!paths_) return b;
    for (Index i = 0; i < x.size(); ++i) {
      const double room = (d[i] > 0 ? limit_ - x[i] : limit_ + x[i]) / std::abs(d[i]);
      if (room < b.step) b = {room, {i}};
    }
    return b;
  }

 private:
  double limit_;
  bool paths_;
};

// A checker that allows no movement.
class Frozen final : public FeasibilityChecker {
 public:
  std::string_view name() const override { return "frozen"; }
  Verdict check(VecIn) const override { return {}; }
  StepBound max_step(VecIn, VecIn, double) const override { return {0, {3}}; }
};

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
