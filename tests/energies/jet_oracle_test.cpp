// Every built-in energy against nested automatic differentiation of its textbook formula, and every
// instruction set against the baseline.
#include <gtest/gtest.h>

#include "energies/builtin_formulas.h"

namespace majorant {

namespace {

using test::EnergyProperties;
using test::PointResult;
using Jacobians = std::vector<Eigen::Matrix2d>;

using test::kUnit;

using test::direction;

std::shared_ptr<const EnergyTerm> on_triangles(const std::string& name, const test::Triangles& t) {
  const NamedEnergy* e = find_energy(name);
  EXPECT_NE(e, nullptr) << name;
  return e->make(t.space, t.rest, {lattice_rule(1)});
}

// tolerance(J) is relative to the scales of second derivatives: |H|, |H| |J|, |H| |J|^2 and the
// quantities themselves. Returns the number of compared Jacobians.
template <class Tolerance>
int expect_oracle(const std::string& name, const Jacobians& jacobians, const Tolerance& tolerance) {
  SCOPED_TRACE(name);
  const test::Triangles t(jacobians.size());
  const auto models = test::point_models(*on_triangles(name, t), jacobians, Curvature::Exact);
  int compared = 0;
  for (std::size_t e = 0; e < jacobians.size(); ++e) {
    const Eigen::Matrix2d& j = jacobians[e];
    const PointResult o = test::builtin_oracle(name, j);
    if (!test::finite(o)) continue;  // exponentials overflow
    ++compared;
    SCOPED_TRACE(testing::Message()
                 << "A = " << test::norm_alpha(j) << ", B = " << test::norm_beta(j));
    const double tol = tolerance(j), h = o.hessian.norm(), size = j.norm();
    EXPECT_NEAR(models[e].value, o.value, tol * (std::abs(o.value) + h * size * size));
    EXPECT_LE((models[e].gradient - o.gradient).norm(), tol * (o.gradient.norm() + h * size));
    EXPECT_LE((models[e].hessian - o.hessian).norm(), tol * h);
  }
  return compared;
}

// The exponential multiplies relative errors of its exponent by the exponent.
double exponent(const std::string& name, const Eigen::Matrix2d& j) {
  if (name != "amips-exponential") return 1;
  const double det = j.determinant();
  return 1 + 1.25 * (j.squaredNorm() / det + det + 1 / det);
}

TEST(JetOracle, TheListIsComplete) {
  ASSERT_EQ(named_energies().size(), test::documented_properties().size());
  for (const EnergyProperties& p : test::documented_properties())
    EXPECT_NE(find_energy(p.name), nullptr) << p.name;
}

TEST(JetOracle, GenericJacobians) {
  for (const EnergyProperties& p : test::documented_properties()) {
    const Jacobians j = test::generic_jacobians(p.everywhere, 200);
    EXPECT_EQ(expect_oracle(p.name, j, [](const auto&) { return 1e-12; }), 200) << p.name;
  }
}

// Beta vanishes: 1e-13, except where singular values are needed (spectral()), whose even expansion
// in B is truncated at (B / A)^2 = 2.5e-11.
TEST(JetOracle, SimilaritiesAndNearbyJacobians) {
  test::Random random(6);
  Jacobians similar, near;
  for (const double scale : {0.5, 0.9, 1.0, 1.1, 2.0})
    for (int k = 0; k < 4; ++k)
      similar.push_back(test::from_parts(scale * direction(random), Vector2(0, 0)));
  similar.push_back(Eigen::Matrix2d::Identity());
  for (double ratio = 1e-17; ratio < 0.02; ratio *= 3)
    for (const double scale : {0.5, 1.0, 2.0}) {
      const Vector2 alpha = scale * direction(random);
      near.push_back(test::from_parts(alpha, scale * ratio * direction(random)));
    }
  for (const EnergyProperties& p : test::documented_properties()) {
    const double smooth = p.name == "log-isometric" ? 1e-10 : 1e-13;
    EXPECT_GT(expect_oracle(p.name, similar, [&](const auto&) { return smooth; }), 20);
    EXPECT_GT(expect_oracle(p.name, near, [&](const auto&) { return smooth; }), 90);
  }
}

TEST(JetOracle, Scales) {
  for (const EnergyProperties& p : test::documented_properties()) {
    int compared = 0;
    for (const double scale : {1e-3, 1e-2, 0.1, 10.0, 100.0, 1e3}) {
      Jacobians jacobians = test::generic_jacobians(p.everywhere, 40);
      for (Eigen::Matrix2d& j : jacobians) j *= scale;
      compared += expect_oracle(
          p.name, jacobians, [&](const Eigen::Matrix2d& j) { return 1e-12 * exponent(p.name, j); });
    }
    EXPECT_GE(compared, p.name == "amips-exponential" ? 70 : 240) << p.name;
  }
}

// det J -> 0 through A - B, which has lost |J|^2 / det of its digits in every formula.
TEST(JetOracle, NearlySingular) {
  test::Random random(8);
  Jacobians jacobians;
  for (const double det : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8})
    for (int k = 0; k < 6; ++k)
      jacobians.push_back(
          test::from_parts(direction(random), std::sqrt(1 - det) * direction(random)));
  for (const EnergyProperties& p : test::documented_properties())
    EXPECT_GE(expect_oracle(p.name, jacobians,
                            [&](const Eigen::Matrix2d& j) {
                              return 1e-12 +
                                     32 * kUnit * test::cancellation(j) * exponent(p.name, j);
                            }),
              p.name == "amips-exponential" ? 12 : 36)
        << p.name;
}

TEST(JetOracle, Isometries) {
  test::Random random(9);
  Jacobians turns;
  for (int k = 0; k < 8; ++k) turns.push_back(test::from_parts(direction(random), Vector2(0, 0)));
  const test::Triangles t(turns.size());
  for (const EnergyProperties& p : test::documented_properties())
    for (const PointResult& m :
         test::point_models(*on_triangles(p.name, t), turns, Curvature::Exact)) {
      EXPECT_NEAR(m.value, p.identity, 1e-14) << p.name;
      EXPECT_LE(m.gradient.norm(), 1e-14) << p.name;
    }
}

// ---- Instruction sets ----

// Expects that values, gradients and curvatures of `b` agree with `a`, for one term of each.
void expect_same(const EnergyTerm& a, const EnergyTerm& b, const Jacobians& jacobians) {
  for (const Curvature c : kCurvatures) {
    ASSERT_EQ(a.supports(c), b.supports(c));
    if (!a.supports(c)) continue;
    const auto ma = test::point_models(a, jacobians, c), mb = test::point_models(b, jacobians, c);
    for (std::size_t e = 0; e < jacobians.size(); ++e) {
      const double h = std::max(ma[e].hessian.norm(), mb[e].hessian.norm());
      const double size = jacobians[e].norm();
      const double tol = 1e-11;
      EXPECT_NEAR(ma[e].value, mb[e].value, tol * (std::abs(ma[e].value) + h * size * size));
      EXPECT_LE((ma[e].gradient - mb[e].gradient).norm(), tol * (ma[e].gradient.norm() + h * size));
      EXPECT_LE((ma[e].hessian - mb[e].hessian).norm(), tol * h)
          << "model " << static_cast<int>(c) << ", element " << e;
    }
  }
}

// Counts that no vector width divides, so that incomplete batches occur.
TEST(JetOracle, InstructionSetsAgree) {
  const std::vector<InstructionSet> sets = instruction_sets();
  EXPECT_EQ(sets.front(), InstructionSet::Baseline);
  for (const int count : {1, 3, 7, 9, 131}) {
    const Jacobians jacobians = test::generic_jacobians(false, count);
    const test::Triangles t(jacobians.size());
    const std::vector<Quadrature> rule{lattice_rule(1)};
    for (const NamedEnergy& chosen : named_energies()) {
      SCOPED_TRACE(testing::Message() << chosen.name << ", " << count);
      const auto baseline = test::baseline(chosen.name)(t.space, t.rest, rule);
      expect_same(*baseline, *chosen.make(t.space, t.rest, rule), jacobians);
      for (const InstructionSet set : sets)
        for (const NamedEnergy& energy : named_energies(set))
          if (energy.name == chosen.name)
            expect_same(*baseline, *energy.make(t.space, t.rest, rule), jacobians);
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
