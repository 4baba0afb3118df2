// The result type against definitions: Bernstein sums, finite differences, Eigen's SVD.
#include "majorant/maps/bezier_map.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "majorant/elements/bernstein.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"
#include "singular_values.h"

namespace majorant {
namespace {

// Returns a map without symmetry on a bumpy patch; it need not be injective.
BezierMap wild(int degree, unsigned seed = 1) {
  const auto mesh = surface(grid(2, bumpy));
  const Vec uv = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x() + p.z(), p.y()); });
  return shaken(elevated_to(BezierMap::linear(mesh, uv), degree), 0.2, seed);
}

double power(double x, int n) { return n == 0 ? 1 : x * power(x, n - 1); }
double factorial(int n) { return n == 0 ? 1 : n * factorial(n - 1); }

Vector2 bernstein_sum(const BezierMap& map, Index f, const Barycentric& xi) {
  const int n = map.degree();
  const TriangleIndices& ix = TriangleIndices::of_degree(n);
  Vector2 sum = Vector2::Zero();
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n - i; ++j) {
      const int k = n - i - j;
      const Index node = map.space().cells()(f, ix.local(i, j, k));
      sum += factorial(n) / (factorial(i) * factorial(j) * factorial(k)) * power(xi[0], i) *
             power(xi[1], j) * power(xi[2], k) * map.control_points().segment<2>(2 * node);
    }
  return sum;
}

// Returns corner positions in the face's frame: p2 at the origin, p0 on the first axis.
Eigen::Matrix<double, 2, 3> frame(const SurfaceMesh& mesh, Index f) {
  const Vector3 p0 = mesh.positions().row(mesh.faces()(f, 0)),
                p1 = mesh.positions().row(mesh.faces()(f, 1)),
                p2 = mesh.positions().row(mesh.faces()(f, 2));
  const Vector3 x = (p0 - p2).normalized();
  const Vector3 y = (p0 - p2).cross(p1 - p2).cross(x).normalized();
  Eigen::Matrix<double, 2, 3> local;
  local << (p0 - p2).norm(), (p1 - p2).dot(x), 0, 0, (p1 - p2).dot(y), 0;
  return local;
}

TEST(BezierMap, EvaluatesTheBernsteinSum) {
  std::mt19937 random(5);
  for (int degree = 1; degree <= 8; ++degree) {
    const BezierMap map = wild(degree);
    for (Index f = 0; f < map.mesh().face_count(); ++f)
      for (int repeat = 0; repeat < 5; ++repeat) {
        const Barycentric xi = random_point(random);
        EXPECT_LT((map.evaluate(f, xi) - bernstein_sum(map, f, xi)).norm(), 1e-13) << degree;
      }
  }
}

TEST(BezierMap, InterpolatesCorners) {
  const BezierMap map = wild(5);
  for (Index f = 0; f < map.mesh().face_count(); ++f)
    for (int k = 0; k < 3; ++k)
      EXPECT_LT((map.evaluate(f, Barycentric::Unit(k)) -
                 map.control_points().segment<2>(2 * map.mesh().faces()(f, k)))
                    .norm(),
                1e-15);
}

TEST(BezierMap, JacobianAgreesWithFiniteDifferences) {
  std::mt19937 random(6);
  for (int degree = 1; degree <= 8; ++degree) {
    const BezierMap map = wild(degree);
    for (Index f = 0; f < map.mesh().face_count(); ++f) {
      const Eigen::Matrix<double, 2, 3> local = frame(map.mesh(), f);
      Eigen::Matrix3d system;
      system << local, Eigen::RowVector3d::Ones();
      const Barycentric xi = random_point(random);
      const Eigen::Matrix2d j = map.jacobian(f, xi);
      for (int c = 0; c < 2; ++c) {
        constexpr double h = 1e-5;
        const Eigen::Vector3d step = system.inverse() * (h * Eigen::Vector3d::Unit(c));
        const Vector2 difference =
            (map.evaluate(f, xi + step) - map.evaluate(f, xi - step)) / (2 * h);
        EXPECT_LT((difference - j.col(c)).norm(), 1e-6 * (1 + j.norm())) << degree << ' ' << f;
      }
    }
  }
}

TEST(BezierMap, JacobianOfAnAffineMapIsItsMatrix) {
  const auto mesh = surface(grid(2));
  const Vec uv = uv_of(*mesh, [](const Vector3& p) {
    return Vector2(2 * p.x() + 0.5 * p.y() + 7, -p.x() + 3 * p.y());
  });
  Eigen::Matrix2d a;
  a << 2, 0.5, -1, 3;
  for (int degree = 1; degree <= 8; ++degree) {
    const BezierMap map = elevated_to(BezierMap::linear(mesh, uv), degree);
    for (Index f = 0; f < mesh->face_count(); ++f) {
      const Eigen::Matrix2d j = map.jacobian(f, Barycentric(0.2, 0.5, 0.3));
      EXPECT_NEAR(j.determinant(), a.determinant(), 1e-12);
      EXPECT_NEAR(j.squaredNorm(), a.squaredNorm(), 1e-12);  // up to a rotation of the frame
    }
  }
}

TEST(BezierMap, SingularValuesAreEigensWithTheSignOfTheDeterminant) {
  std::mt19937 random(7);
  int negative = 0;
  for (const int degree : {1, 2, 3, 6})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const BezierMap map = wild(degree, seed);
      for (Index f = 0; f < map.mesh().face_count(); ++f) {
        const Barycentric xi = random_point(random);
        const Eigen::Matrix2d j = map.jacobian(f, xi);
        const Eigen::Vector2d s = test::singular_values(j);
        const auto [first, second] = map.singular_values(f, xi);
        EXPECT_NEAR(first, s[0], 1e-13 * s[0]);
        EXPECT_NEAR(second, j.determinant() < 0 ? -s[1] : s[1], 1e-13 * s[0]);
        negative += j.determinant() < 0;
      }
    }
  EXPECT_GT(negative, 0) << "no inverted sample: the sign was not tested";
}

TEST(BezierMap, ElevationIsTheSameMap) {
  std::mt19937 random(8);
  const BezierMap low = wild(2);
  BezierMap map = low;
  while (map.degree() < BezierTriangleSpace::kMaxDegree) {
    const BezierMap higher = map.elevated();
    EXPECT_EQ(higher.degree(), map.degree() + 1);
    for (Index f = 0; f < map.mesh().face_count(); ++f) {
      const Barycentric xi = random_point(random);
      EXPECT_LT((higher.evaluate(f, xi) - low.evaluate(f, xi)).norm(), 1e-13);
      EXPECT_LT((higher.jacobian(f, xi) - low.jacobian(f, xi)).norm(), 1e-11);
    }
    map = higher;
  }
  EXPECT_ANY_THROW(map.elevated());
}

// The doubles of corners are the same at every degree.
TEST(BezierMap, ElevationKeepsVerticesBitwise) {
  const BezierMap low = wild(1);
  const BezierMap high = elevated_to(low, 8);
  EXPECT_EQ(high.control_points().head(low.control_points().size()), low.control_points());
}

TEST(BezierMap, IsContinuousAcrossEdges) {
  const BezierMap map = wild(5);
  const Cells& faces = map.mesh().faces();
  int shared = 0;
  for (Index f = 0; f < faces.rows(); ++f)
    for (Index g = 0; g < f; ++g)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          if (faces(f, a) == faces(g, (b + 1) % 3) && faces(f, (a + 1) % 3) == faces(g, b))
            for (const double t : {0.0, 0.3, 0.8, 1.0}) {
              ++shared;
              const Barycentric xi =
                  (1 - t) * Barycentric::Unit(a) + t * Barycentric::Unit((a + 1) % 3);
              const Barycentric eta =
                  (1 - t) * Barycentric::Unit((b + 1) % 3) + t * Barycentric::Unit(b);
              EXPECT_LT((map.evaluate(f, xi) - map.evaluate(g, eta)).norm(), 1e-14);
            }
  EXPECT_EQ(shared, 4 * 8);  // eight inner edges
}

TEST(BezierMap, SamplesFaceByFace) {
  const BezierMap map = wild(4);
  std::mt19937 random(9);
  const std::vector<Barycentric> points{random_point(random), random_point(random),
                                        random_point(random)};
  const Points2 uv = map.sample(points);
  ASSERT_EQ(uv.rows(), 3 * map.mesh().face_count());
  for (Index f = 0; f < map.mesh().face_count(); ++f)
    for (Index l = 0; l < 3; ++l)
      EXPECT_LT((uv.row(3 * f + l).transpose() - map.evaluate(f, points[l])).norm(), 1e-14);
}

TEST(BezierMap, RefinementSharesPointsAndReproducesTheMap) {
  const BezierMap map = wild(3);
  const Topology& t = map.mesh().topology();
  for (int k = 1; k <= 5; ++k) {
    const BezierMap::Refinement r = map.refine(k);
    const Index points = t.vertices + t.edges * (k - 1) + t.faces * (k - 1) * (k - 2) / 2;
    EXPECT_EQ(r.positions.rows(), points);
    EXPECT_EQ(r.uv.rows(), points);
    ASSERT_EQ(r.triangles.rows(), t.faces * k * k);
    EXPECT_EQ(r.positions.topRows(t.vertices), map.mesh().positions());
    double area = 0;
    for (Index f = 0; f < t.faces; ++f) {
      const Eigen::Matrix<double, 2, 3> local = frame(map.mesh(), f);
      const Vector3 p0 = map.mesh().positions().row(map.mesh().faces()(f, 0)),
                    p1 = map.mesh().positions().row(map.mesh().faces()(f, 1)),
                    p2 = map.mesh().positions().row(map.mesh().faces()(f, 2));
      const Vector3 normal = (p1 - p0).cross(p2 - p0).normalized();
      Eigen::Matrix3d corners;
      corners << p0, p1, p2;
      for (Index s = f * k * k; s < (f + 1) * k * k; ++s) {
        Vector3 q[3];
        for (int c = 0; c < 3; ++c) {
          q[c] = r.positions.row(r.triangles(s, c));
          // Barycentric coordinates of the point on face f, by least squares.
          Eigen::Matrix<double, 4, 3> system;
          system << corners, Eigen::RowVector3d::Ones();
          Eigen::Vector4d rhs;
          rhs << q[c], 1;
          const Barycentric xi =
              (system.transpose() * system).inverse() * (system.transpose() * rhs);
          EXPECT_LT((system * xi - rhs).norm(), 1e-10) << "not on face " << f;
          EXPECT_LT((map.evaluate(f, xi) - r.uv.row(r.triangles(s, c)).transpose()).norm(), 1e-9);
        }
        const double part = 0.5 * (q[1] - q[0]).cross(q[2] - q[0]).dot(normal);
        EXPECT_NEAR(part, 0.5 * local(0, 0) * local(1, 1) / (k * k), 1e-12);
        area += part;
      }
    }
    EXPECT_NEAR(area, map.mesh().area(), 1e-12);
  }
  EXPECT_ANY_THROW(map.refine(0));
}

TEST(BezierMap, RefusesControlPointsThatDoNotFit) {
  const auto mesh = surface(grid(2));
  EXPECT_ANY_THROW(BezierMap::linear(mesh, Vec::Zero(2 * mesh->vertex_count() - 2)));
}

TEST(BezierMap, GivesArrays) {
  for (const int degree : {1, 3}) {
    const BezierMap map = wild(degree);
    const Points2 corners = map.corner_uv();
    ASSERT_EQ(corners.rows(), 3 * map.mesh().face_count());
    for (Index f = 0; f < map.mesh().face_count(); ++f)
      for (int k = 0; k < 3; ++k) {
        const Vector2 uv = map.evaluate(f, Barycentric::Unit(k));
        EXPECT_LT((corners.row(3 * f + k).transpose() - uv).norm(), 1e-14);
      }
    const auto rows = map.control_uv();
    ASSERT_EQ(rows.rows(), map.space().node_count());
    EXPECT_EQ(rows.data(), map.control_points().data()) << "a view";
    EXPECT_EQ(Vector2(rows.row(5)), Vector2(map.control_points().segment<2>(10)));
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
