// measure_map() against isometries, an independent Gauss rule and samples; the quadrature
// hierarchy.
#include "majorant/maps/measure.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "majorant/elements/bernstein.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/maps/extreme_samples.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "maps/test_maps.h"
#include "mesh/obj_file.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

double density(const BezierMap& map, Index f, const Barycentric& xi) {
  const Eigen::Matrix2d j = map.jacobian(f, xi);
  const double det = j.determinant();
  return det > 0 ? j.squaredNorm() * (1 + 1 / (det * det)) : INFINITY;
}

struct Gauss {
  std::vector<double> points, weights;  // on [0, 1]
  explicit Gauss(int n) {
    for (int k = 0; k < n; ++k) {
      double x = std::cos(kPi * (k + 0.75) / (n + 0.5)), derivative = 1;
      for (int newton = 0; newton < 50; ++newton) {
        double p = 1, before = 0;
        for (int i = 1; i <= n; ++i) {
          const double next = ((2 * i - 1) * x * p - (i - 1) * before) / i;
          before = p;
          p = next;
        }
        derivative = n * (x * p - before) / (x * x - 1);
        x -= p / derivative;
      }
      points.push_back(0.5 * (1 + x));
      weights.push_back(1 / ((1 - x * x) * derivative * derivative));
    }
  }
};

// Returns the mean density by n x n Gauss points on the collapsed square. Each triangle is divided
// at its centroid into three, so that the rule is symmetric in the corners.
double gauss_mean(const BezierMap& map, int n) {
  const Gauss gauss(n);
  const SurfaceMesh& mesh = map.mesh();
  const RestShapes rest = flat_triangles(mesh.positions(), mesh.faces());
  double total = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int part = 0; part < 3; ++part) {
      const Barycentric a = Barycentric::Unit(part), b = Barycentric::Unit((part + 1) % 3),
                        c = Barycentric::Constant(1.0 / 3);
      for (std::size_t i = 0; i < gauss.points.size(); ++i)
        for (std::size_t k = 0; k < gauss.points.size(); ++k) {
          const double s = gauss.points[i], t = gauss.points[k] * (1 - s);
          const double w = gauss.weights[i] * gauss.weights[k] * (1 - s) * 2 / 3;
          total += w * rest.measure[f] * density(map, f, (1 - s - t) * c + s * a + t * b);
        }
    }
  return total / rest.measure.sum();
}

// Returns an accordion-folded sheet: isometric to a planar one, but not flat.
std::shared_ptr<const SurfaceMesh> folded(Vec& flattening) {
  constexpr int n = 6;
  PolygonMesh mesh = grid(n);
  const auto plane = surface(mesh);
  flattening = uv_of(*plane, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  for (Vector3& p : mesh.positions) {
    const int i = static_cast<int>(std::lround(n * p.x()));
    p = {std::cos(0.7) * p.x(), p.y(), i % 2 == 0 ? 0 : std::sin(0.7) / n};
  }
  return surface(mesh);
}

TEST(Measure, AnIsometricFlatteningIsWorthFour) {
  Vec uv;
  const auto mesh = folded(uv);
  for (const int degree : {1, 2, 3, 5, 8}) {
    const BezierMap map = elevated_to(BezierMap::linear(mesh, uv), degree);
    const MapMeasures m = measure_map(map, {{symmetric_dirichlet()}});
    EXPECT_NEAR(m.value, 4, 1e-11) << degree;
    EXPECT_NEAR(m.max_density, 4, 1e-10) << degree;
    EXPECT_NEAR(m.sigma_max, 1, 1e-11) << degree;
    EXPECT_NEAR(m.sigma_min, 1, 1e-11) << degree;
    EXPECT_NEAR(m.min_det.minCoeff(), 1, 1e-9) << degree;
    EXPECT_LE(m.min_det.maxCoeff(), 1 + 1e-9) << degree;
    EXPECT_TRUE(m.locally_injective);
    EXPECT_EQ(m.boundary_over_full_turn, 0);
    EXPECT_NEAR(m.max_boundary_angle, kPi, 1e-9);
    EXPECT_LT((m.face_value - Vec::Constant(mesh->face_count(), 4)).cwiseAbs().maxCoeff(), 1e-10);
  }
}

TEST(Measure, AnAffineMapIsWorthItsDensity) {
  const auto mesh = surface(grid(3));
  const BezierMap map = elevated_to(
      BezierMap::linear(
          mesh, uv_of(*mesh, [](const Vector3& p) { return Vector2(2 * p.x(), 0.5 * p.y()); })),
      3);
  const MapMeasures m = measure_map(map, {{symmetric_dirichlet()}});
  EXPECT_NEAR(m.value, 4 + 0.25 + 0.25 + 4, 1e-11);
  EXPECT_NEAR(m.sigma_max, 2, 1e-12);
  EXPECT_NEAR(m.sigma_min, 0.5, 1e-12);
}

TEST(Measure, AgreesWithAnIndependentRule) {
  const auto patch = surface(grid(3, bumpy));
  const Vec uv = uv_of(*patch, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  for (const int degree : {2, 3, 4}) {
    // Moved by a considerable part of the distance between control points.
    const BezierMap map =
        shaken(elevated_to(BezierMap::linear(patch, uv), degree), 0.055 / degree, 3);
    const MapMeasures m = measure_map(map, {{symmetric_dirichlet()}});
    ASSERT_TRUE(m.locally_injective) << degree;
    EXPECT_GT(m.value, 4.1);  // clearly not an isometry
    const double expected = gauss_mean(map, 40);
    EXPECT_NEAR(m.value, expected, 2e-5 * expected) << degree;
  }
  for (const char* name : {"cap", "tube"}) {
    ParametrizationOptions options;
    options.map.degree = 3;
    const ParametrizationResult result = parametrize(generated(name), options);
    const double expected = gauss_mean(*result.map, 16);
    EXPECT_NEAR(result.measures.value, expected, 1e-4 * expected) << name;
  }
}

TEST(Measure, FaceValuesAddUpToTheValue) {
  const auto mesh = generated("cap");
  const BezierMap map = shaken(elevated_to(BezierMap::linear(mesh, tutte_map(*mesh)), 2), 1e-3, 4);
  const MapMeasures m = measure_map(map, {{symmetric_dirichlet()}});
  const RestShapes rest = flat_triangles(mesh->positions(), mesh->faces());
  ASSERT_EQ(m.face_value.size(), mesh->face_count());
  EXPECT_NEAR(m.face_value.dot(rest.measure) / rest.measure.sum(), m.value, 1e-12 * m.value);
  EXPECT_GE(m.max_density, m.value);
}

TEST(Measure, ExtremesAndBoundsHoldForSamples) {
  const auto mesh = surface(grid(3, bumpy));
  const Vec uv = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  std::mt19937 random(10);
  for (const int degree : {1, 2, 3, 5}) {
    const BezierMap map =
        shaken(elevated_to(BezierMap::linear(mesh, uv), degree), 0.04 / degree, 5);
    const MapMeasures m = measure_map(map, {{symmetric_dirichlet()}});
    double low = INFINITY, high = 0, worst = 0;
    for (Index f = 0; f < mesh->face_count(); ++f) {
      for (int i = 0; i <= 8; ++i)
        for (int j = 0; j <= 8 - i; ++j) {
          const Barycentric xi(i / 8.0, j / 8.0, (8 - i - j) / 8.0);
          const auto [first, second] = map.singular_values(f, xi);
          high = std::max(high, first);
          low = std::min(low, second);
          worst = std::max(worst, density(map, f, xi));
        }
      for (int repeat = 0; repeat < 20; ++repeat)
        EXPECT_GE(map.jacobian(f, random_point(random)).determinant(), m.min_det[f] - 1e-12);
    }
    EXPECT_NEAR(m.sigma_max, high, 1e-12 * high) << degree;
    EXPECT_NEAR(m.sigma_min, low, 1e-12 * high) << degree;
    EXPECT_NEAR(m.max_density, worst, 1e-9 * worst) << degree;
    EXPECT_TRUE(m.locally_injective) << degree;
    EXPECT_GT(m.min_det.minCoeff(), 0) << degree;
  }
}

// Also where det J is negative.
TEST(Measure, ExtremesOfInvertedMapsAreThoseOfSamples) {
  const auto mesh = surface(grid(4, bumpy));
  const Vec uv = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const BezierMap map = shaken(elevated_to(BezierMap::linear(mesh, uv), 2), 0.2, seed);
    const MapMeasures m = measure_map(map, {{symmetric_dirichlet()}});
    double low = INFINITY, high = 0;
    for (Index f = 0; f < mesh->face_count(); ++f)
      for (const Barycentric& xi : extreme_samples(2)) {
        const auto [first, second] = map.singular_values(f, xi);
        high = std::max(high, first);
        low = std::min(low, second);
      }
    ASSERT_LT(low, 0) << seed;
    EXPECT_NEAR(m.sigma_max, high, 1e-12 * high) << seed;
    EXPECT_NEAR(m.sigma_min, low, 1e-12 * high) << seed;
  }
}

TEST(Measure, SeesAFlippedTriangle) {
  const auto mesh = surface(grid(3));
  Vec uv = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  uv.segment<2>(2 * 5) << 0.9, 0.9;
  for (const int degree : {1, 3}) {
    const MapMeasures m =
        measure_map(elevated_to(BezierMap::linear(mesh, uv), degree), {{symmetric_dirichlet()}});
    EXPECT_FALSE(m.locally_injective);
    EXPECT_LE(m.min_det.minCoeff(), 0);
    EXPECT_LT(m.sigma_min, 0);
    EXPECT_FALSE(std::isfinite(m.value));
  }
}

// det J < 0 near one corner only, between the points of every rule: only the certificate finds it.
TEST(Measure, SeesASmallFold) {
  const auto mesh = surface(polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  BezierMap map = elevated_to(
      BezierMap::linear(mesh, uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); })),
      3);
  Vec x = map.control_points();
  const TriangleIndices& ix = TriangleIndices::of_degree(3);
  // The edge's tangent at corner 0 is slightly reversed.
  x.segment<2>(2 * map.space().cells()(0, ix.edge(0)[1])) << -1e-4, 0.0;
  map = BezierMap(map.shared_mesh(), map.shared_space(), x);
  ASSERT_LT(map.jacobian(0, Barycentric(1, 0, 0)).determinant(), 0);
  const MapMeasures m = measure_map(map, {{symmetric_dirichlet()}});
  EXPECT_FALSE(m.locally_injective);
  EXPECT_LE(m.min_det[0], 0);
}

// All determinants are positive, but the angle sum at the centre is 4 pi.
TEST(Measure, SeesADoubleCover) {
  const auto mesh = surface(cone(8, true));
  Vec uv = Vec::Zero(2 * mesh->vertex_count());
  for (Index v = 1; v < mesh->vertex_count(); ++v) {
    const double t = 4 * kPi * (v - 1) / 8;
    uv.segment<2>(2 * v) << std::cos(t), std::sin(t);
  }
  for (const int degree : {1, 2}) {
    const MapMeasures m =
        measure_map(elevated_to(BezierMap::linear(mesh, uv), degree), {{symmetric_dirichlet()}});
    EXPECT_GT(m.min_det.minCoeff(), 0);
    EXPECT_FALSE(m.locally_injective);
  }
}

TEST(Measure, CountsBoundaryVerticesBeyondAFullTurn) {
  const auto mesh = surface(cone(7, false));  // vertex 0 on the boundary
  for (const double step : {0.8, 1.0}) {      // 7 sectors of that many radians
    Vec uv = Vec::Zero(2 * mesh->vertex_count());
    for (Index v = 1; v < mesh->vertex_count(); ++v)
      uv.segment<2>(2 * v) << std::cos(step * (v - 1)), std::sin(step * (v - 1));
    for (const int degree : {1, 3}) {
      const MapMeasures m =
          measure_map(elevated_to(BezierMap::linear(mesh, uv), degree), {{symmetric_dirichlet()}});
      EXPECT_NEAR(m.max_boundary_angle, 7 * step, 1e-9);
      EXPECT_EQ(m.boundary_over_full_turn, 7 * step > 2 * kPi ? 1 : 0);
      EXPECT_TRUE(m.locally_injective);  // only interior angle sums count
    }
  }
}

// ---- The quadrature hierarchy ----

double integral(const Quadrature& q, int i, int j, int k) {
  double sum = 0;
  for (Index l = 0; l < q.size(); ++l)
    sum += q.weights[l] * std::pow(q.points(l, 0), i) * std::pow(q.points(l, 1), j) *
           std::pow(q.points(l, 2), k);
  return sum;
}

double real_factorial(int n) { return n == 0 ? 1 : n * real_factorial(n - 1); }

void expect_rule(const Quadrature& q, const char* what) {
  EXPECT_NEAR(q.weights.sum(), 1, 1e-11) << what;
  EXPECT_GT(q.weights.minCoeff(), 0) << what;
  EXPECT_GE(q.points.minCoeff(), -1e-15) << what;
  EXPECT_LT((q.points.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-14) << what;
  // Exact for linear functions, and symmetric in the corners.
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(integral(q, c == 0, c == 1, c == 2), 1.0 / 3, 1e-11) << what;
  EXPECT_NEAR(integral(q, 2, 1, 0), integral(q, 0, 2, 1), 1e-11) << what;
  EXPECT_NEAR(integral(q, 2, 1, 0), integral(q, 1, 2, 0), 1e-11) << what;
}

void expect_exact_to_degree_5(const Quadrature& q) {
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; j <= 5 - i; ++j)
      for (int k = 0; k <= 5 - i - j; ++k)
        EXPECT_NEAR(integral(q, i, j, k),
                    2 * real_factorial(i) * real_factorial(j) * real_factorial(k) /
                        real_factorial(i + j + k + 2),
                    1e-11);
}

bool has_corner(const Quadrature& q) {
  return (q.points.rowwise().maxCoeff().array() > 1 - 1e-14).any();
}

TEST(QuadratureHierarchy, RulesAreProper) {
  for (int n = 1; n <= 8; ++n) {
    const QuadratureHierarchy hierarchy = optimizer_quadrature(n, 0);
    ASSERT_EQ(hierarchy.guarded.size(), hierarchy.plain.size());
    EXPECT_EQ(hierarchy.top(), static_cast<int>(hierarchy.plain.size()) - 1);
    for (std::size_t level = 0; level < hierarchy.plain.size(); ++level) {
      expect_rule(hierarchy.plain[level], "plain");
      expect_rule(hierarchy.guarded[level], "guarded");
      if (n == 1) continue;
      expect_exact_to_degree_5(hierarchy.plain[level]);
      EXPECT_FALSE(has_corner(hierarchy.plain[level])) << n;
      EXPECT_TRUE(has_corner(hierarchy.guarded[level])) << n;  // the barrier of method.md N12
      EXPECT_GT(hierarchy.guarded[level].size(), hierarchy.plain[level].size());
      if (level > 0) {
        EXPECT_GT(hierarchy.plain[level].size(), hierarchy.plain[level - 1].size());
      }
    }
  }
}

// Guard points change the minimized value only slightly.
TEST(QuadratureHierarchy, GuardsWeighLittle) {
  for (int n = 2; n <= 8; ++n) {
    const QuadratureHierarchy hierarchy = optimizer_quadrature(n, 0);
    for (std::size_t level = 0; level < hierarchy.plain.size(); ++level)
      EXPECT_NEAR(integral(hierarchy.guarded[level], 2, 0, 0), 1.0 / 6, 0.01) << n;
  }
}

TEST(QuadratureHierarchy, LinearMapsNeedOnePoint) {
  const QuadratureHierarchy hierarchy = optimizer_quadrature(1, 0);
  ASSERT_EQ(hierarchy.plain.size(), 1u);
  EXPECT_EQ(hierarchy.plain[0].size(), 1);
  ASSERT_EQ(measuring_rules(1).size(), 1u);
  EXPECT_EQ(measuring_rules(1)[0].size(), 1);
}

TEST(QuadratureHierarchy, LatticeHasAtLeastTheRequestedPoints) {
  for (const auto& [requested, given] : std::vector<std::pair<int, int>>{
           {1, 1}, {2, 3}, {3, 3}, {36, 36}, {37, 45}, {78, 78}, {5050, 5050}}) {
    const QuadratureHierarchy hierarchy = optimizer_quadrature(3, requested);
    EXPECT_EQ(hierarchy.plain[0].size(), given) << requested;
    EXPECT_NEAR(hierarchy.plain[0].weights.maxCoeff(), 1.0 / given, 1e-14);  // equal weights
    EXPECT_NEAR(hierarchy.plain[0].weights.minCoeff(), 1.0 / given, 1e-14);
    expect_rule(hierarchy.guarded[0], "lattice");
  }
}

TEST(QuadratureHierarchy, MeasuringRulesGrow) {
  for (int n = 2; n <= 8; ++n) {
    const std::vector<Quadrature> rules = measuring_rules(n);
    ASSERT_GE(rules.size(), 3u);
    for (std::size_t k = 0; k < rules.size(); ++k) {
      expect_rule(rules[k], "measuring");
      expect_exact_to_degree_5(rules[k]);
      if (k > 0) {
        EXPECT_GT(rules[k].size(), rules[k - 1].size());
      }
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
