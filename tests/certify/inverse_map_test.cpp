// Preimages against winding numbers, which are exact and independent of faces, and against
// evaluated points: on edges, at vertices, outside, of maps that cover the plane twice.
#include "majorant/certify/inverse_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "counted_stop.h"
#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/loop_winding.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/maps/measure.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

using Image = std::function<Vector2(const Vector2&)>;

// Returns the map of a flat n by n grid on the unit square whose control points are images of the
// nodes.
BezierMap image_of_grid(int n, int degree, const Image& image) {
  const auto mesh = surface(grid(n));
  const Vec flat = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  BezierMap map = elevated_to(BezierMap::linear(mesh, flat), degree);
  Vec x = map.control_points();
  Vector2 low = x.head<2>(), high = low;
  for (Index k = 0; k < x.size(); k += 2) {
    low = low.cwiseMin(x.segment<2>(k));
    high = high.cwiseMax(x.segment<2>(k));
  }
  for (Index k = 0; k < x.size(); k += 2)
    x.segment<2>(k) =
        image(((x.segment<2>(k) - low).array() / (high - low).array()).matrix().eval());
  return map.with(map.shared_space(), x);
}

Image ring(double turns) {
  return [turns](const Vector2& p) {
    const double angle = 2 * std::numbers::pi * turns * p.x(), radius = 2 - p.y();
    return Vector2(radius * std::cos(angle) + 0.05 * angle, radius * std::sin(angle));
  };
}

bool is_locally_injective(const BezierMap& map) {
  return measure_map(map, EnergySum{{symmetric_dirichlet()}}).locally_injective;
}

// Expects the number of preimages to be the winding number, for random points in the enlarged box
// of a map.
void expect_windings(const BezierMap& map, int count, unsigned seed) {
  ASSERT_TRUE(is_locally_injective(map));
  const BoundaryLoops boundary = boundary_loops(map);
  const LoopWinding winding(boundary);
  const InverseMap inverse(map);
  const auto points = map.control_uv();
  const Vector2 low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(-0.1, 1.1);
  int inside = 0;
  for (int k = 0; k < count; ++k) {
    const Vector2 uv = low + Vector2(part(random), part(random)).cwiseProduct(Vector2(high - low));
    const auto turns = winding.around(uv, [](const BoundaryLoop&) { return true; });
    if (!turns) continue;
    const auto found = inverse.preimages(uv);
    ASSERT_EQ(static_cast<long>(found.size()), *turns)
        << uv.transpose() << " degree " << map.degree();
    inside += !found.empty();
    for (const Preimage& p : found) {
      EXPECT_TRUE(p.proven);
      EXPECT_GE(p.barycentric.minCoeff(), 0);
      EXPECT_LE((map.evaluate(p.face, p.barycentric) - uv).norm(), 1e-12 * (high - low).norm());
    }
  }
  EXPECT_GT(inside, count / 10);
}

TEST(InverseMap, StraightFaces) {
  expect_windings(image_of_grid(9, 1, ring(0.7)), 4000, 1);
  expect_windings(shaken(image_of_grid(12, 1, ring(0.9)), 0.02, 2), 4000, 2);
}

TEST(InverseMap, CurvedFacesOfEveryDegree) {
  for (int degree = 2; degree <= BezierTriangleSpace::kMaxDegree; ++degree)
    expect_windings(image_of_grid(7, degree, ring(0.8)), 1500, degree);
}

// Two faces with a rotation by 120 degrees each: no linear map straightens a whole face.
TEST(InverseMap, FacesThatAreCut) {
  expect_windings(image_of_grid(1, 8, ring(0.3)), 2000, 3);
  expect_windings(image_of_grid(1, 4, ring(0.2)), 2000, 4);
}

TEST(InverseMap, MapsThatCoverThePlaneTwice) {
  for (const int degree : {1, 3}) {
    const BezierMap map = image_of_grid(24, degree, ring(1.6));
    expect_windings(map, 1500, 5);
    const auto found = InverseMap(map).preimages({-1.3, 0.2});
    ASSERT_EQ(found.size(), 2u);
    EXPECT_LT(found[0].face, found[1].face);
  }
}

TEST(InverseMap, PointsThatWereEvaluated) {
  for (const int degree : {1, 2, 3, 5}) {
    const BezierMap map = shaken(image_of_grid(6, degree, ring(0.6)), 0.01, 7);
    ASSERT_TRUE(is_locally_injective(map));
    const InverseMap inverse(map);
    std::mt19937 random(8);
    for (int k = 0; k < 500; ++k) {
      const Index face =
          std::uniform_int_distribution<Index>(0, map.mesh().face_count() - 1)(random);
      const Barycentric xi = random_point(random);
      const auto found = inverse.preimages(map.evaluate(face, xi));
      ASSERT_EQ(found.size(), 1u);
      EXPECT_EQ(found[0].face, face);
      EXPECT_LE((found[0].barycentric - xi).norm(), 1e-12);
      EXPECT_FALSE(found[0].on_edge);
    }
  }
}

// Slivers so thin that doubles leave three digits; expected values are quotients of long doubles.
TEST(InverseMap, CoordinatesInSliversHaveManyDigits) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto mesh = surface(polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  int found_in = 0;
  for (int k = 0; k < 200; ++k) {
    const std::array<Vector2, 2> end{Vector2(uniform(random), uniform(random)),
                                     Vector2(uniform(random), uniform(random))};
    const Vector2 across(end[0].y() - end[1].y(), end[1].x() - end[0].x());
    const Vector2 top = (end[0] + end[1]) / 2 + 1e-13 * across;
    Vec x(6);
    x << end[0], end[1], top;
    const BezierMap map = BezierMap::linear(mesh, x);
    const Vector2 uv = 0.3 * end[0] + 0.2 * end[1] + 0.5 * top;
    const auto found = InverseMap(map).preimages(uv);
    if (found.empty()) continue;
    ++found_in;
    const std::array<Vector2, 3> corner{end[0], end[1], top};
    std::array<long double, 3> weight{};
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector2 &a = corner[(c + 1) % 3], &b = corner[(c + 2) % 3];
      using Long = long double;
      weight[c] = (Long(a.x()) - uv.x()) * (Long(b.y()) - uv.y()) -
                  (Long(a.y()) - uv.y()) * (Long(b.x()) - uv.x());
    }
    const long double sum = weight[0] + weight[1] + weight[2];
    for (Index c = 0; c < 3; ++c)
      EXPECT_NEAR(found[0].barycentric[c], static_cast<double>(weight[to_size(c)] / sum), 2e-5);
  }
  EXPECT_GT(found_in, 150);
}

// Points of shared edges and vertices belong to the face with the smallest number, and occur once.
TEST(InverseMap, EdgesAndVertices) {
  for (const int degree : {1, 2, 4}) {
    const BezierMap map = shaken(image_of_grid(5, degree, ring(0.5)), 0.004, 9);
    ASSERT_TRUE(is_locally_injective(map));
    const InverseMap inverse(map);
    const SurfaceMesh& mesh = map.mesh();
    int middles = 0, smaller = 0;
    std::vector<Index> smallest(to_size(mesh.vertex_count()), mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (const Index v : mesh.faces().row(f)) smallest[v] = std::min(smallest[v], f);
    for (Index h = 0; h < 3 * mesh.face_count(); ++h) {
      const Index face = face_of(h);
      Barycentric corner = Barycentric::Zero(), middle = Barycentric::Zero();
      corner[corner_of(h)] = 1;
      middle[corner_of(h)] = middle[corner_of(next(h))] = 0.5;
      const auto at_corner = inverse.preimages(map.evaluate(face, corner));
      ASSERT_EQ(at_corner.size(), 1u) << degree;
      EXPECT_EQ(at_corner[0].face, smallest[from_vertex(mesh.faces(), h)]);
      EXPECT_TRUE(at_corner[0].on_edge);
      // The midpoint of a straight edge is rounded: it may lie on either side, or outside.
      const auto at_middle = inverse.preimages(map.evaluate(face, middle));
      ASSERT_LE(at_middle.size(), 1u) << degree;
      if (at_middle.empty()) {
        EXPECT_LT(mesh.opposite(h), 0);
        continue;
      }
      const Index across = mesh.opposite(h) < 0 ? face : face_of(mesh.opposite(h));
      EXPECT_TRUE(at_middle[0].face == face || at_middle[0].face == across);
      smaller += at_middle[0].face == std::min(face, across);
      ++middles;
    }
    EXPECT_GT(smaller, degree > 1 ? 0.8 * middles : 0);
  }
}

TEST(InverseMap, ManyPointsOnThreads) {
  const BezierMap map = image_of_grid(8, 3, ring(0.7));
  const InverseMap inverse(map);
  std::mt19937 random(10);
  std::uniform_real_distribution<double> uniform(-3, 3);
  Points2 uv(5000, 2);
  for (double& value : uv.reshaped()) value = uniform(random);
  uv.row(17).setConstant(std::numeric_limits<double>::quiet_NaN());
  uv.row(18) = map.evaluate(0, {1, 0, 0});
  const InverseMap::Points points = inverse.locate(uv);
  EXPECT_EQ(points.face[17], -1);
  EXPECT_EQ(points.face[18], 0);
  int inside = 0;
  for (Index k = 0; k < uv.rows(); ++k) {
    const auto found = inverse.preimages(uv.row(k));
    ASSERT_EQ(points.face[k], found.empty() ? -1 : found[0].face);
    if (found.empty()) continue;
    ++inside;
    EXPECT_EQ(Barycentric(points.barycentric.row(k)), found[0].barycentric);
  }
  EXPECT_GT(inside, 500);
  for (const int threads : {1, 2, 7}) {
    const ThreadCount count(threads);
    const InverseMap::Points again = inverse.locate(uv);
    EXPECT_EQ(again.face, points.face);
    EXPECT_EQ(again.barycentric, points.barycentric);
    EXPECT_EQ(again.is_undecided, points.is_undecided);
  }
  const CountedStop stop(3);
  EXPECT_THROW(inverse.locate(uv, stop.check()), Stopped);
}

// On a curved boundary, inside and outside are undecided and reported as such; on a straight one
// they are decided.
TEST(InverseMap, PointsAtTheBorder) {
  for (const int degree : {1, 3}) {
    const BezierMap map = image_of_grid(3, degree, ring(0.4));
    const auto loop = map.mesh().boundary_loops().front();
    Points2 uv(1, 2);
    uv.row(0) = map.evaluate(0, {1, 0, 0});
    for (Index f = 0; f < map.mesh().face_count(); ++f)
      for (int k = 0; k < 3; ++k)
        if (map.mesh().opposite(3 * f + k) < 0) {
          Barycentric xi = Barycentric::Zero();
          xi[k] = 1;
          uv.row(0) = map.evaluate(f, xi);
        }
    const InverseMap::Points points = InverseMap(map).locate(uv);
    EXPECT_GE(points.face[0], 0);
    EXPECT_EQ(points.is_undecided[0], degree > 1);
  }
}

TEST(InverseMap, PointsOutsideHaveNoPreimage) {
  const BezierMap map = image_of_grid(2, 2, ring(0.3));
  const InverseMap inverse(map);
  const double inf = std::numeric_limits<double>::infinity();
  for (const Vector2& uv : {Vector2(50, 50), Vector2(inf, 0), Vector2(std::nan(""), 0)})
    EXPECT_TRUE(inverse.preimages(uv).empty());
  EXPECT_TRUE(inverse.locate(Points2(0, 2)).face.empty());
  Vec x = map.control_points();
  x[5] = inf;
  EXPECT_THROW(InverseMap(map.with(map.shared_space(), x)), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
