// The derivative check detects each kind of error and names it.
#include <gtest/gtest.h>

#include <algorithm>

#include "framework/barrier_chain.h"
#include "majorant/framework/energy_term.h"

namespace majorant {
namespace {

using test::QuadraticTerm;
using test::Random;

// x^4 / 12 of one unknown, with one error at a time.
enum class Mistake {
  None,
  Gradient,
  Hessian,
  Definiteness,
  Blend,
  FirstOrderGradient,
  FirstOrderValue
};

class Quartic final : public EnergyTerm {
 public:
  explicit Quartic(Mistake mistake) : mistake_(mistake) {}
  std::string_view name() const override { return "quartic"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override {
    return c == Curvature::Exact || c == Curvature::Projected;
  }
  void values(VecIn x, const ElementBatch&, const TermState&, Workspace&,
              std::span<double> f) const override {
    f[0] = std::pow(x[0], 4) / 12;
  }
  void local(VecIn x, const ElementBatch&, BlendedCurvature curvature, const TermState&, Workspace&,
             LocalSystem& out) const override {
    const auto off = [&](Mistake m) { return m == mistake_ ? 1.01 : 1.0; };
    out.value[0] = std::pow(x[0], 4) / 12;
    out.gradient[0] = off(Mistake::Gradient) * std::pow(x[0], 3) / 3;
    if (!out.hessian) {
      out.value[0] *= off(Mistake::FirstOrderValue);
      out.gradient[0] *= off(Mistake::FirstOrderGradient);
      return;
    }
    out.hessian[0] = off(Mistake::Hessian) * x[0] * x[0];
    if (mistake_ == Mistake::Definiteness && curvature.model == Curvature::Projected)
      out.hessian[0] = -1;
    if (mistake_ == Mistake::Blend && curvature.projection_weight == 0.5) out.hessian[0] *= 1.01;
  }

 private:
  Mistake mistake_;
  ElementDofs element_dofs_ = test::band_elements(1, 1, 1);
};

TEST(DerivativeCheck, CorrectTermsPass) {
  Random random(1);
  const QuadraticTerm quadratic(test::band_elements(5, 2, 2), random, true);
  const DerivativeReport q = check_derivatives(quadratic, random.vector(12));
  EXPECT_TRUE(q.ok()) << q.message();
  const test::ChainProblem chain(10);
  const DerivativeReport r =
      check_derivatives(*chain.term, chain.problem.expand(chain.start), 1e-4);
  EXPECT_TRUE(r.ok()) << r.message();
  EXPECT_TRUE(check_derivatives(Quartic(Mistake::None), Vec::Constant(1, 2)).ok());
}

TEST(DerivativeCheck, MistakesAreFoundAndNamed) {
  for (const auto& [mistake, text] : {std::pair(Mistake::Gradient, "gradient[0]"),
                                      {Mistake::Hessian, "hessian(0, 0)"},
                                      {Mistake::Definiteness, "curvature projected"},
                                      {Mistake::Blend, "blend(0, 0)"},
                                      {Mistake::FirstOrderGradient, "gradient[0] without hessian"},
                                      {Mistake::FirstOrderValue, "value without hessian"}}) {
    const DerivativeReport r = check_derivatives(Quartic(mistake), Vec::Constant(1, 2));
    EXPECT_FALSE(r.ok()) << text;
    EXPECT_NE(r.message().find(text), std::string::npos) << r.message();
  }
}

// x^2 of every unknown, with the error that all gradients are those of the batch's first element.
class MixedUp final : public EnergyTerm {
 public:
  std::string_view name() const override { return "mixed up"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override { return c == Curvature::Exact; }
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p)
      f[p] = x[batch.elements[p]] * x[batch.elements[p]];
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      out.gradient[p] = 2 * x[batch.elements.front()];
      if (out.hessian) out.hessian[p] = 2;
    }
  }

 private:
  ElementDofs element_dofs_ = test::band_elements(3, 1, 1);
};

TEST(DerivativeCheck, MistakesOfElementsTogetherAreThoseOfEach) {
  const DerivativeReport r = check_derivatives(MixedUp(), Vec::LinSpaced(3, 1, 3));
  ASSERT_EQ(r.mismatches.size(), 2);  // element 0 is right
  EXPECT_NE(r.message().find("element 1: gradient[0] among others is 2, expected 4"),
            std::string::npos)
      << r.message();
}

// r sin(a) with r = x_0 and a = x_1, where r may be 1e6 times as large. The derivative by a has a
// wrong factor.
class Swing final : public EnergyTerm {
 public:
  explicit Swing(double factor) : factor_(factor) {}
  std::string_view name() const override { return "swing"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override { return c == Curvature::Exact; }
  void values(VecIn x, const ElementBatch&, const TermState&, Workspace&,
              std::span<double> f) const override {
    f[0] = x[0] * std::sin(x[1]);
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    constexpr std::size_t stride = LocalSystem::stride;
    values(x, batch, state, workspace, {out.value, 1});
    out.gradient[0] = std::sin(x[1]);
    out.gradient[stride] = factor_ * x[0] * std::cos(x[1]);
    if (!out.hessian) return;
    out.hessian[0] = 0;
    out.hessian[stride] = std::cos(x[1]);
    out.hessian[2 * stride] = -x[0] * std::sin(x[1]);
  }

 private:
  double factor_;
  ElementDofs element_dofs_ = test::band_elements(1, 2, 1);
};

TEST(DerivativeCheck, UnknownsOfOneElementMayDifferInSize) {
  for (const double scale : {1e-6, 1.0, 50.0, 500.0, 5e4, 1e6, 1e9}) {
    const DerivativeReport right = check_derivatives(Swing(1), Vec{{scale, 0.1}});
    EXPECT_TRUE(right.ok()) << scale << "\n" << right.message();
    const DerivativeReport wrong = check_derivatives(Swing(1.001), Vec{{scale, 0.1}});
    ASSERT_FALSE(wrong.ok()) << scale;
    EXPECT_EQ(wrong.message().find("not resolved"), std::string::npos) << wrong.message();
    if (scale >= 1) {
      EXPECT_EQ(wrong.mismatches.front().block, "gradient[1]");
    }
  }
}

// sin(1000 x_0) of two unknowns; the gradient has a wrong factor.
class Wave final : public EnergyTerm {
 public:
  static constexpr double kSpeed = 1000, kFactor = 0.96;
  std::string_view name() const override { return "wave"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override { return c == Curvature::Projected; }
  void values(VecIn x, const ElementBatch&, const TermState&, Workspace&,
              std::span<double> f) const override {
    f[0] = std::sin(kSpeed * x[0]);
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    constexpr std::size_t stride = LocalSystem::stride;
    values(x, batch, state, workspace, {out.value, 1});
    out.gradient[0] = kFactor * kSpeed * std::cos(kSpeed * x[0]);
    out.gradient[stride] = 0;
    for (std::size_t k = 0; k < 3 && out.hessian; ++k) out.hessian[k * stride] = 0;
  }

 private:
  ElementDofs element_dofs_ = test::band_elements(1, 2, 1);
};

// Of the steps 1e-5, 1e-3 and 1e-8, 1e-3 is too long for the wave. Its difference, 0.970 of the
// derivative, is nearest to the gradient, but the other two agree.
TEST(DerivativeCheck, DifferencesThatAgreeAreExpected) {
  const DerivativeReport r = check_derivatives(Wave(), Vec{{1e-3, 100}});
  ASSERT_EQ(r.mismatches.size(), 1) << r.message();
  EXPECT_EQ(r.mismatches[0].block, "gradient[0]");
  EXPECT_NEAR(r.mismatches[0].expected, Wave::kSpeed * std::cos(1.0), 1e-3);
}

// (sum z^2)^2 / 4 of 60 unknowns each; on request the gradient of every third element is wrong.
class Wide final : public EnergyTerm {
 public:
  static constexpr int kUnknowns = 60;
  Wide(Index elements, bool is_right) : is_right_(is_right) {
    element_dofs_.nodes.resize(elements, kUnknowns);
    for (Index e = 0; e < elements; ++e)
      for (int k = 0; k < kUnknowns; ++k) element_dofs_.nodes(e, k) = e + k;
  }
  std::string_view name() const override { return "wide"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature c) const override { return c == Curvature::Exact; }
  void values(VecIn x, const ElementBatch& batch, const TermState&, Workspace&,
              std::span<double> f) const override {
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const double s = x.segment(batch.elements[p], kUnknowns).squaredNorm();
      f[p] = 0.25 * s * s;
    }
    evaluations += static_cast<long>(batch.elements.size());
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, batch.elements.size()});
    for (std::size_t p = 0; p < batch.elements.size(); ++p) {
      const Index e = batch.elements[p];
      const auto z = x.segment(e, kUnknowns);
      const double s = z.squaredNorm();
      for (Index i = 0, k = 0; i < kUnknowns; ++i) {
        const double off = is_right_ || e % 3 > 0 ? 1 : 1.01;
        out.gradient[i * LocalSystem::stride + static_cast<Index>(p)] = off * s * z[i];
        for (Index j = 0; out.hessian && j <= i; ++j, ++k)
          out.hessian[k * LocalSystem::stride + static_cast<Index>(p)] =
              2 * z[i] * z[j] + (i == j ? s : 0);
      }
    }
  }
  mutable long evaluations = 0;

 private:
  bool is_right_;
  ElementDofs element_dofs_;
};

// Errors of many elements are found in a sample.
TEST(DerivativeCheck, ManyElementsAreSampled) {
  constexpr Index kElements = 2000;
  const Vec x = Random(2).vector(kElements + Wide::kUnknowns - 1);
  const Wide right(kElements, true);
  const DerivativeReport r = check_derivatives(right, x);
  EXPECT_TRUE(r.ok()) << r.message();
  EXPECT_EQ(r.elements, kElements);
  EXPECT_GE(r.checked, 200);
  EXPECT_LE(r.checked, 400);
  EXPECT_LT(right.evaluations, 500000) << "a million is too slow";
  const Wide wrong(kElements, false);
  const DerivativeReport w = check_derivatives(wrong, x);
  EXPECT_GE(w.mismatches.size(), 50u);
  for (const DerivativeMismatch& m : w.mismatches) EXPECT_EQ(m.element % 3, 0);
  EXPECT_TRUE(w.message().ends_with(std::to_string(w.checked) + " of 2000 elements were checked\n"))
      << w.message();
}

TEST(DerivativeCheck, FewElementsAreAllChecked) {
  Random random(3);
  const QuadraticTerm thousand(test::band_elements(kMaxCheckedElements, 2, 2), random, true);
  const DerivativeReport all =
      check_derivatives(thousand, random.vector(2 * (kMaxCheckedElements + 1)));
  EXPECT_EQ(all.checked, kMaxCheckedElements);
  EXPECT_EQ(all.elements, kMaxCheckedElements);
  const QuadraticTerm more(test::band_elements(kMaxCheckedElements + 1, 2, 2), random, true);
  const DerivativeReport some =
      check_derivatives(more, random.vector(2 * (kMaxCheckedElements + 2)));
  EXPECT_EQ(some.checked, kMaxCheckedElements);
  EXPECT_EQ(some.elements, kMaxCheckedElements + 1);
  EXPECT_EQ(some.message(), "");
}

TEST(DerivativeCheck, MessagesAreShort) {
  DerivativeReport report;
  for (Index e = 0; e < 100; ++e) report.mismatches.push_back({e / 2, "gradient[0]", 1, 2});
  const std::string text = report.message();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11);
  EXPECT_TRUE(text.ends_with("... and 45 more elements\n")) << text;
  report.mismatches.resize(10);
  EXPECT_EQ(report.message().find("more"), std::string::npos);
  report.mismatches.assign(20, {3, "gradient[0]", 1, 2});
  EXPECT_TRUE(report.message().ends_with("... and 10 more of the same elements\n"))
      << report.message();
}

// A function that is 0 on one side, with all derivatives.
class Hinge final : public EnergyTerm {
 public:
  std::string_view name() const override { return "hinge"; }
  const ElementDofs& element_dofs() const override { return element_dofs_; }
  bool supports(Curvature) const override { return true; }
  // min(1 - x, 0)^2
  void values(VecIn x, const ElementBatch&, const TermState&, Workspace&,
              std::span<double> f) const override {
    f[0] = std::pow(std::min(1 - x[0], 0.0), 2);
  }
  void local(VecIn x, const ElementBatch& batch, BlendedCurvature, const TermState& state,
             Workspace& workspace, LocalSystem& out) const override {
    values(x, batch, state, workspace, {out.value, 1});
    out.gradient[0] = -2 * std::min(1 - x[0], 0.0) + wrong;
    if (out.hessian) out.hessian[0] = x[0] > 1 ? 2 : 0;
  }
  double wrong = 0;

 private:
  ElementDofs element_dofs_ = test::band_elements(1, 1, 1);
};

TEST(DerivativeCheck, ElementsWithoutEnergy) {
  for (const double x : {0.5, 3.0}) {
    const DerivativeReport report = check_derivatives(Hinge(), Vec::Constant(1, x));
    EXPECT_TRUE(report.ok()) << report.message();
  }
  Hinge hinge;
  hinge.wrong = 1e-9;
  EXPECT_FALSE(check_derivatives(hinge, Vec::Constant(1, 0.5)).ok());
}

TEST(DerivativeCheck, StepsThatDisagreeAreReportedAsUnresolved) {
  // max(0, x - 1)^2 slightly left of 1, so that steps of one size reach the other side.
  Hinge hinge;
  hinge.wrong = 1e-3;
  const DerivativeReport report = check_derivatives(hinge, Vec::Constant(1, 1 - 1.5e-5));
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.message().find("not resolved by differences"), std::string::npos)
      << report.message();
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
