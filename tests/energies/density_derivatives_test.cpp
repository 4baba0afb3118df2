// Values, gradients and exact Hessians of densities against an independent long double oracle, on
// random and degenerate Jacobians.
#include <gtest/gtest.h>

#include "energies/density_fixture.h"

namespace majorant {
namespace {

using test::PointResult;
using Jacobians = std::vector<Eigen::Matrix2d>;

using test::kUnit;

// Formulas in x = A^2 and y = B^2 lose the digits that cancel in det = x - y, to the power of det
// in the formula (det^-4 in second derivatives).
double invariant_tolerance(const Eigen::Matrix2d& j) {
  return 1e-14 + 16 * kUnit * test::cancellation(j);
}

// Formulas in S and s divide k_B by B: k_B = h_S - h_s has lost A / B of its digits. Below B = 5e-6
// A the library uses k_BB for k_B / B, with an error of (B / A)^2 k_BBBB / 6.
double spectral_tolerance(const Eigen::Matrix2d& j) {
  const double ratio = test::norm_beta(j) / test::norm_alpha(j);
  const double quotient = ratio > 4.95e-6 ? 16 * kUnit / ratio : 0;
  const double limit = ratio < 5.05e-6 ? 10 * ratio * ratio : 0;
  return invariant_tolerance(j) + quotient + limit;
}

template <class Direct, class Tolerance>
void expect_derivatives(const EnergyFactory& make, const Direct& direct, const Jacobians& jacobians,
                        const Tolerance& tolerance, double value_offset = 0) {
  const test::Triangles t(jacobians.size());
  const auto term = make(t.space, t.rest, {lattice_rule(1)});
  const auto models = test::point_models(*term, jacobians, Curvature::Exact);
  for (std::size_t e = 0; e < jacobians.size(); ++e) {
    const PointResult o = test::oracle(direct, jacobians[e]);
    const double tol = tolerance(jacobians[e]);
    const double size = jacobians[e].norm();
    SCOPED_TRACE(testing::Message() << "A = " << test::norm_alpha(jacobians[e]) << ", B = "
                                    << test::norm_beta(jacobians[e]) << ", tolerance " << tol);
    EXPECT_NEAR(models[e].value, o.value, tol * (std::abs(o.value) + value_offset));
    // At isometries the gradient is 0 but its terms are not, so errors are relative to curvature
    // times J.
    EXPECT_LE((models[e].gradient - o.gradient).norm(),
              tol * (o.gradient.norm() + o.hessian.norm() * size));
    EXPECT_LE((models[e].hessian - o.hessian).norm(), tol * o.hessian.norm());
  }
}

TEST(DensityDerivatives, SymmetricDirichlet) {
  expect_derivatives(test::baseline("symmetric-dirichlet"), test::direct_symmetric_dirichlet,
                     test::injective_jacobians(), invariant_tolerance);
}

TEST(DensityDerivatives, SymmetricDirichletFromSingularValues) {
  expect_derivatives(energy_factory(test::spectral_symmetric_dirichlet()),
                     test::direct_symmetric_dirichlet, test::injective_jacobians(),
                     spectral_tolerance);
}

TEST(DensityDerivatives, Mips) {
  expect_derivatives(energy_factory(test::mips()), test::direct_mips, test::injective_jacobians(),
                     invariant_tolerance);
}

TEST(DensityDerivatives, MipsFromSingularValues) {
  expect_derivatives(energy_factory(test::spectral_mips()), test::direct_mips,
                     test::injective_jacobians(), spectral_tolerance);
}

// |J|^2 - 4 A + 2 is smooth except at A = 0, near which the curvature 4 / A of the second term
// dominates.
TEST(DensityDerivatives, Arap) {
  const auto tolerance = [](const Eigen::Matrix2d& j) {
    const double a = test::norm_alpha(j), b = test::norm_beta(j);
    // k_A is a sum of terms of size 1 + A + B, k_B a difference of such.
    const double size = (1 + a + b);
    return 1e-13 + 64 * kUnit * size / std::min(1.0, a) * (1 + b / a) +
           64 * kUnit * size / std::max(b, 5e-6 * a);
  };
  Jacobians jacobians;
  for (const Eigen::Matrix2d& j : test::all_jacobians())
    if (j.norm() < 100 && test::norm_alpha(j) > 1e-4) jacobians.push_back(j);
  expect_derivatives(energy_factory(test::arap()), test::direct_arap, jacobians, tolerance, 1.0);
}

// At a similarity both formulas are exact up to rounding, without shifts by safeguards.
TEST(DensityDerivatives, SimilaritiesAreExact) {
  Jacobians similar;
  for (const double scale : {0.5, 1.0, 1.25})
    for (const double angle : {0.0, 0.7, 2.5})
      similar.push_back(
          test::from_parts(scale * Vector2(std::cos(angle), std::sin(angle)), Vector2(0, 0)));
  expect_derivatives(test::baseline("symmetric-dirichlet"), test::direct_symmetric_dirichlet,
                     similar, [](const auto&) { return 1e-14; });
  Jacobians exactly_similar{Eigen::Matrix2d::Identity(), 0.5 * Eigen::Matrix2d::Identity()};
  exactly_similar.push_back(test::from_parts(Vector2(0.75, -1.5), Vector2(0, 0)));
  expect_derivatives(energy_factory(test::spectral_symmetric_dirichlet()),
                     test::direct_symmetric_dirichlet, exactly_similar,
                     [](const auto&) { return 1e-14; });
  expect_derivatives(energy_factory(test::spectral_mips()), test::direct_mips, exactly_similar,
                     [](const auto&) { return 1e-14; });
}

TEST(DensityDerivatives, SpectralAndInvariantFormsAgree) {
  const Jacobians jacobians = test::injective_jacobians();
  const test::Triangles t(jacobians.size());
  const auto a = test::baseline("symmetric-dirichlet")(t.space, t.rest, {lattice_rule(1)});
  const auto b =
      make_energy(t.space, t.rest, test::spectral_symmetric_dirichlet(), {lattice_rule(1)});
  for (const Curvature c : {Curvature::Exact, Curvature::Projected, Curvature::Majorizer}) {
    const auto ma = test::point_models(*a, jacobians, c), mb = test::point_models(*b, jacobians, c);
    for (std::size_t e = 0; e < jacobians.size(); ++e) {
      // 1e-12 away from similarities and from det J = 0; see the tolerances above for the rest.
      const double tol = std::max(1e-12, 2 * spectral_tolerance(jacobians[e]));
      EXPECT_NEAR(ma[e].value, mb[e].value, tol * ma[e].value);
      EXPECT_LE((ma[e].hessian - mb[e].hessian).norm(), tol * ma[e].hessian.norm());
      EXPECT_LE((ma[e].gradient - mb[e].gradient).norm(),
                tol * (ma[e].gradient.norm() + ma[e].hessian.norm() * jacobians[e].norm()));
    }
  }
}

// The kernel selected at run time, that of this file's instruction set, and incomplete batches
// (counts that no vector width divides).
TEST(DensityDerivatives, InstructionSetsAgree) {
  Jacobians jacobians = test::injective_jacobians();
  for (const std::size_t count :
       {jacobians.size(), std::size_t(131), std::size_t(13), std::size_t(1)}) {
    jacobians.resize(count);
    const test::Triangles t(count);
    const auto here = test::baseline("symmetric-dirichlet")(t.space, t.rest, {radon_rule()});
    const auto best = symmetric_dirichlet()(t.space, t.rest, {radon_rule()});
    EXPECT_EQ(here->name(), best->name());
    for (const Curvature c :
         {Curvature::Exact, Curvature::Projected, Curvature::CompositeMajorizer}) {
      const auto a = test::point_models(*here, jacobians, c),
                 b = test::point_models(*best, jacobians, c);
      for (std::size_t e = 0; e < count; ++e) {
        const double tol = 1e-13 + 16 * kUnit * test::cancellation(jacobians[e]);
        EXPECT_NEAR(a[e].value, b[e].value, tol * a[e].value);
        EXPECT_LE((a[e].gradient - b[e].gradient).norm(),
                  tol * (a[e].gradient.norm() + a[e].hessian.norm() * jacobians[e].norm()));
        EXPECT_LE((a[e].hessian - b[e].hessian).norm(), tol * a[e].hessian.norm());
      }
    }
  }
}

TEST(DensityDerivatives, ValuesAndLocalSystemsAgree) {
  const Jacobians jacobians = test::injective_jacobians();
  const test::Triangles t(jacobians.size());
  const auto check = [&](const EnergyTerm& term) {
    const auto m = test::element_models(term, test::corners_of(jacobians), Curvature::Projected);
    for (std::size_t e = 0; e < jacobians.size(); ++e)
      EXPECT_NEAR(m.values[e], m.f[e],
                  (1e-15 + kUnit * test::cancellation(jacobians[e])) * 16 * m.values[e]);
  };
  check(*symmetric_dirichlet()(t.space, t.rest, {radon_rule()}));
  check(*make_energy(t.space, t.rest, test::spectral_mips(), {radon_rule()}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
