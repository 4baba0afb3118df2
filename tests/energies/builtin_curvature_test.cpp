// The curvature models of the built-in energies: which energy has which model, and the properties
// of each model.
#include <gtest/gtest.h>

#include "energies/builtin_formulas.h"
#include "majorant/framework/error.h"
#include "majorant/framework/newton.h"

namespace majorant {
namespace {

using test::EnergyProperties;
using test::Matrix4;
using test::PointResult;
using test::Vector4;
using Jacobians = std::vector<Eigen::Matrix2d>;

std::vector<PointResult> models(const std::string& name, const Jacobians& jacobians,
                                BlendedCurvature c) {
  const test::Triangles t(jacobians.size());
  const auto term = find_energy(name)->make(t.space, t.rest, {lattice_rule(1)});
  return test::point_models(*term, jacobians, c);
}

using test::direction;

// Returns general Jacobians, similarities and nearby ones, stretches above e (where log^2 is
// concave), and contractions.
Jacobians jacobians(bool everywhere) {
  Jacobians out = test::generic_jacobians(everywhere, 120);
  test::Random random(17);
  for (const double scale : {0.25, 1.0, 1.0 + 1e-7, 1.5, 4.0})
    for (const double ratio : {0.0, 1e-12, 1e-7, 1e-3}) {
      const Vector2 alpha = scale * direction(random);
      out.push_back(test::from_parts(alpha, scale * ratio * direction(random)));
    }
  return out;
}

using test::describe;

TEST(BuiltinCurvature, SupportIsAsDocumented) {
  for (const EnergyProperties& p : test::documented_properties()) {
    const test::Triangles t(1);
    const auto term = find_energy(p.name)->make(t.space, t.rest, {lattice_rule(1)});
    EXPECT_TRUE(term->supports(Curvature::Exact)) << p.name;
    EXPECT_TRUE(term->supports(Curvature::Projected)) << p.name;
    EXPECT_EQ(term->supports(Curvature::Majorizer), p.majorizer) << p.name;
    EXPECT_EQ(term->supports(Curvature::CompositeMajorizer), p.composite_majorizer) << p.name;
    EXPECT_EQ(term->supports(Curvature::Reweighted), p.reweighted) << p.name;
  }
}

// Value and gradient do not depend on the model.
TEST(BuiltinCurvature, ModelsShareTheGradient) {
  for (const EnergyProperties& p : test::documented_properties()) {
    const test::Triangles t(1);
    const auto term = find_energy(p.name)->make(t.space, t.rest, {lattice_rule(1)});
    const Jacobians j = jacobians(p.everywhere);
    const auto exact = models(p.name, j, Curvature::Exact);
    for (const Curvature c : kCurvatures) {
      if (!term->supports(c)) continue;
      const auto other = models(p.name, j, c);
      for (std::size_t e = 0; e < j.size(); ++e)
        EXPECT_LE((other[e].gradient - exact[e].gradient).norm(),
                  1e-14 * (exact[e].gradient.norm() + exact[e].hessian.norm() * j[e].norm()))
            << p.name << ", " << describe(j[e]);
    }
  }
}

TEST(BuiltinCurvature, ProjectedIsTheClampedExactHessian) {
  for (const EnergyProperties& p : test::documented_properties()) {
    const Jacobians j = jacobians(p.everywhere);
    const auto projected = models(p.name, j, Curvature::Projected);
    int indefinite = 0;
    for (std::size_t e = 0; e < j.size(); ++e) {
      const Matrix4 exact = test::builtin_oracle(p.name, j[e]).hessian;
      indefinite += test::smallest_eigenvalue(exact) < -1e-6 * exact.norm();
      const double tol = p.name == "log-isometric" ? 1e-9 : 1e-12;
      EXPECT_LE((projected[e].hessian - test::clamp_eigenvalues(exact)).norm(), tol * exact.norm())
          << p.name << ", " << describe(j[e]);
    }
    EXPECT_EQ(indefinite > 5, p.name != "asap") << p.name;
  }
}

// H_exact + t (H_projected - H_exact), both from automatic differentiation.
TEST(BuiltinCurvature, BlendsLieBetweenTheExactAndTheProjectedHessian) {
  for (const double t : {0.0, 0.061, 0.5, 1.0})
    for (const EnergyProperties& p : test::documented_properties()) {
      const Jacobians j = jacobians(p.everywhere);
      const auto blended = models(p.name, j, BlendedCurvature::projected(t));
      for (std::size_t e = 0; e < j.size(); ++e) {
        const Matrix4 exact = test::builtin_oracle(p.name, j[e]).hessian;
        const Matrix4 expected = (1 - t) * exact + t * test::clamp_eigenvalues(exact);
        const double tol = p.name == "log-isometric" ? 1e-9 : 1e-12;
        EXPECT_LE((blended[e].hessian - expected).norm(), tol * exact.norm())
            << p.name << ", t = " << t << ", " << describe(j[e]);
      }
    }
}

// Log-isometric is concave along stretches above e: the radial 2x2 block needs projection there.
TEST(BuiltinCurvature, ProjectionSeesTheRadialBlock) {
  const Jacobians j{test::from_parts(Vector2(4, 0), Vector2(0.5, 0)),
                    test::from_parts(Vector2(0, 5), Vector2(0.7, 0.7)),
                    test::from_parts(Vector2(3, 4), Vector2(0, 0))};
  const auto projected = models("log-isometric", j, Curvature::Projected);
  for (std::size_t e = 0; e < j.size(); ++e) {
    const Matrix4 exact = test::builtin_oracle("log-isometric", j[e]).hessian;
    const Vector4 x(j[e](0, 0), j[e](0, 1), j[e](1, 0), j[e](1, 1));
    EXPECT_LT(x.dot(exact * x), 0);
    EXPECT_GE(test::smallest_eigenvalue(projected[e].hessian), -1e-14);
    EXPECT_LE((projected[e].hessian - test::clamp_eigenvalues(exact)).norm(), 1e-10);
  }
}

TEST(BuiltinCurvature, AllButExactArePositiveSemidefinite) {
  for (const EnergyProperties& p : test::documented_properties()) {
    const test::Triangles t(1);
    const auto term = find_energy(p.name)->make(t.space, t.rest, {lattice_rule(1)});
    const Jacobians j = jacobians(p.everywhere);
    for (const Curvature c : kCurvatures) {
      if (c == Curvature::Exact || !term->supports(c)) continue;
      const auto all = models(p.name, j, c);
      for (std::size_t e = 0; e < j.size(); ++e)
        EXPECT_GE(test::smallest_eigenvalue(all[e].hessian), -1e-12 * all[e].hessian.norm())
            << p.name << ", model " << static_cast<int>(c) << ", " << describe(j[e]);
    }
  }
}

// Very small, very large, thin and similar Jacobians: finite numbers, and no negative eigenvalue
// except by rounding.
TEST(BuiltinCurvature, ExtremesStayFiniteAndSemidefinite) {
  test::Random random(31);
  Jacobians j;
  for (const double scale : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double ratio : {0.0, 1e-300, 1e-160, 1e-30, 1e-8, 0.5, 1 - 1e-3, 1 - 1e-6}) {
      const Vector2 alpha = scale * direction(random);
      j.push_back(test::from_parts(alpha, scale * ratio * direction(random)));
    }
  for (const EnergyProperties& p : test::documented_properties()) {
    const test::Triangles t(1);
    const auto term = find_energy(p.name)->make(t.space, t.rest, {lattice_rule(1)});
    int compared = 0;
    for (const Curvature c : kCurvatures) {
      if (!term->supports(c)) continue;
      const auto all = models(p.name, j, c);
      for (std::size_t e = 0; e < j.size(); ++e) {
        if (!(all[e].value < 1e280)) continue;  // overflow: outside the domain
        ++compared;
        EXPECT_TRUE(test::finite(all[e])) << p.name << ", " << describe(j[e]);
        if (c != Curvature::Exact && test::finite(all[e])) {
          EXPECT_GE(test::smallest_eigenvalue(all[e].hessian), -1e-11 * all[e].hessian.norm())
              << p.name << ", model " << static_cast<int>(c) << ", " << describe(j[e]);
        }
      }
    }
    EXPECT_GE(compared, p.name == "amips-exponential" ? 12 : 80) << p.name;
  }
}

// +inf where the determinant is not positive, unless the energy is defined everywhere.
TEST(BuiltinCurvature, DomainsAreKept) {
  Jacobians outside{test::from_parts(Vector2(0, 0), Vector2(1, 0)),
                    test::from_parts(Vector2(0.5, 0.5), Vector2(1, 0)),
                    test::from_parts(Vector2(1, 0), Vector2(0, 1)), Eigen::Matrix2d::Zero(),
                    test::from_parts(Vector2(1, 0), Vector2(0, 1 + 1e-12))};
  for (const EnergyProperties& p : test::documented_properties())
    for (const Curvature c : {Curvature::Exact, Curvature::Projected}) {
      const auto all = models(p.name, outside, c);
      for (std::size_t e = 0; e < outside.size(); ++e) {
        EXPECT_EQ(std::isfinite(all[e].value), p.everywhere) << p.name << describe(outside[e]);
        EXPECT_FALSE(std::isnan(all[e].value)) << p.name;
      }
    }
}

TEST(BuiltinCurvature, MajorizersAreOrdered) {
  for (const EnergyProperties& p : test::documented_properties()) {
    if (!p.majorizer) continue;
    const Jacobians j = jacobians(p.everywhere);
    const auto majorizer = models(p.name, j, Curvature::Majorizer);
    std::vector<PointResult> paper;
    if (p.composite_majorizer) paper = models(p.name, j, Curvature::CompositeMajorizer);
    for (std::size_t e = 0; e < j.size(); ++e) {
      const Matrix4 exact = test::builtin_oracle(p.name, j[e]).hessian;
      EXPECT_GE(test::smallest_eigenvalue(majorizer[e].hessian - exact), -1e-12 * exact.norm())
          << p.name << ", " << describe(j[e]);
      if (!paper.empty()) {
        EXPECT_GE(test::smallest_eigenvalue(paper[e].hessian - majorizer[e].hessian),
                  -1e-12 * paper[e].hessian.norm())
            << p.name << ", " << describe(j[e]);
      }
    }
  }
}

Eigen::Matrix<double, 2, 4> alpha_rows() {  // alpha = P x
  Eigen::Matrix<double, 2, 4> p;
  p << 0.5, 0, 0, 0.5, 0, -0.5, 0.5, 0;
  return p;
}
Eigen::Matrix<double, 2, 4> beta_rows() {
  Eigen::Matrix<double, 2, 4> q;
  q << 0.5, 0, 0, -0.5, 0, 0.5, 0.5, 0;
  return q;
}

// method.md section 3: (2/v) |dx - x (grad v . dx) / v|^2 + (2F/v^2) |d beta|^2.
TEST(BuiltinCurvature, MipsMajorizerIsTheFormOfSection3) {
  const Jacobians j = jacobians(false);
  const auto majorizer = models("mips", j, Curvature::Majorizer);
  for (std::size_t e = 0; e < j.size(); ++e) {
    const double a = j[e](0, 0), b = j[e](0, 1), c = j[e](1, 0), d = j[e](1, 1);
    const double v = a * d - b * c, f = j[e].squaredNorm();
    const Vector4 x(a, b, c, d), dv(d, -c, -b, a);
    const Matrix4 residual = Matrix4::Identity() - x * dv.transpose() / v;
    const Matrix4 expected = 2 / v * residual.transpose() * residual +
                             2 * f / (v * v) * beta_rows().transpose() * beta_rows();
    EXPECT_LE((majorizer[e].hessian - expected).norm(), 1e-12 * expected.norm()) << describe(j[e]);
    // E10: its difference from the Hessian is (2F/v^2) |d alpha|^2.
    const Matrix4 added = majorizer[e].hessian - test::builtin_oracle("mips", j[e]).hessian;
    EXPECT_LE((added - 2 * f / (v * v) * alpha_rows().transpose() * alpha_rows()).norm(),
              1e-11 * expected.norm());
  }
}

// E9: the majorizer of the paper has an unnecessary term 4 |beta| hess |alpha|.
TEST(BuiltinCurvature, AsapCompositeMajorizerHasTheSuperfluousTerm) {
  const Jacobians j = test::generic_jacobians(true, 60);
  const auto exact = models("asap", j, Curvature::Exact);
  const auto projected = models("asap", j, Curvature::Projected);
  const auto majorizer = models("asap", j, Curvature::Majorizer);
  const auto paper = models("asap", j, Curvature::CompositeMajorizer);
  const Matrix4 constant = 8 * beta_rows().transpose() * beta_rows();
  for (std::size_t e = 0; e < j.size(); ++e) {
    EXPECT_LE((exact[e].hessian - constant).norm(), 1e-14);
    EXPECT_LE((projected[e].hessian - constant).norm(), 1e-14);
    EXPECT_LE((majorizer[e].hessian - constant).norm(), 1e-14);
    const Eigen::Matrix2d& m = j[e];
    const Vector4 x(m(0, 0), m(0, 1), m(1, 0), m(1, 1));
    const Vector2 alpha = alpha_rows() * x;
    const double a = alpha.norm();
    const Vector2 perp(-alpha[1] / a, alpha[0] / a);
    const Matrix4 hess = alpha_rows().transpose() * perp * perp.transpose() * alpha_rows() / a;
    const Matrix4 expected = constant + 4 * test::norm_beta(m) * hess;
    EXPECT_LE((paper[e].hessian - expected).norm(), 1e-12 * expected.norm()) << describe(m);
    EXPECT_GT((paper[e].hessian - constant).norm(), 1e-3);
  }
}

// ---- Reweighting ----

// Returns w(t) = p'(t) / (2 (t - 1)), with (t - 1) divided out by hand.
double weight(const std::string& name, double t) {
  if (name == "symmetric-dirichlet") return (t + 1) * (t * t + 1) / (t * t * t);
  if (name == "arap") return 1;
  if (name == "symmetric-arap") return 1 + 1 / (t * t * t);
  if (name == "log-isometric") return t == 1 ? 1 : std::log1p(t - 1) / (t - 1) / t;
  ADD_FAILURE() << name;
  return 0;
}

// Returns 2 (W^2 (x) I) by an SVD. W^2 does not depend on signs of singular vectors.
Matrix4 reweighted(const std::string& name, const Eigen::Matrix2d& j) {
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(j, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double S = svd.singularValues()[0],
               s = std::copysign(svd.singularValues()[1], j.determinant());
  const Eigen::Matrix2d w2 = svd.matrixU() *
                             Vector2(weight(name, S), weight(name, s)).asDiagonal() *
                             svd.matrixU().transpose();
  Matrix4 h = Matrix4::Zero();  // x row by row: W^2 acts from the left
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k)
      h.block<2, 2>(2 * i, 2 * k) = 2 * w2(i, k) * Eigen::Matrix2d::Identity();
  return h;
}

// Returns Jacobians with one or both singular values within one bit to far from 1.
Jacobians around_one() {
  test::Random random(23);
  Jacobians out;
  const double offsets[] = {0, 1e-15, -1e-12, 3e-9, -1e-7, 9.9e-7, -1.1e-6, 1e-5, -1e-3, 0.3, -0.4};
  for (const double p : offsets)
    for (const double q : offsets) {
      const Eigen::Matrix2d u = test::from_parts(direction(random), Vector2(0, 0));
      const Eigen::Matrix2d v = test::from_parts(direction(random), Vector2(0, 0));
      out.push_back(u * Vector2(1 + p, 1 + q).asDiagonal() * v);
    }
  return out;
}

TEST(BuiltinCurvature, ReweightedIsTheSvdForm) {
  int compared = 0;
  for (const EnergyProperties& p : test::documented_properties()) {
    if (!p.reweighted) continue;
    Jacobians all = jacobians(p.everywhere);
    for (const auto& j : around_one()) all.push_back(j);
    const auto proxy = models(p.name, all, Curvature::Reweighted);
    for (std::size_t e = 0; e < all.size(); ++e) {
      const Matrix4 expected = reweighted(p.name, all[e]);
      const Eigen::JacobiSVD<Eigen::Matrix2d> svd(all[e]);
      const double closest = (svd.singularValues().array() - 1).abs().minCoeff();
      // Within 1e-6 of 1 the library uses the limit w(1); outside, the quotient has lost 1 / |t -
      // 1|.
      const double tol = closest < 1.1e-6 ? 6e-6 : 1e-11 + 1e-14 / closest;
      EXPECT_LE((proxy[e].hessian - expected).norm(), tol * expected.norm())
          << p.name << ", " << describe(all[e]) << ", closest " << closest;
      ++compared;
    }
  }
  EXPECT_GT(compared, 900);
}

// The definition of the model: the proxy |W (J - R)|^2 has the energy's gradient at J.
TEST(BuiltinCurvature, ReweightedProxyHasTheGradient) {
  for (const EnergyProperties& p : test::documented_properties()) {
    if (!p.reweighted) continue;
    const Jacobians all = test::generic_jacobians(p.everywhere, 100);
    const auto proxy = models(p.name, all, Curvature::Reweighted);
    for (std::size_t e = 0; e < all.size(); ++e) {
      const Eigen::Matrix2d& j = all[e];
      const double a = test::norm_alpha(j);
      const Eigen::Matrix2d r =
          test::from_parts(Vector2(j(0, 0) + j(1, 1), j(1, 0) - j(0, 1)) / (2 * a), Vector2(0, 0));
      const Eigen::Matrix2d d = j - r;
      const Vector4 step(d(0, 0), d(0, 1), d(1, 0), d(1, 1));
      EXPECT_LE((proxy[e].hessian * step - proxy[e].gradient).norm(),
                1e-10 * (proxy[e].gradient.norm() + proxy[e].hessian.norm()))
          << p.name << ", " << describe(j);
    }
  }
}

// A problem that a caller builds is refused, too.
TEST(BuiltinCurvature, NewtonRefusesUnsupportedCurvature) {
  const test::Triangles t(1);
  for (const auto& [energy, curvature] : {std::pair("mips", Curvature::CompositeMajorizer),
                                          {"mips", Curvature::Reweighted},
                                          {"asap", Curvature::Reweighted},
                                          {"log-isometric", Curvature::Majorizer}}) {
    ProblemBuilder builder(6);
    builder.add(find_energy(energy)->make(t.space, t.rest, {lattice_rule(1)}), 1.0);
    NewtonOptions options;
    options.curvature = curvature;
    EXPECT_THROW(NewtonStepper(builder.build(), options), InvalidArgument) << energy;
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
