// The untangling energy against reference values in long double, on both sides of det J = 0 and
// down to the smallest eps.
#include "majorant/energies/untangling.h"

#include <gtest/gtest.h>

#include "energies/density_fixture.h"

namespace majorant {
namespace {

using test::Jet;

using test::kUnit;

// Returns (|J|^2 + lambda (D^2 + 1)) / chi, with chi in both published forms.
auto direct(double eps, double lambda) {
  return [=](const Jet& a, const Jet& b, const Jet& c, const Jet& d) -> Jet {
    const Jet det = a * d - b * c, norm = a * a + b * b + c * c + d * d;
    const Jet root = sqrt(det * det + Jet(eps * eps));
    const Jet chi = det.v > 0 ? (det + root) * Jet(0.5) : Jet(0.5 * eps) * Jet(eps) / (root - det);
    return (norm + Jet(lambda) * (det * det + Jet(1.0))) / chi;
  };
}

// Returns Jacobians with determinants of both signs, zero and nearly zero, J = 0 and similarities.
std::vector<Eigen::Matrix2d> jacobians() {
  std::vector<Eigen::Matrix2d> out{Eigen::Matrix2d::Zero(),
                                   Eigen::Matrix2d::Identity(),
                                   -Eigen::Matrix2d::Identity(),
                                   Vector2(1, -1).asDiagonal().toDenseMatrix(),
                                   Vector2(1, 0).asDiagonal().toDenseMatrix(),
                                   Vector2(2, 1e-7).asDiagonal().toDenseMatrix(),
                                   Vector2(2, -1e-7).asDiagonal().toDenseMatrix()};
  test::Random random(7);
  for (int k = 0; k < 60; ++k) {
    Eigen::Matrix2d j;
    for (double& entry : j.reshaped()) entry = random.uniform(-2, 2);
    out.push_back(j);
  }
  return out;
}

TEST(UntanglingDensity, Derivatives) {
  const std::vector<Eigen::Matrix2d> points = jacobians();
  const test::Triangles t(points.size());
  for (const double lambda : {1.0, 0.2})
    for (const double eps : {1.0, 0.1, 1e-3, 1e-8}) {
      const auto term =
          make_energy(t.space, t.rest, UntanglingDensity(eps, lambda), {lattice_rule(1)});
      const auto models = test::point_models(*term, points, Curvature::Exact);
      for (std::size_t e = 0; e < points.size(); ++e) {
        const Eigen::Matrix2d& j = points[e];
        const test::PointResult o = test::oracle(direct(eps, lambda), j);
        SCOPED_TRACE(testing::Message() << "eps " << eps << " det " << j.determinant());
        // det J = |alpha|^2 - |beta|^2 cancels; its error is relative to det and eps.
        const double tol = 1e-13 + 64 * kUnit * j.squaredNorm() / std::hypot(j.determinant(), eps);
        const double size = j.norm(), h = o.hessian.norm();
        ASSERT_TRUE(std::isfinite(models[e].value) && models[e].hessian.allFinite());
        EXPECT_NEAR(models[e].value, o.value, tol * (o.value + h * size * size));
        EXPECT_LE((models[e].gradient - o.gradient).norm(), tol * (o.gradient.norm() + h * size));
        EXPECT_LE((models[e].hessian - o.hessian).norm(), tol * h);
      }
    }
}

// The value of an isometry, 4 / chi(eps, 1), tends to 4; values of inverted Jacobians grow without
// bound.
TEST(UntanglingDensity, BarrierAsEpsShrinks) {
  const std::vector<Eigen::Matrix2d> points = jacobians();
  const test::Triangles t(points.size());
  const auto at_eps = [&](double eps) {
    return test::point_models(
        *make_energy(t.space, t.rest, UntanglingDensity(eps), {lattice_rule(1)}), points,
        Curvature::Exact);
  };
  const auto large = at_eps(1e-2), small = at_eps(1e-6);
  EXPECT_NEAR(small[1].value, 4, 1e-11);
  for (std::size_t e = 0; e < points.size(); ++e) {
    if (points[e].determinant() > 0) continue;
    EXPECT_GT(small[e].value, 1e3 * large[e].value) << points[e];
  }
}

TEST(UntanglingDensity, ProjectedIsSemidefinite) {
  const std::vector<Eigen::Matrix2d> points = jacobians();
  const test::Triangles t(points.size());
  for (const double eps : {0.1, 1e-6}) {
    const auto term = make_energy(t.space, t.rest, UntanglingDensity(eps), {lattice_rule(1)});
    for (const auto& model : test::point_models(*term, points, Curvature::Projected)) {
      const double low = test::smallest_eigenvalue(model.hessian);
      EXPECT_GE(low, -1e-12 * model.hessian.norm());
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
