// A nonconvex problem with a barrier whose minimum is known: points x_0 < ... < x_n on a line, and
// for each gap d = x_{i+1} - x_i
//   phi(d) = -mu log d + log(1 + ((d - l_i) / w)^2) + k d^2 / 2,   +inf for d <= 0.
// It is concave for d - l_i well above w, but has only one stationary point, left of l_i + w:
// phi' < 0 for d - l_i < -w, phi'' > 0 for |d - l_i| < w, phi' > 0 for d - l_i > w.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/quadratic_term.h"
#include "majorant/framework/problem.h"

namespace majorant::test {

class BarrierChain final : public EnergyTerm {
 public:
  BarrierChain(Index gaps, Random& random)
      : lengths_(random.vector(gaps, 0.5, 2)), element_dofs_(band_elements(gaps, 2, 1)) {}
  std::string_view name() const override { return "barrier chain"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override {
    return c == Curvature::Exact || c == Curvature::Projected;
  }

  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p)
      f[p] = phi(x[batch.elements[p] + 1] - x[batch.elements[p]], lengths_[batch.elements[p]]);
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature curvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    constexpr std::size_t stride = LocalSystem::stride;
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      const double d = x[e + 1] - x[e], u = d - lengths_[e], q = kW * kW + u * u;
      const double s = slope(d, lengths_[e]);
      out.gradient[p] = -s;
      out.gradient[stride + p] = s;
      if (!out.hessian) continue;
      const double h = curvature.clamped(kMu / (d * d) + 2 * (kW * kW - u * u) / (q * q)) + kSpring;
      out.hessian[p] = out.hessian[2 * stride + p] = h;
      out.hessian[stride + p] = -h;
    }
  }

  // These return gaps and energy of the minimum without constraints on the gaps.
  Vec best_gaps() const {
    Vec d(lengths_.size());
    for (Index e = 0; e < d.size(); ++e) {
      double low = 0, high = lengths_[e] + kW;
      for (int k = 0; k < 200; ++k) {
        d[e] = 0.5 * (low + high);
        (slope(d[e], lengths_[e]) < 0 ? low : high) = d[e];
      }
    }
    return d;
  }
  double best_energy() const {
    const Vec d = best_gaps();
    double sum = 0;
    for (Index e = 0; e < d.size(); ++e) sum += phi(d[e], lengths_[e]);
    return sum;
  }
  static Vec gaps(VecIn x) { return x.tail(x.size() - 1) - x.head(x.size() - 1); }

 private:
  static constexpr double kMu = 0.3, kW = 0.7, kSpring = 0.1;
  static double phi(double d, double l) {
    if (!(d > 0)) return std::numeric_limits<double>::infinity();
    return -kMu * std::log(d) + std::log1p((d - l) * (d - l) / (kW * kW)) + kSpring * d * d / 2;
  }
  static double slope(double d, double l) {
    return -kMu / d + 2 * (d - l) / (kW * kW + (d - l) * (d - l)) + kSpring * d;
  }
  Vec lengths_;
  ElementDofs element_dofs_;
};

// The chain with x_0 + x_n = 1 eliminated (a row -1 in Z), and a start whose gaps range from nearly
// 0 to the concave part.
struct ChainProblem {
  explicit ChainProblem(Index gaps, unsigned seed = 1) : ChainProblem(gaps, Random(seed)) {}
  ChainProblem(Index gaps, Random random)
      : term(std::make_shared<const BarrierChain>(gaps, random)) {
    Rows rows;
    rows.row({{0, 1}, {gaps, 1}}, 1);
    problem = ProblemBuilder(gaps + 1).add(term, kWeight).add(rows).build();
    Vec x(gaps + 1);
    x[0] = 0;
    for (Index i = 0; i < gaps; ++i)
      x[i + 1] = x[i] + (i % 5 == 0 ? 0.02 : random.uniform(0.1, 4.5));
    x.array() += (1 - x[0] - x[gaps]) / 2;
    start = problem.reduce(x);
  }
  double best_energy() const { return kWeight * term->best_energy(); }

  static constexpr double kWeight = 3;
  std::shared_ptr<const BarrierChain> term;
  Problem problem;
  Vec start;
};

// Requires that every gap exceeds `gap`; certifies paths.
class MinimumGap final : public FeasibilityChecker {
 public:
  explicit MinimumGap(double gap) : gap_(gap) {}
  std::string_view name() const override { return "minimum gap"; }
  Verdict check(VecIn x) const override {
    Verdict v;
    const Vec d = BarrierChain::gaps(x);
    for (Index i = 0; i < d.size(); ++i)
      if (!(d[i] > gap_)) v.blocking.push_back(i);
    v.feasible = v.blocking.empty();
    return v;
  }
  StepBound max_step(VecIn x, VecIn d, double s) const override {
    StepBound b{s, {}};
    const Vec g = BarrierChain::gaps(x), slope = BarrierChain::gaps(d);
    for (Index i = 0; i < g.size(); ++i)
      if (slope[i] < 0 && (gap_ - g[i]) / slope[i] < b.step) b = {(gap_ - g[i]) / slope[i], {i}};
    return b;
  }

 private:
  double gap_;
};

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
