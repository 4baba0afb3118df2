// Nearest points against all faces, one after the other, and against samples of the triangle.
#include "majorant/pictures/baking/nearest_point.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "counted_stop.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

Vector3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  return {uniform(random), uniform(random), uniform(random)};
}

TEST(NearestPoint, OfATriangleIsNoFartherThanAnySample) {
  std::mt19937 random(1);
  for (int k = 0; k < 500; ++k) {
    const Vector3 a = random_vector(random, 1), b = random_vector(random, 1),
                  c = k % 5 == 0 ? Vector3((a + b) / 2) : random_vector(random, 1);
    const Vector3 p = random_vector(random, 2);
    const NearestPoint found = nearest_of_triangle(a, b, c, p);
    EXPECT_GE(found.barycentric.minCoeff(), 0);
    EXPECT_NEAR(found.barycentric.sum(), 1, 1e-14);
    const Barycentric& xi = found.barycentric;
    EXPECT_NEAR((xi[0] * a + xi[1] * b + xi[2] * c - p).norm(), found.distance, 1e-14);
    for (int s = 0; s < 200; ++s) {
      const Barycentric other = random_point(random);
      const Vector3 q = other[0] * a + other[1] * b + other[2] * c;
      EXPECT_LE(found.distance, (q - p).norm() + 1e-12);
    }
  }
}

TEST(NearestPoint, OfATreeIsThatOfAllFaces) {
  const auto mesh = surface(grid(12, bumpy));
  const SurfaceTree tree(mesh->positions(), mesh->faces());
  std::mt19937 random(2);
  Points3 points(2000, 3);
  for (Index k = 0; k < points.rows(); ++k) points.row(k) = random_vector(random, 1.5).transpose();
  const std::vector<NearestPoint> found = tree.locate(points);
  for (Index k = 0; k < points.rows(); ++k) {
    double least = std::numeric_limits<double>::infinity();
    for (Index f = 0; f < mesh->face_count(); ++f) {
      const auto corner = [&](Index l) -> Vector3 {
        return mesh->positions().row(mesh->faces()(f, l));
      };
      least = std::min(
          least, nearest_of_triangle(corner(0), corner(1), corner(2), points.row(k)).distance);
    }
    EXPECT_EQ(found[to_size(k)].distance, least);
    EXPECT_EQ(tree.nearest(Vector3(points.row(k))).distance, least);
  }
  const ThreadCount one(1);
  const std::vector<NearestPoint> again = tree.locate(points);
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(again[k].face, found[k].face);
}

// Two sheets, one of which faces up and one down, a tenth apart.
TEST(NearestPoint, OnTheSideThatFacesADirectionAndAlongIt) {
  const Points3 positions =
      (Points3(6, 3) << 0, 0, 0.1, 1, 0, 0.1, 0, 1, 0.1, 0, 0, 0, 1, 0, 0, 0, 1, 0).finished();
  const Cells faces = (Cells(2, 3) << 0, 1, 2, 3, 5, 4).finished();
  const SurfaceTree tree(positions, faces);
  const Vector3 p(0.25, 0.25, 0.01), up(0, 0, 1);
  EXPECT_EQ(tree.nearest(p).face, 1);
  for (const Index likely : {-1, 0, 1}) {
    const NearestPoint facing = tree.nearest_facing(p, up, 1, likely);
    EXPECT_EQ(facing.face, 0);
    EXPECT_NEAR(facing.distance, 0.09, 1e-15);
    EXPECT_EQ(tree.nearest_facing(p, -up, 1, likely).face, 1);
    EXPECT_EQ(tree.nearest_facing(p, up, 0.08, likely).face, -1);
    EXPECT_EQ(tree.nearest_facing(p, Vector3(1, 0, 0), 1, likely).face, -1);
  }
  const Vector3 askew = Vector3(1, 0, 2).normalized();
  const NearestPoint along = tree.along(p, askew, 1);
  EXPECT_EQ(along.face, 0);
  EXPECT_NEAR(along.distance, 0.09 / askew.z(), 1e-15);
  EXPECT_NEAR(along.barycentric[1], 0.25 + 0.045, 1e-15);
  EXPECT_EQ(tree.along(p, -askew, 1).face, 1);
  EXPECT_EQ(tree.along(p, askew, 0.05).face, -1);
  EXPECT_EQ(tree.along(Vector3(2, 2, 0), up, 1).face, -1);
}

TEST(NearestPoint, AlongALineIsTheNearestOfAllFaces) {
  const auto mesh = surface(grid(12, bumpy));
  const SurfaceTree tree(mesh->positions(), mesh->faces());
  std::mt19937 random(5);
  int found = 0;
  for (int k = 0; k < 1000; ++k) {
    const Vector3 p = random_vector(random, 1.2), d = random_vector(random, 1).normalized();
    double least = 1.5;
    Index face = -1;
    for (Index f = 0; f < mesh->face_count(); ++f) {
      const auto corner = [&](Index l) -> Vector3 {
        return mesh->positions().row(mesh->faces()(f, l));
      };
      Eigen::Matrix3d columns;
      columns << corner(0) - corner(2), corner(1) - corner(2), -d;
      const Vector3 at = columns.partialPivLu().solve(p - corner(2));
      if (at[0] < 0 || at[1] < 0 || at[0] + at[1] > 1 || std::abs(at[2]) > least ||
          tree.doubled_normal(f).dot(d) <= 0)
        continue;
      least = std::abs(at[2]);
      face = f;
    }
    const NearestPoint along = tree.along(p, d, 1.5);
    EXPECT_EQ(along.face, face);
    if (face < 0) continue;
    ++found;
    EXPECT_NEAR(along.distance, least, 1e-12);
  }
  EXPECT_GT(found, 30);
}

TEST(NearestPoint, RefusesNoSurfaceAndStops) {
  const Points3 corners = (Points3(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished();
  const Cells faces = (Cells(1, 3) << 0, 1, 2).finished();
  EXPECT_THROW(SurfaceTree(corners, Cells(0, 3)), InvalidArgument);
  Points3 broken = corners;
  broken(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SurfaceTree(broken, faces), InvalidArgument);
  const SurfaceTree tree(corners, faces);
  EXPECT_THROW(tree.locate(Points3::Zero(2000, 3), CountedStop(2).check()), Stopped);
}

// Of a fan of four around (0, 0), and one face that touches its border.
TEST(FacesAt, InsideOnEdgesAndAtVertices) {
  PolygonMesh polygons;
  polygons.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {2, 2, 0}};
  polygons.polygons = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {1, 5, 2}};
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(polygons);
  const auto at = [&](Index face, const Barycentric& barycentric) {
    const std::vector<Index> faces = faces_at(mesh, {face, barycentric, 0});
    return std::set<Index>(faces.begin(), faces.end());
  };
  EXPECT_EQ(at(0, {0.2, 0.3, 0.5}), (std::set<Index>{0}));
  EXPECT_EQ(at(0, {0.5, 0, 0.5}), (std::set<Index>{0, 1}));
  EXPECT_EQ(at(0, {1e-10, 0.5, 0.5}), (std::set<Index>{0, 4}));
  EXPECT_EQ(at(1, {0, 0.5, 0.5}), (std::set<Index>{1}));
  EXPECT_EQ(at(2, {1, 0, 0}), (std::set<Index>{0, 1, 2, 3}));
  EXPECT_EQ(at(1, {0, 1, 0}), (std::set<Index>{0, 1, 4}));
  EXPECT_EQ(at(4, {0, 0, 1}), (std::set<Index>{0, 1, 4}));
  EXPECT_EQ(at(4, {0, 1, 0}), (std::set<Index>{4}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
