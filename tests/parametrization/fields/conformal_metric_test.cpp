// Conformal metrics have the prescribed angle sums and agree with closed forms.
#include "majorant/parametrization/fields/conformal_metric.h"

#include <Eigen/SparseCore>
#include <limits>

#include "expected_error.h"
#include "majorant/parametrization/fields/edge_laplacian.h"
#include "majorant/parametrization/fields/internal/conformal_energy.h"
#include "mesh/obj_file.h"
#include "parametrization/fields/closed_surfaces.h"

namespace majorant {
namespace {

Vec flat_angles(const SurfaceMesh& mesh) { return Vec::Constant(mesh.vertex_count(), 2 * kPi); }

std::vector<int> no_cones(const SurfaceMesh& mesh) {
  return std::vector<int>(to_size(mesh.vertex_count()), 4);
}

double area_of(const SurfaceMesh& mesh, const ConformalMetric& metric) {
  const Vec lengths = IntrinsicTriangulation(mesh).log_lengths(metric.log_factor);
  double area = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)
    area += std::exp(IntrinsicTriangulation::shape(lengths, f).log_area);
  return area;
}

// Computes angle sums by the law of cosines, independently of the library's formulas.
void expect_angle_sums(const SurfaceMesh& mesh, const ConformalMetric& metric,
                       const std::vector<int>& quarter_turns) {
  Vec sums = Vec::Zero(mesh.vertex_count());
  const auto length = [&](Index f, int k) {
    const Index a = mesh.faces()(f, k % 3), b = mesh.faces()(f, (k + 1) % 3);
    return (mesh.positions().row(a) - mesh.positions().row(b)).norm() *
           std::exp(0.5 * (metric.log_factor[a] + metric.log_factor[b]));
  };
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) {
      const double p = length(f, k), q = length(f, k + 2), r = length(f, k + 1);
      sums[mesh.faces()(f, k)] += std::acos((p * p + q * q - r * r) / (2 * p * q));
    }
  std::vector<char> is_boundary(to_size(mesh.vertex_count()), 0);
  for (const auto& loop : mesh.boundary_loops())
    for (const Index v : loop) is_boundary[v] = 1;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!is_boundary[v]) {
      EXPECT_NEAR(sums[v], 0.5 * kPi * quarter_turns[v], 1e-10) << "vertex " << v;
    }
}

TEST(ConformalEnergy, HessianIsTheDerivativeOfTheGradient) {
  const auto mesh = surface(grid(4, bumpy));
  const ConformalEnergy energy(*mesh, flat_angles(*mesh));
  const Vec u = random_factors(*mesh, 0.2);
  const double step = 1e-5;
  std::vector<Index> row_of;
  for (Index v = 0; v < mesh->vertex_count(); ++v) row_of.push_back(v);
  const EdgeLaplacian laplacian(mesh->faces(), row_of);
  const SparsePattern& pattern = laplacian.pattern();
  const Vec values = laplacian.values(energy.derivatives(u).hessian_weights);
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(pattern.size, pattern.size);
  for (Index c = 0; c < pattern.size; ++c)
    for (Index k = pattern.column_starts[c]; k < pattern.column_starts[c + 1]; ++k)
      hessian(pattern.rows[k], c) = hessian(c, pattern.rows[k]) = values[k];
  for (Index v = 0; v < mesh->vertex_count(); ++v) {
    const Vec move = step * Vec::Unit(mesh->vertex_count(), v);
    const Vec slope =
        (energy.derivatives(u + move).gradient - energy.derivatives(u - move).gradient) /
        (2 * step);
    for (Index w = 0; w < mesh->vertex_count(); ++w)
      if (energy.is_interior()[w]) {
        EXPECT_NEAR(hessian(w, v), slope[w], 1e-8);
      }
  }
}

// The derivative of a convex function increases along any line, also where the triangle inequality
// fails.
TEST(ConformalEnergy, IsConvexAndOnceDifferentiable) {
  const auto mesh = surface(cube(2));
  const ConformalEnergy energy(*mesh, flat_angles(*mesh));
  const Vec p = random_factors(*mesh, 1);
  double last = -std::numeric_limits<double>::infinity();
  for (int k = -400; k <= 400; ++k) {
    const double slope = energy.derivatives(0.01 * k * p).gradient.dot(p);
    EXPECT_GE(slope, last - 1e-12);
    if (k > -400) {
      EXPECT_LT(slope - last, 2) << k;  // the derivative is continuous
    }
    last = slope;
  }
}

TEST(ConformalMetric, CubeIsFlatAlready) {
  for (const int n : {1, 2, 5}) {
    const auto mesh = surface(cube(n));
    const auto turns =
        quarter_turns_at(*mesh, cube_corners(Vector3::Constant(0.5 * n), 0.5 * n), 3);
    const ConformalMetric metric = conformal_metric(*mesh, turns);
    EXPECT_LT(metric.log_factor.cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(metric.angle_error, 1e-13);
    EXPECT_EQ(metric.broken_faces, 0);
  }
}

TEST(ConformalMetric, SphereWithCubeAndTetrahedronCones) {
  const auto mesh = surface(sphere(8));
  std::vector<Vector3> points = cube_corners(Vector3::Zero(), 1);
  for (const int turns : {3, 2}) {
    // the corners of a tetrahedron
    if (turns == 2) points = {points[0], points[3], points[5], points[6]};
    const auto required = quarter_turns_at(*mesh, points, turns);
    const ConformalMetric metric = conformal_metric(*mesh, required);
    EXPECT_LT(metric.angle_error, 1e-12);
    EXPECT_EQ(metric.broken_faces, 0);
    EXPECT_LT(metric.newton_steps, 12);
    EXPECT_NEAR(area_of(*mesh, metric) / mesh->area(), 1, 1e-12);
    expect_angle_sums(*mesh, metric, required);
    // Near a cone the metric grows like a negative power of the distance.
    for (Index h = 0; h < mesh->half_edge_count(); ++h)
      if (required[mesh->from_vertex(h)] == turns) {
        EXPECT_GT(metric.log_factor[mesh->from_vertex(h)], metric.log_factor[mesh->to_vertex(h)]);
      }
  }
}

TEST(ConformalMetric, TorusWithoutCones) {
  const auto mesh = surface(torus(24, 12, 0));
  const ConformalMetric metric = conformal_metric(*mesh, no_cones(*mesh));
  EXPECT_LT(metric.angle_error, 1e-12);
  EXPECT_EQ(metric.broken_faces, 0);
  expect_angle_sums(*mesh, metric, no_cones(*mesh));
}

TEST(ConformalMetric, DiskIsFlatInside) {
  for (const auto& mesh : {surface(grid(9, bumpy)), surface(cone(7, true)), surface(grid(1, bumpy)),
                           generated("cap")}) {
    const ConformalMetric metric = conformal_metric(*mesh, no_cones(*mesh));
    EXPECT_LT(metric.angle_error, 1e-12);
    EXPECT_EQ(metric.broken_faces, 0);
    expect_angle_sums(*mesh, metric, no_cones(*mesh));
    for (const Index v : mesh->boundary_loops()[0])
      EXPECT_EQ(metric.log_factor[v], metric.log_factor[mesh->boundary_loops()[0][0]]);
  }
  const auto plane = surface(grid(6));
  EXPECT_LT(conformal_metric(*plane, no_cones(*plane)).log_factor.cwiseAbs().maxCoeff(), 1e-13);
}

TEST(ConformalMetric, KnowsNoScaleAndNoRotation) {
  PolygonMesh input = sphere(5);
  const auto mesh = surface(input);
  const auto turns = quarter_turns_at(*mesh, cube_corners(Vector3::Zero(), 1), 3);
  const Vec u = conformal_metric(*mesh, turns).log_factor;
  for (const double scale : {1e-40, 1024.0, 1e40}) {
    PolygonMesh moved = input;
    for (Vector3& p : moved.positions)
      p = scale * Vector3(0.6 * p.x() - 0.8 * p.y(), 0.8 * p.x() + 0.6 * p.y(), p.z());
    EXPECT_LT((conformal_metric(*surface(moved), turns).log_factor - u).norm(), 1e-11) << scale;
  }
}

// Expects that the angles of the surface's triangles in the metric, inverted or not, have the
// prescribed sums modulo 2 pi, and that adjacent triangles fit.
void expect_flat_vectors(const SurfaceMesh& mesh, const ConformalMetric& metric,
                         const std::vector<int>& quarter_turns) {
  Vec sums = Vec::Zero(mesh.vertex_count());
  double area = 0;
  const Points2& vectors = metric.edge_vectors;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    EXPECT_LT(vectors.middleRows(3 * f, 3).colwise().sum().norm(),
              1e-13 * vectors.middleRows(3 * f, 3).norm());
    for (Index k = 0; k < 3; ++k) {
      const Eigen::RowVector2d a = vectors.row(3 * f + k), b = -vectors.row(3 * f + (k + 2) % 3);
      const double cross = a.x() * b.y() - a.y() * b.x();
      sums[mesh.faces()(f, k)] += std::atan2(cross, a.dot(b));
      if (k == 0) area += 0.5 * cross;
      EXPECT_NEAR(a.norm() / vectors.row(mesh.opposite(3 * f + k)).norm(), 1, 1e-11);
    }
  }
  EXPECT_NEAR(area / mesh.area(), 1, 1e-12);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_NEAR(std::remainder(sums[v] - 0.5 * kPi * quarter_turns[v], 2 * kPi), 0, 1e-9);
}

// Angle sums that no metric with the surface's own edges has: angle sums at a vertex of three
// triangles are below 900 degrees, and those of two triangles between two such vertices below 450.
TEST(ConformalMetric, FlipsEdgesWhereItMust) {
  const auto tetrahedron = surface(polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                                {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}));
  for (const std::vector<int>& turns : {std::vector<int>{5, 1, 1, 1}, {1, 1, 5, 1}, {2, 2, 3, 1}}) {
    const ConformalMetric metric = conformal_metric(*tetrahedron, turns);
    EXPECT_LT(metric.angle_error, 1e-12);
    EXPECT_EQ(metric.open_faces, 0);
    expect_flat_vectors(*tetrahedron, metric, turns);
  }
  const auto ball = surface(sphere(3));
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::uniform_int_distribution<Index> vertex(0, ball->vertex_count() - 1);
    std::vector<int> turns = no_cones(*ball);
    for (int k = 0; k < 8; ++k) turns[vertex(random)] += 1;
    for (int k = 0; k < 16;) {
      const Index v = vertex(random);
      if (turns[v] == 1) continue;
      turns[v] -= 1;
      ++k;
    }
    const ConformalMetric metric = conformal_metric(*ball, turns);
    EXPECT_LT(metric.angle_error, 1e-12);
    EXPECT_EQ(metric.open_faces, 0);
    expect_flat_vectors(*ball, metric, turns);
  }
}

TEST(ConformalMetric, RefusesImpossibleCones) {
  const auto mesh = surface(cube(2));
  std::vector<int> turns = no_cones(*mesh);
  expect_contains(error_message(ErrorKind::Usage, [&] { conformal_metric(*mesh, turns); }),
                  {"inline.obj", "over all cones is 0", "must be 8", "Euler"});
  turns[3] = 0;
  expect_contains(error_message(ErrorKind::Usage, [&] { conformal_metric(*mesh, turns); }),
                  {"inline.obj", "vertex 4", "0 quarter turns"});
  turns.pop_back();
  expect_contains(error_message(ErrorKind::Usage, [&] { conformal_metric(*mesh, turns); }),
                  {"inline.obj", "25", "26"});
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
