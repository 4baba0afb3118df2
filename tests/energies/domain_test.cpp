// Densities outside the domain, on its boundary and where formulas divide by zero.
#include <gtest/gtest.h>

#include "energies/density_fixture.h"

namespace majorant {
namespace {

using Jacobians = std::vector<Eigen::Matrix2d>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::Matrix2d matrix(double a, double b, double c, double d) {
  Eigen::Matrix2d j;
  j << a, b, c, d;
  return j;
}

std::vector<std::shared_ptr<const EnergyTerm>> barriers(std::size_t count) {
  const test::Triangles t(count);
  const std::vector<Quadrature> rule{lattice_rule(1)};
  return {symmetric_dirichlet()(t.space, t.rest, rule),
          test::baseline("symmetric-dirichlet")(t.space, t.rest, rule),
          make_energy(t.space, t.rest, test::spectral_symmetric_dirichlet(), rule),
          make_energy(t.space, t.rest, test::mips(), rule),
          make_energy(t.space, t.rest, test::spectral_mips(), rule)};
}

std::vector<double> values(const EnergyTerm& term, const Jacobians& jacobians) {
  std::vector<double> f;
  const Vec x = test::corners_of(jacobians);
  Workspace workspace;
  for (Index e = 0; e < static_cast<Index>(jacobians.size()); ++e) {
    f.push_back(-1);
    term.values(x, ElementBatch{0, {&e, 1}}, {}, workspace, {&f.back(), 1});
  }
  return f;
}

TEST(Domain, InfiniteOutsideNeverNaN) {
  const Jacobians outside{matrix(1, 0, 0, -1),
                          matrix(0, 1, 1, 0),
                          matrix(0, 0, 0, 0),
                          matrix(1, 2, 2, 4),
                          matrix(-3, 0, 0, 1e-9),
                          matrix(1, 1, 1, 1),
                          matrix(kNaN, 0, 0, 1),
                          matrix(1, kNaN, 0, 1),
                          matrix(1, 0, 0, kNaN),
                          matrix(kInfinity, 0, 0, 1),
                          matrix(1, 0, 0, -kInfinity),
                          matrix(kInfinity, 0, 0, kInfinity),
                          matrix(-kInfinity, 0, 0, -kInfinity),
                          matrix(0, kInfinity, -kInfinity, 0),
                          matrix(1e200, 0, 0, -1e200),
                          matrix(1e-200, 0, 0, 1e-200)};
  for (const auto& term : barriers(outside.size())) {
    SCOPED_TRACE(term->name());
    const std::vector<double> f = values(*term, outside);
    for (std::size_t e = 0; e < f.size(); ++e) EXPECT_EQ(f[e], kInfinity) << outside[e];
  }
}

// Doubles whose squares overflow: +inf is allowed, NaN is not.
TEST(Domain, HugeScalesAreNotNaN) {
  const Jacobians huge{matrix(1e160, 0, 0, 1e160), matrix(1e200, 1e199, -1e199, 1e200),
                       matrix(1e308, 0, 0, 1e308)};
  for (const auto& term : barriers(huge.size()))
    for (const double f : values(*term, huge)) EXPECT_FALSE(std::isnan(f)) << term->name();
}

TEST(Domain, EverywhereMeansFiniteForNegativeDeterminants) {
  const Jacobians j{matrix(1, 0, 0, -1), matrix(0, 0, 0, 0), matrix(-2, 1, 0.5, 3)};
  const test::Triangles t(j.size());
  const auto term = make_energy(t.space, t.rest, test::arap(), {lattice_rule(1)});
  const std::vector<double> f = values(*term, j);
  // S + s = 2 A, so (S - 1)^2 + (s - 1)^2 = |J|^2 - 4 A + 2; A = 0 for the first two.
  for (std::size_t e = 0; e < j.size(); ++e)
    EXPECT_NEAR(2 * f[e], j[e].squaredNorm() - 4 * test::norm_alpha(j[e]) + 2, 1e-14);
  for (const double bad : {kNaN, kInfinity}) {
    const Jacobians broken{matrix(bad, 0, 0, 1), matrix(1, bad, 0, 1), matrix(bad, 0, 0, bad)};
    for (const double v : values(*term, broken)) EXPECT_EQ(v, kInfinity);
  }
}

// One inverted quadrature point of a curved element suffices.
TEST(Domain, OneBadPointMakesTheElementInfinite) {
  Cells face(1, 3);
  face << 0, 1, 2;
  Points3 positions(3, 3);
  positions << 1, 0, 0, 0, 1, 0, 0, 0, 0;
  const auto space = std::make_shared<const BezierTriangleSpace>(face, 3, 2);
  const auto term = symmetric_dirichlet()(space, flat_triangles(positions, face),
                                          {guarded_rule(lattice_rule(4), 1, 1e-3)});
  Vec x = test::linear_map(*space, test::flat(positions));
  const Index e = 0;
  double f = 0;
  Workspace workspace;
  term->values(x, ElementBatch{0, {&e, 1}}, {}, workspace, {&f, 1});
  EXPECT_NEAR(f, 0.5 * 4, 1e-14);
  x.segment<2>(2 * space->cells()(0, 3)) = Vector2(-0.01, 0.6);  // det < 0 at a corner only
  ASSERT_LT(test::det_at(*space, x, 0, Barycentric(0, 1, 0)) *
                test::det_at(*space, x, 0, Barycentric::Constant(1.0 / 3)),
            0);
  term->values(x, ElementBatch{0, {&e, 1}}, {}, workspace, {&f, 1});
  EXPECT_EQ(f, kInfinity);
}

// Reflections have alpha = 0 exactly; an energy without barrier must be differentiable there if its
// formula is. As-similar-as-possible, 4 |beta|^2, is quadratic.
TEST(Domain, ReflectionsHaveFiniteDerivatives) {
  const Jacobians j{matrix(1, 0, 0, -1), matrix(0, 2, 2, 0), matrix(0.5, 0.25, 0.25, -0.5),
                    matrix(0, 0, 0, 0)};
  const test::Triangles t(j.size());
  const auto quadratic =
      make_energy(t.space, t.rest,
                  invariant("asap", [](const auto& x, const auto& y) { return 4.0 * y + 0.0 * x; },
                            {Domain::Everywhere, Convexity::Convex}),
                  {lattice_rule(1)});
  const auto from_singular_values =
      make_energy(t.space, t.rest,
                  spectral("asap", [](auto S, auto s) { return (S - s) * (S - s); },
                           {Domain::Everywhere, Convexity::Convex}),
                  {lattice_rule(1)});
  const auto general =
      make_energy(t.space, t.rest,
                  invariant("asap", [](const auto& x, const auto& y) { return 4.0 * y + 0.0 * x; },
                            {Domain::Everywhere, Convexity::Unknown}),
                  {lattice_rule(1)});
  const auto direct = [](const test::Jet& a, const test::Jet& b, const test::Jet& c,
                         const test::Jet& d) { return (a - d) * (a - d) + (b + c) * (b + c); };
  for (const auto& [name, term] : {std::pair("invariant", quadratic),
                                   {"spectral", from_singular_values},
                                   {"unknown", general}})
    for (const Curvature c : {Curvature::Exact, Curvature::Projected}) {
      SCOPED_TRACE(testing::Message() << name << ", model " << static_cast<int>(c));
      const auto models = test::point_models(*term, j, c);
      for (std::size_t e = 0; e < j.size(); ++e) {
        const auto o = test::oracle(direct, j[e]);
        EXPECT_NEAR(models[e].value, o.value, 1e-14);
        EXPECT_LE((models[e].gradient - o.gradient).norm(), 1e-9) << models[e].gradient.transpose();
        EXPECT_LE((models[e].hessian - o.hessian).norm(), 1e-9) << models[e].hessian;
      }
    }
}

// ARAP is not differentiable at A = 0 (a cusp of -4 A), but the solver must not get NaN.
TEST(Domain, KinksGiveFiniteNumbers) {
  Jacobians j{matrix(1, 0, 0, -1), matrix(0, 0, 0, 0)};
  for (const double a : {1e-300, 1e-160, 1e-100, 1e-30, 1e-16, 1e-8})
    j.push_back(test::from_parts(Vector2(a, 0), Vector2(0.5, 0)));
  const test::Triangles t(j.size());
  const auto term = make_energy(t.space, t.rest, test::arap(), {lattice_rule(1)});
  for (const Curvature c : {Curvature::Projected, Curvature::Majorizer}) {
    const auto models = test::point_models(*term, j, c);
    for (std::size_t e = 0; e < j.size(); ++e) {
      EXPECT_TRUE(std::isfinite(models[e].value));
      EXPECT_TRUE(models[e].gradient.allFinite()) << "A = " << test::norm_alpha(j[e]);
      EXPECT_TRUE(models[e].hessian.allFinite()) << "A = " << test::norm_alpha(j[e]);
      if (!models[e].hessian.allFinite()) continue;
      EXPECT_GE(test::smallest_eigenvalue(models[e].hessian), -1e-12 * models[e].hessian.trace())
          << "A = " << test::norm_alpha(j[e]);
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
