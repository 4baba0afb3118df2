// Curvature models: positive semidefinite, ordered, and equal to their definitions.
#include <gtest/gtest.h>

#include "energies/density_fixture.h"
#include "majorant/energies/vectorized.h"

namespace majorant {
namespace {

using test::Matrix4;
using test::PointResult;
using Jacobians = std::vector<Eigen::Matrix2d>;

using test::kUnit;

// Returns the relative accuracy of a Hessian for comparisons.
double accuracy(const Eigen::Matrix2d& j) {
  const double ratio = test::norm_beta(j) / test::norm_alpha(j);
  return 1e-12 + 32 * kUnit * test::cancellation(j) + 32 * kUnit / std::max(ratio, 1e-5) +
         (ratio < 1.01e-5 ? 20 * ratio * ratio : 0);
}

struct Case {
  const char* name;
  std::shared_ptr<const EnergyTerm> term;
  // Convex energies with all models compiled for one instruction set, so that their Hessians have
  // equal rounding errors.
  std::shared_ptr<const EnergyTerm> of_one_set;
  PointResult (*oracle)(const Eigen::Matrix2d&);
  Jacobians jacobians;
  bool convex;
};

std::vector<Case> cases() {
  const Jacobians positive = test::injective_jacobians();
  Jacobians moderate;
  for (const Eigen::Matrix2d& j : test::all_jacobians())
    if (j.norm() > 1e-2 && j.norm() < 100 && test::norm_alpha(j) > 1e-3) moderate.push_back(j);
  const test::Triangles t(positive.size()), m(moderate.size());
  const std::vector<Quadrature> rule{lattice_rule(1)};
  const auto sd = [](const Eigen::Matrix2d& j) {
    return test::oracle(test::direct_symmetric_dirichlet, j);
  };
  const auto mips = [](const Eigen::Matrix2d& j) { return test::oracle(test::direct_mips, j); };
  const auto arap = [](const Eigen::Matrix2d& j) { return test::oracle(test::direct_arap, j); };
  const auto of_one_set = [&rule](const test::Triangles& on, const auto& density) {
    return make_energy(on.space, on.rest, density, rule, vectorized(density));
  };
  return {
      {"symmetric Dirichlet, dispatched", symmetric_dirichlet()(t.space, t.rest, rule),
       test::baseline("symmetric-dirichlet")(t.space, t.rest, rule), sd, positive, true},
      {"symmetric Dirichlet, spectral",
       make_energy(t.space, t.rest, test::spectral_symmetric_dirichlet(), rule),
       of_one_set(t, test::spectral_symmetric_dirichlet()), sd, positive, true},
      {"MIPS", make_energy(t.space, t.rest, test::mips(), rule), nullptr, mips, positive, false},
      {"MIPS, spectral", make_energy(t.space, t.rest, test::spectral_mips(), rule), nullptr, mips,
       positive, false},
      {"ARAP", make_energy(m.space, m.rest, test::arap(), rule), of_one_set(m, test::arap()), arap,
       moderate, true},
  };
}

template <class Check>
void for_each(const Check& check) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    check(c);
  }
}

// Calls check for each density with a majorizer.
template <class Check>
void for_each_convex(const Check& check) {
  int checked = 0;
  for_each([&](const Case& c) {
    if (c.convex) check(c);
    checked += c.convex;
  });
  EXPECT_GE(checked, 3);
}

using test::describe;

TEST(CurvatureModels, SupportsFollowsConvexity) {
  for_each([](const Case& c) {
    EXPECT_TRUE(c.term->supports(Curvature::Exact));
    EXPECT_TRUE(c.term->supports(Curvature::Projected));
    EXPECT_EQ(c.term->supports(Curvature::Majorizer), c.convex);
    EXPECT_EQ(c.term->supports(Curvature::CompositeMajorizer), c.convex);
  });
}

TEST(CurvatureModels, ModelsArePositiveSemidefinite) {
  for_each([](const Case& c) {
    for (const Curvature curvature :
         {Curvature::Projected, Curvature::Majorizer, Curvature::CompositeMajorizer}) {
      if (!c.term->supports(curvature)) continue;
      const auto models = test::point_models(*c.term, c.jacobians, curvature);
      const auto elements = test::element_models(*c.term, test::corners_of(c.jacobians), curvature);
      for (std::size_t e = 0; e < models.size(); ++e) {
        const Matrix4& h = models[e].hessian;
        EXPECT_GE(test::smallest_eigenvalue(h), -1e-12 * h.trace())
            << describe(c.jacobians[e]) << ", model " << static_cast<int>(curvature);
        EXPECT_GT(h.trace(), 0);
        const Eigen::MatrixXd& full = elements.hessians[e];
        EXPECT_GE(test::smallest_eigenvalue(full), -1e-12 * full.trace());
      }
    }
  });
}

// method.md section 5: clamping coefficients in the (alpha, beta) frame equals clamping the
// eigenvalues of the exact 4x4 Hessian.
TEST(CurvatureModels, ProjectionIsEigenvalueClamping) {
  for_each([](const Case& c) {
    const auto models = test::point_models(*c.term, c.jacobians, Curvature::Projected);
    int indefinite = 0;
    for (std::size_t e = 0; e < models.size(); ++e) {
      const Matrix4 exact = c.oracle(c.jacobians[e]).hessian;
      indefinite += test::smallest_eigenvalue(exact) < -1e-6 * exact.norm();
      EXPECT_LE((models[e].hessian - test::clamp_eigenvalues(exact)).norm(),
                accuracy(c.jacobians[e]) * 4 * exact.norm())
          << describe(c.jacobians[e]);
    }
    EXPECT_GT(indefinite, 20);
  });
}

// part: of the accuracy of a Hessian, by which the order of models may be violated.
void expect_ordered(const Case& c, const EnergyTerm& term, Curvature lower, Curvature upper,
                    double part) {
  const auto small = test::point_models(term, c.jacobians, lower);
  const auto large = test::point_models(term, c.jacobians, upper);
  for (std::size_t e = 0; e < small.size(); ++e) {
    const Eigen::Matrix2d& j = c.jacobians[e];
    const double spread = 1 + test::norm_beta(j) / test::norm_alpha(j);
    const double tolerance = (kUnit * 64 * spread + part * accuracy(j)) * large[e].hessian.norm();
    EXPECT_GE(test::smallest_eigenvalue(large[e].hessian - small[e].hessian), -tolerance)
        << describe(j);
  }
}

TEST(CurvatureModels, ProjectionIsAboveTheHessian) {
  for_each([](const Case& c) {
    expect_ordered(c, *c.term, Curvature::Exact, Curvature::Projected, 1e-3);
  });
}

TEST(CurvatureModels, MajorizersAreOrdered) {
  for_each_convex([](const Case& c) {
    // Models for comparisons are compiled for the baseline on every machine, the others are not.
    for (const auto& [term, part] : {std::pair{c.of_one_set, 1e-3}, std::pair{c.term, 1.0}}) {
      expect_ordered(c, *term, Curvature::Exact, Curvature::Majorizer, part);
      expect_ordered(c, *term, Curvature::Projected, Curvature::Majorizer, part);
    }
    expect_ordered(c, *c.term, Curvature::Majorizer, Curvature::CompositeMajorizer, 1e-3);
  });
}

// [MC20] Eq. A.1 with h'' of the singular values, built from its definition.
TEST(CurvatureModels, CompositeMajorizerIsEquationA1) {
  const Jacobians jacobians = test::injective_jacobians();
  const test::Triangles t(jacobians.size());
  const auto term = test::baseline("symmetric-dirichlet")(t.space, t.rest, {lattice_rule(1)});
  const auto models = test::point_models(*term, jacobians, Curvature::CompositeMajorizer);
  Eigen::Matrix<double, 2, 4> p, q;
  p << 0.5, 0, 0, 0.5, 0, -0.5, 0.5, 0;  // alpha = P x, beta = Q x
  q << 0.5, 0, 0, -0.5, 0, 0.5, 0.5, 0;
  int compared = 0;
  for (std::size_t e = 0; e < jacobians.size(); ++e) {
    const Eigen::Matrix2d& j = jacobians[e];
    const double a = test::norm_alpha(j), b = test::norm_beta(j);
    if (b < 1e-6 * a || test::cancellation(j) > 1e4) continue;
    ++compared;
    const test::Vector4 x(j(0, 0), j(0, 1), j(1, 0), j(1, 1));
    const Vector2 ah = (p * x) / a, bh = (q * x) / b;
    const Eigen::RowVector4d da = ah.transpose() * p, db = bh.transpose() * q;
    const Matrix4 hess_a =
        p.transpose() * (Eigen::Matrix2d::Identity() - ah * ah.transpose()) * p / a;
    const Matrix4 hess_b =
        q.transpose() * (Eigen::Matrix2d::Identity() - bh * bh.transpose()) * q / b;
    const double S = a + b, s = j.determinant() / S;
    const double hS = 2 * (S - std::pow(S, -3)), hs = 2 * (s - std::pow(s, -3));
    const Eigen::RowVector4d dS = da + db, ds = da - db;
    const auto plus = [](double v) { return std::max(v, 0.0); };
    const auto minus = [](double v) { return std::min(v, 0.0); };
    const Matrix4 expected = (2 + 6 * std::pow(S, -4)) * dS.transpose() * dS +
                             (2 + 6 * std::pow(s, -4)) * ds.transpose() * ds +
                             plus(hS) * (hess_a + hess_b) + plus(hs) * hess_a - minus(hs) * hess_b;
    EXPECT_LE((models[e].hessian - expected).norm(),
              1e-9 * expected.norm() + 1e-14 * expected.norm() * a / b)
        << describe(j);
  }
  EXPECT_GT(compared, 120);
}

// The property of a majorizer of this family: h' is convex in the linearized arguments, so H'
// bounds the exact Hessian at the same point (sampled; N1: not a global upper bound).
TEST(CurvatureModels, MajorizerBoundsTheHessianInRandomDirections) {
  test::Random random(1);
  for_each_convex([&](const Case& c) {
    const auto majorizer = test::point_models(*c.term, c.jacobians, Curvature::Majorizer);
    for (std::size_t e = 0; e < majorizer.size(); ++e) {
      const Matrix4 exact = c.oracle(c.jacobians[e]).hessian;
      for (int k = 0; k < 10; ++k) {
        const test::Vector4 d = random.vector(4);
        EXPECT_GE(d.dot(majorizer[e].hessian * d),
                  d.dot(exact * d) - accuracy(c.jacobians[e]) * 4 * exact.norm() * d.squaredNorm());
      }
    }
  });
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
