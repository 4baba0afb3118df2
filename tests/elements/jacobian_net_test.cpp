// Bernstein coefficients of J: their combination is J, and they bound convex functions of J.
#include "majorant/elements/jacobian_net.h"

#include <gtest/gtest.h>

#include "majorant/framework/error.h"
#include "random.h"
#include "singular_values.h"

namespace majorant {
namespace {

using test::Random;

struct Case {
  std::shared_ptr<const BezierTriangleSpace> space;
  RestShapes rest;
  Vec x;
};

Case random_case(Random& random, int degree) {
  Points3 positions(4, 3);
  for (Index i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) positions(i, c) = random.uniform();
  Cells faces(2, 3);
  faces << 0, 1, 2, 0, 2, 3;
  auto space = std::make_shared<const BezierTriangleSpace>(faces, 4, degree);
  const Vec x = random.vector(2 * space->node_count());
  return {space, flat_triangles(positions, faces), x};
}

// Returns J at a point, by differences of the map.
Eigen::Matrix2d jacobian_at(const Case& c, Index f, const Vector3& b) {
  const auto point = [&](const Vector3& at) {
    const Vec values = c.space->basis().values(at);
    Vector2 p = Vector2::Zero();
    for (Index k = 0; k < values.size(); ++k)
      p += values[k] * c.x.segment<2>(2 * c.space->cells()(f, k));
    return p;
  };
  constexpr double h = 1e-5;
  Eigen::Matrix2d edges;
  for (int k = 0; k < 2; ++k) {
    Vector3 d = Vector3::Zero();
    d[k] = h;
    d[2] = -h;
    edges.col(k) = (point(b + d) - point(b - d)) / (2 * h);
  }
  return edges * c.rest.inverse_of(f);
}

TEST(JacobianNet, CoefficientsCombineToTheJacobian) {
  Random random(3);
  for (int n = 1; n <= 5; ++n) {
    const Case c = random_case(random, n);
    const JacobianNet net = jacobian_net(*c.space, c.rest);
    ASSERT_EQ(net.per_face, n * (n + 1) / 2);
    for (Index f = 0; f < 2; ++f)
      for (int trial = 0; trial < 5; ++trial) {
        const Vector3 b = random.barycentric();
        // The net's own order, i first, then j, both descending.
        Eigen::Matrix2d J = Eigen::Matrix2d::Zero();
        Index t = f * net.per_face;
        for (int i = n - 1; i >= 0; --i)
          for (int j = n - 1 - i; j >= 0; --j, ++t) {
            const int l = n - 1 - i - j;
            const double weight =
                std::tgamma(n) / (std::tgamma(i + 1) * std::tgamma(j + 1) * std::tgamma(l + 1));
            J += weight * std::pow(b[0], i) * std::pow(b[1], j) * std::pow(b[2], l) *
                 jacobian_coefficient(net, t, c.x);
          }
        const Eigen::Matrix2d expected = jacobian_at(c, f, b);
        EXPECT_LT((J - expected).norm(), 1e-7 * (1 + expected.norm())) << "degree " << n;
      }
  }
}

TEST(JacobianNet, StretchIsBounded) {
  Random random(5);
  for (int n = 1; n <= 4; ++n) {
    const Case c = random_case(random, n);
    const JacobianNet net = jacobian_net(*c.space, c.rest);
    const Vec stretch = largest_stretch(net, c.x);
    for (Index t = 0; t < stretch.size(); ++t) {
      const double exact = test::singular_values(jacobian_coefficient(net, t, c.x))[0];
      EXPECT_GE(stretch[t], exact);
      EXPECT_LE(stretch[t], exact * (1 + 1e-12));
    }
    for (Index f = 0; f < 2; ++f) {
      const double bound = stretch.segment(f * net.per_face, net.per_face).maxCoeff();
      double sampled = 0;
      for (int trial = 0; trial < 200; ++trial)
        sampled =
            std::max(sampled, test::singular_values(jacobian_at(c, f, random.barycentric()))[0]);
      EXPECT_GE(bound, sampled * (1 - 1e-7));
      if (n <= 2) {  // attained at a corner
        double corner = 0;
        for (int k = 0; k < 3; ++k)
          corner = std::max(corner, test::singular_values(jacobian_at(c, f, Vector3::Unit(k)))[0]);
        EXPECT_NEAR(bound, corner, 1e-7 * bound);
      }
    }
  }
}

TEST(JacobianNet, TrianglesShareTheMeasureOfTheirFace) {
  Random random(7);
  const Case c = random_case(random, 3);
  const JacobianNet net = jacobian_net(*c.space, c.rest);
  EXPECT_NEAR(net.rest.measure.sum(), c.rest.measure.sum(), 1e-14);
  RestShapes other = c.rest;
  other.inverse.conservativeResize(1, 4);
  EXPECT_THROW(jacobian_net(*c.space, other), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
