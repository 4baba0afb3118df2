#include "majorant/quads/check_quads.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/quads/exact_normals.h"
#include "mesh/list_edits.h"
#include "parametrization/fields/closed_surfaces.h"

namespace majorant {
namespace {

// The quads that the triangles of cube() and sphere() are halves of.
PolygonMesh quads_of(const PolygonMesh& halves) {
  PolygonMesh quads = halves;
  quads.polygons.clear();
  quads.polygon_lines.clear();
  for (std::size_t f = 0; f < halves.polygons.size(); f += 2) {
    const auto &a = halves.polygons[f], &b = halves.polygons[f + 1];
    quads.polygons.push_back({a[0], a[1], a[2], b[2]});
  }
  return quads;
}

TEST(ExactNormals, SignsOfTheLastBit) {
  const Vector3 a(0, 0, 0), c(1, 1, 0), b(1, 0, 0);
  const double tiny = std::numeric_limits<double>::denorm_min();
  for (const double y : {tiny, 1e-300, 1.0}) {
    // The corner at a, between b and a point that is y to the left of the line through a and b.
    const Vector3 left(-3, y, 0), right(-3, -y, 0), on(-3, 0, 0);
    EXPECT_EQ(sign_of_normals({a, b}, {a, left}, {a, c}, {b, Vector3(0, 1, 0)}), 1) << y;
    EXPECT_EQ(sign_of_normals({a, b}, {a, right}, {a, c}, {b, Vector3(0, 1, 0)}), -1) << y;
    EXPECT_EQ(sign_of_normals({a, b}, {a, on}, {a, c}, {b, Vector3(0, 1, 0)}), 0) << y;
  }
  // On one line, as x = y; differences and products of their coordinates are rounded all the same.
  // Then a last bit off it.
  const Vector3 p(0.1, 0.1, 0), q(0.2, 0.2, 0), r(0.3, 0.3, 0);
  EXPECT_EQ(sign_of_normals({p, q}, {p, r}, {a, b}, {a, Vector3(0, 1, 0)}), 0);
  const Vector3 above(0.3, std::nextafter(0.3, 1), 0);
  EXPECT_EQ(sign_of_normals({p, q}, {p, above}, {a, b}, {a, Vector3(0, 1, 0)}), 1);
}

TEST(CheckQuads, CubeIsValidAndMeasured) {
  const PolygonMesh halves = cube(4);
  const SurfaceMesh surface = SurfaceMesh::from_polygons(halves);
  const QuadCheck check = check_quads(quads_of(halves), &surface);
  EXPECT_TRUE(check.is_valid());
  EXPECT_EQ(check.count, 6 * 16);
  EXPECT_EQ(check.irregular, 8);
  EXPECT_EQ(check.topology.euler_characteristic(), 2);
  EXPECT_DOUBLE_EQ(check.min_scaled_jacobian, 1);
  EXPECT_DOUBLE_EQ(check.mean_scaled_jacobian, 1);
  EXPECT_NEAR(check.angle_deviation, 0, 1e-12);
  EXPECT_LT(check.hausdorff.to_surface, 1e-14);
  EXPECT_LT(check.hausdorff.from_surface, 1e-14);
}

TEST(CheckQuads, FoldedToTheLastBit) {
  const SurfaceMesh surface = SurfaceMesh::from_polygons(cube(4));
  PolygonMesh quads = quads_of(cube(4));
  // A corner of the first quad onto the line of its neighbours, then a last bit back.
  const auto first = quads.polygons[0];
  const Vector3 middle = (quads.positions[first[1]] + quads.positions[first[3]]) / 2;
  const Vector3 inward = quads.positions[first[0]] - middle;
  quads.positions[first[0]] = middle;
  EXPECT_EQ(check_quads(quads, &surface).folded, std::vector<Index>{0});
  for (int c = 0; c < 3; ++c)
    if (inward[c] != 0) {
      double& x = quads.positions[first[0]][c];
      x = std::nextafter(x, x + inward[c]);
    }
  EXPECT_TRUE(check_quads(quads, nullptr).folded.empty());
}

TEST(CheckQuads, TurnedInsideOut) {
  const SurfaceMesh surface = SurfaceMesh::from_polygons(sphere(5));
  PolygonMesh quads = quads_of(sphere(5));
  EXPECT_TRUE(check_quads(quads, &surface).is_valid());
  for (const auto polygon : quads.polygons) std::swap(polygon[1], polygon[3]);
  const QuadCheck check = check_quads(quads, &surface);
  EXPECT_EQ(static_cast<Index>(check.turned.size()), check.count);
  EXPECT_TRUE(check.folded.empty());
  EXPECT_TRUE(check_quads(quads, nullptr).is_valid());
}

// Above the ridge of a steep roof both of its sides are as near.
TEST(CheckQuads, TurnedAgainstOneOfTheNearestFaces) {
  PolygonMesh roof;
  roof.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0.5, -3}, {-1, 0.5, -3}};
  roof.polygons = {{0, 2, 1}, {0, 1, 3}};
  const SurfaceMesh surface = SurfaceMesh::from_polygons(roof);
  for (const double lean : {-1.0, 0.0, 1.0}) {  // of the quad's normal (lean, 0, 1)
    PolygonMesh quad;
    for (const Vector3& p :
         {Vector3(-1, 0, 0), Vector3(1, 0, 0), Vector3(1, 1, 0), Vector3(-1, 1, 0)})
      quad.positions.push_back(p + Vector3(0, 0, 2 - lean * p.x()));
    quad.polygons = {{0, 1, 2, 3}};
    EXPECT_EQ(check_quads(quad, &surface).turned.size(), lean == 0 ? 0u : 1u) << lean;
  }
}

// A bent quad on a wall thinner than it is high: its middle is nearer to the wall's other side. One
// that is turned over faces away at its corners, too.
TEST(CheckQuads, ThinWalls) {
  PolygonMesh wall;
  for (const double z : {0.0, -0.1})
    for (const double x : {-1.0, 0.0, 1.0})
      for (const double y : {0.0, 2.0}) wall.positions.emplace_back(x, y, z + (x == 0 ? 0.3 : 0));
  wall.polygons = {{0, 2, 3, 1},   {2, 4, 5, 3}, {6, 7, 9, 8},  {8, 9, 11, 10}, {0, 1, 7, 6},
                   {4, 10, 11, 5}, {0, 6, 8, 2}, {2, 8, 10, 4}, {1, 3, 9, 7},   {3, 5, 11, 9}};
  const SurfaceMesh surface = SurfaceMesh::from_polygons(wall);
  PolygonMesh quad;
  quad.positions = {wall.positions[0], wall.positions[4], wall.positions[5], wall.positions[1]};
  quad.polygons = {{0, 1, 2, 3}};
  EXPECT_TRUE(check_quads(quad, &surface).turned.empty());
  quad.positions = {{-0.9, 0.2, 0.03}, {0.9, 0.2, 0.03}, {0.9, 1.8, 0.03}, {-0.9, 1.8, 0.03}};
  EXPECT_TRUE(check_quads(quad, &surface).turned.empty());
  std::ranges::reverse(quad.positions);
  EXPECT_EQ(check_quads(quad, &surface).turned.size(), 1u);
}

TEST(CheckQuads, DistancesToTheSurface) {
  const SurfaceMesh surface = SurfaceMesh::from_polygons(cube(4));
  PolygonMesh quads = quads_of(cube(4));
  QuadCheck check = check_quads(quads, &surface);
  require_near(check, surface, 0);
  EXPECT_LE(check.hausdorff.to_surface, 1e-14);
  check = check_quads(quads, &surface);
  require_near(check, surface);
  EXPECT_TRUE(check.is_valid());
  for (Vector3& p : quads.positions) p *= 5;
  check = check_quads(quads, &surface);
  EXPECT_TRUE(check.is_valid());
  require_near(check, surface);
  EXPECT_EQ(check.defects.size(), 2u);
}

TEST(CheckQuads, OtherSurface) {
  const SurfaceMesh torus_surface = SurfaceMesh::from_polygons(torus(12, 8, 0));
  const QuadCheck check = check_quads(quads_of(sphere(3)), &torus_surface);
  ASSERT_FALSE(check.is_valid());
  EXPECT_NE(check.defects.front().find("Euler characteristic of the quads: 2, of the surface: 0"),
            std::string::npos);
}

// Returns the unit quads of the square [0, n]^2, without cells (i, j) where is_hole(i, j).
template <class IsHole>
PolygonMesh plate(int n, const IsHole& is_hole) {
  PolygonMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.positions.emplace_back(i, j, 0);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + n + 1;
      if (!is_hole(i, j)) mesh.polygons.push_back({a, a + 1, b + 1, b});
    }
  return mesh;
}

SurfaceMesh surface_of(PolygonMesh quads) {
  std::vector<std::vector<Index>> halves;
  for (const auto& q : quads.polygons) {
    halves.push_back({q[0], q[1], q[2]});
    halves.push_back({q[0], q[2], q[3]});
  }
  quads.polygons = std::move(halves);
  return SurfaceMesh::from_polygons(quads, {}, Components::Any);
}

bool says(const QuadCheck& check, const std::string& what) {
  return std::any_of(check.defects.begin(), check.defects.end(), [&](const std::string& defect) {
    return defect.find(what) != std::string::npos;
  });
}

TEST(CheckQuads, BordersAreFollowed) {
  const PolygonMesh sound = plate(4, [](int, int) { return false; });
  const SurfaceMesh surface = surface_of(sound);
  EXPECT_TRUE(check_quads(sound, &surface).is_valid());
  PolygonMesh off = sound;
  off.positions[2] = {2, 0.01, 0};
  EXPECT_TRUE(says(check_quads(off, &surface), "border vertex is off the surface's border (3)"));
  PolygonMesh unordered = sound;  // beyond the next vertex of its side
  unordered.positions[2] = {3.5, 0, 0};
  EXPECT_TRUE(says(check_quads(unordered, &surface), "does not follow one of the surface once"));
  PolygonMesh skipped = sound;
  skipped.positions[0] = {0.5, 0, 0};
  const QuadCheck without_corner = check_quads(skipped, &surface);
  ASSERT_EQ(without_corner.defects.size(), 1u);
  EXPECT_TRUE(says(without_corner, "corner of the surface's border has no vertex"));
}

TEST(CheckQuads, TwoLoopsOnOneOfTheSurface) {
  const auto middle = [](int i, int j) { return i == 2 && j == 2; };
  PolygonMesh quads = plate(5, middle);
  const SurfaceMesh surface = surface_of(quads);
  EXPECT_TRUE(check_quads(quads, &surface).is_valid());
  // The hole's four vertices onto the outer border, in order.
  const Index corner = 2 * 6 + 2;
  quads.positions[corner] = {0, 0.5, 0};
  quads.positions[corner + 1] = {0.5, 0, 0};
  quads.positions[corner + 7] = {5, 4.5, 0};
  quads.positions[corner + 6] = {4.5, 5, 0};
  EXPECT_TRUE(says(check_quads(quads, &surface), "does not follow one of the surface once"));
}

// Two square holes that are one, since the corner where they meet is two vertices at one place.
TEST(CheckQuads, BordersThatTouch) {
  PolygonMesh quads =
      plate(6, [](int i, int j) { return (i == 2 && j == 2) || (i == 3 && j == 3); });
  const Index corner = 3 * 7 + 3;
  const std::span<Index> corners = quads.polygons.indices();
  *std::find(corners.begin(), corners.end(), corner) = static_cast<Index>(quads.positions.size());
  quads.positions.push_back(Vector3(quads.positions[corner]));
  const SurfaceMesh surface = surface_of(quads);
  EXPECT_EQ(surface.topology().boundary_loops, 2);
  const QuadCheck check = check_quads(quads, &surface);
  EXPECT_TRUE(check.is_valid()) << check.defects.front();
}

// A sheet of so many squares, cut open from a third of its height to two thirds.
PolygonMesh slit_plate(int squares) {
  PolygonMesh quads = plate(squares, [](int, int) { return false; });
  for (Vector3& p : quads.positions) p *= 12.0 / squares;
  const auto count = static_cast<Index>(quads.positions.size());
  for (Index v = 0; v < count; ++v) {
    const Vector3 p = quads.positions[v];
    if (p.x() != 6 || p.y() <= 4 || p.y() >= 8) continue;
    const auto other = static_cast<Index>(quads.positions.size());
    quads.positions.push_back(p);
    for (const std::span<Index> quad : quads.polygons) {
      double sum = 0;
      for (const Index u : quad) sum += quads.positions[u].x();
      if (sum > 4 * 6) std::replace(quad.begin(), quad.end(), v, other);
    }
  }
  return quads;
}

// Vertices within the edges of a slit, whose sides are at one place.
TEST(CheckQuads, BordersThatAreAtOnePlace) {
  const SurfaceMesh surface = surface_of(slit_plate(6));
  EXPECT_EQ(surface.topology().boundary_loops, 2);
  PolygonMesh quads = slit_plate(12);
  const QuadCheck check = check_quads(quads, &surface);
  EXPECT_TRUE(check.is_valid()) << check.defects.front();
  quads.positions.back().y() = 4.5;  // beyond the next one
  EXPECT_TRUE(says(check_quads(quads, &surface), "does not follow one of the surface once"));
}

// Two surfaces with equal sums of Euler characteristics, components and loops: a closed cube and
// one without two opposite sides, or two cubes without one side.
TEST(CheckQuads, ComponentsAreComparedByThemselves) {
  const auto cubes = [](std::size_t left_out_of_first, std::size_t left_out_of_second) {
    PolygonMesh both = quads_of(cube(1));
    const PolygonMesh one = both;
    const auto count = static_cast<Index>(one.positions.size());
    erase_lists(both.polygons, 0, left_out_of_first);
    for (const Vector3& p : one.positions) both.positions.push_back(p + Vector3(3, 0, 0));
    for (std::size_t q = left_out_of_second; q < one.polygons.size(); ++q) {
      both.polygons.push_back(one.polygons[q]);
      for (Index& v : both.polygons.back()) v += count;
    }
    return both;
  };
  const SurfaceMesh surface = surface_of(cubes(0, 2));
  EXPECT_TRUE(check_quads(cubes(0, 2), &surface).is_valid());
  EXPECT_TRUE(says(check_quads(cubes(1, 1), &surface), "not component by component"));
}

TEST(CheckQuads, RefusesInvalidMeshes) {
  PolygonMesh quads = quads_of(cube(1));
  quads.polygons[0][0] = 99;
  EXPECT_THROW(check_quads(quads, nullptr), InvalidArgument);
  set_list(quads.polygons, 0, {0, 1, 2});
  const QuadCheck check = check_quads(quads, nullptr);
  EXPECT_FALSE(check.is_valid());
  EXPECT_FALSE(check.is_surface);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
