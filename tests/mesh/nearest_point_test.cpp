// Nearest points against a loop over all faces and against samples of the triangle; ties, faces of
// area 0, distant points.
#include "majorant/mesh/nearest_point.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "counted_stop.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
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
      std::uniform_real_distribution<double> part(0, 1);
      Barycentric other(part(random), part(random), part(random));
      other /= other.sum();
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

// Two sheets at distance 0.1, one facing up and one facing down.
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

// Returns the nearest point by a loop over all faces; of ties the first one.
NearestPoint of_all_faces(const Points3& positions, const Cells& faces, const Vector3& p) {
  NearestPoint best;
  best.distance = std::numeric_limits<double>::infinity();
  for (Index f = 0; f < faces.rows(); ++f) {
    const NearestPoint other = nearest_of_triangle(
        positions.row(faces(f, 0)), positions.row(faces(f, 1)), positions.row(faces(f, 2)), p);
    if (!(other.distance < best.distance)) continue;
    best = other;
    best.face = f;
  }
  return best;
}

struct FaceList {
  Points3 positions;
  Cells faces;
};

// Returns triangles of random points, some of area 0 or with one point only; copies of one
// triangle; a regular grid, for which queries on a lattice have many faces at equal distance.
FaceList random_triangles(std::mt19937& random, Index count) {
  FaceList s{Points3(3 * count, 3), Cells(count, 3)};
  for (Index f = 0; f < count; ++f) {
    for (Index k = 0; k < 3; ++k) {
      s.positions.row(3 * f + k) = random_vector(random, 1).transpose();
      s.faces(f, k) = 3 * f + k;
    }
    if (f % 5 == 1) s.faces(f, 2) = s.faces(f, 1);
    if (f % 5 == 2) s.faces.row(f).setConstant(3 * f);
  }
  return s;
}

FaceList copies(Index count) {
  FaceList s{(Points3(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished(), Cells(count, 3)};
  for (Index f = 0; f < count; ++f) s.faces.row(f) << 0, 1, 2;
  return s;
}

FaceList right_angles(Index n) {
  FaceList s{Points3((n + 1) * (n + 1), 3), Cells(2 * n * n, 3)};
  for (Index i = 0; i <= n; ++i)
    for (Index j = 0; j <= n; ++j) s.positions.row(i * (n + 1) + j) << i, j, 0;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index a = i * (n + 1) + j, b = a + n + 1, f = 2 * (n * n - 1 - i * n - j);
      s.faces.row(f) << a, b, b + 1;
      s.faces.row(f + 1) << a, b + 1, a + 1;
    }
  return s;
}

// Expects that the result does not depend on the guessed face: it is that of all faces, and of ties
// the first one.
void expect_nearest(const FaceList& s, const std::vector<Vector3>& points) {
  const SurfaceTree tree(s.positions, s.faces);
  const auto count = static_cast<Index>(s.faces.rows());
  double largest = 0;
  Points3 rows(static_cast<Index>(points.size()), 3);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector3& p = points[k];
    rows.row(static_cast<Index>(k)) = p.transpose();
    const NearestPoint expected = of_all_faces(s.positions, s.faces, p);
    largest = std::max(largest, expected.distance);
    const auto number = static_cast<Index>(k);
    for (const Index likely : {-1, 0, count - 1, number % count}) {
      const NearestPoint found = tree.nearest(p, likely);
      EXPECT_EQ(found.face, expected.face);
      EXPECT_EQ(found.distance, expected.distance);
      EXPECT_EQ(found.barycentric, expected.barycentric);
      const double slack = k % 2 == 0 ? 0 : 0.1;
      const NearestFaces near = tree.nearest_faces(p, slack, likely);
      EXPECT_EQ(near.distance, expected.distance);
      EXPECT_EQ(near.faces, tree.faces_within(p, expected.distance + slack));
    }
    std::vector<Index> within;
    for (Index f = 0; f < count; ++f) {
      const Cells one = s.faces.row(f);
      if (of_all_faces(s.positions, one, p).distance <= expected.distance + 0.05)
        within.push_back(f);
    }
    EXPECT_EQ(tree.faces_within(p, expected.distance + 0.05), within);
  }
  EXPECT_EQ(tree.largest_distance(rows), largest);
  EXPECT_EQ(tree.largest_distance(rows, 2 * largest), 2 * largest);
  EXPECT_EQ(tree.largest_distance(rows, largest / 2), largest);
  const ThreadCount one(1);
  EXPECT_EQ(tree.largest_distance(rows), largest);
}

TEST(NearestPoint, OfTrianglesWithoutAnAreaCopiesAndTies) {
  std::mt19937 random(11);
  std::vector<Vector3> points;
  for (int k = 0; k < 300; ++k) points.push_back(random_vector(random, 1.5));
  std::vector<Vector3> far;
  for (int k = 0; k < 20; ++k) far.push_back(random_vector(random, 1e6));
  for (const Index count : {1, 2, 3, 4, 5, 17, 64, 200}) {
    SCOPED_TRACE(count);
    expect_nearest(random_triangles(random, count), points);
    expect_nearest(random_triangles(random, count), far);
    expect_nearest(copies(count), points);
  }
  std::vector<Vector3> lattice;
  for (int i = -1; i <= 10; ++i)
    for (int j = -1; j <= 10; ++j)
      for (const double height : {0.0, 0.5, 3.0}) lattice.emplace_back(0.5 * i, 0.5 * j, height);
  expect_nearest(right_angles(5), lattice);
}

TEST(NearestPoint, APointThatIsNotFiniteStillHasAFace) {
  const Points3 corners = (Points3(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished();
  const SurfaceTree tree(corners, Cells{{0, 1, 2}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(tree.nearest_faces({nan, 0, 0}, 1e-9).faces, (std::vector<Index>{0}));
  EXPECT_EQ(tree.nearest_faces({nan, 0, 0}, 1e-9, 0).faces, (std::vector<Index>{0}));
}

TEST(NearestPoint, LargestDistanceOfNoPointsIsTheKnownBound) {
  const FaceList s = copies(1);
  const SurfaceTree tree(s.positions, s.faces);
  EXPECT_EQ(tree.largest_distance(Points3(0, 3)), 0);
  EXPECT_EQ(tree.largest_distance(Points3(0, 3), 2), 2);
  EXPECT_THROW(tree.largest_distance(Points3::Zero(2000, 3), 0, CountedStop(2).check()), Stopped);
}

TEST(VertexTree, NearestOfAllAndOfTiesTheFirst) {
  std::mt19937 random(12);
  for (const Index count : {1, 2, 5, 16, 100, 500}) {
    Points3 points(count, 3);
    for (Index v = 0; v < count; ++v) {
      points.row(v) = random_vector(random, 1).transpose();
      if (v % 3 == 0) points.row(v) = (2 * points.row(v)).array().round() / 2;
      if (v % 7 == 6) points.row(v) = points.row(v - 1);
    }
    const VertexTree tree(points);
    for (int k = 0; k < 200; ++k) {
      Vector3 p = random_vector(random, 1.5);
      if (k % 2 == 0) p = (4 * p).array().round() / 4;
      Index nearest = 0;
      for (Index v = 1; v < count; ++v)
        if ((points.row(v).transpose() - p).squaredNorm() <
            (points.row(nearest).transpose() - p).squaredNorm())
          nearest = v;
      EXPECT_EQ(tree.nearest(p), nearest);
    }
  }
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

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
