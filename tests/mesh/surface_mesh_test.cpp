// Polygons become triangles, the file's numbers are kept, boundary loops have the direction of the
// faces.
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "counted_stop.h"
#include "expected_error.h"
#include "majorant/mesh/triangulate_polygon.h"
#include "mesh/list_edits.h"
#include "mesh/obj_file.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

double signed_area(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& normal) {
  return 0.5 * (b - a).cross(c - a).dot(normal);
}

// Tests the triangulations of a plane polygon for all first corners and both orientations, in the
// xy plane and tilted: n - 2 positive triangles whose union is the polygon.
void expect_triangulates(const std::vector<Vector2>& polygon, const char* name) {
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(1.1, Vector3(1, 2, 3).normalized()).toRotationMatrix();
  double area = 0;
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vector2 &p = polygon[k], &q = polygon[(k + 1) % n];
    area += 0.5 * (p.x() * q.y() - p.y() * q.x());
  }
  ASSERT_GT(area, 0) << name;
  for (const Eigen::Matrix3d& turn : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), tilt})
    for (const bool reversed : {false, true})
      for (std::size_t start = 0; start < n; ++start) {
        std::vector<Vector3> corners;
        for (std::size_t k = 0; k < n; ++k) {
          const Vector2& p = polygon[reversed ? (start + n - k) % n : (start + k) % n];
          corners.push_back(turn * Vector3(p.x(), p.y(), 0) + Vector3(3, -1, 2));
        }
        const Vector3 normal = turn * Vector3(0, 0, reversed ? -1 : 1);
        const auto triangles = triangulate_polygon(corners);
        ASSERT_EQ(triangles.size(), n - 2) << name;
        double sum = 0;
        std::set<int> used;
        for (const auto& t : triangles) {
          const double part = signed_area(corners[t[0]], corners[t[1]], corners[t[2]], normal);
          EXPECT_GT(part, 1e-9 * area) << name << ", start " << start << ", reversed " << reversed;
          sum += part;
          used.insert(t.begin(), t.end());
        }
        EXPECT_NEAR(sum, area, 1e-12 * area) << name << ", start " << start;
        EXPECT_EQ(used.size(), n) << name;
      }
}

TEST(TriangulatePolygon, Convex) {
  expect_triangulates({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, "square");
  expect_triangulates({{0, 0}, {4, 0}, {5, 1}, {1, 3}}, "quad");
  std::vector<Vector2> polygon;
  for (int k = 0; k < 11; ++k)
    polygon.push_back({2 * std::cos(2 * kPi * k / 11), std::sin(2 * kPi * k / 11)});
  expect_triangulates(polygon, "ellipse");
}

TEST(TriangulatePolygon, Concave) {
  expect_triangulates({{0, 0}, {2, -1}, {0.5, 0}, {2, 1}}, "dart");
  expect_triangulates({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, "L");
  expect_triangulates({{0, 0}, {5, 0}, {5, 0.2}, {0.1, 0.2}, {0.1, 7}, {0, 7}}, "thin L");
  expect_triangulates({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}, "U");
  std::vector<Vector2> star;
  for (int k = 0; k < 10; ++k) {
    const double r = k % 2 == 0 ? 1 : 0.3;
    star.push_back({r * std::cos(2 * kPi * k / 10), r * std::sin(2 * kPi * k / 10)});
  }
  expect_triangulates(star, "star");
  expect_triangulates(
      {{0, 0}, {4, 0}, {4, 4}, {1, 4}, {1, 2}, {2, 2}, {2, 3}, {3, 3}, {3, 1}, {0, 1}}, "spiral");
}

// A corner on the line between its neighbours must not be an ear of area 0.
TEST(TriangulatePolygon, StraightCorners) {
  expect_triangulates({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, "square and one midpoint");
  expect_triangulates({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}},
                      "square and four midpoints");
  expect_triangulates({{0, 0}, {1, 0}, {2, 0}, {1, 2}}, "triangle and one midpoint");
  expect_triangulates({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1.5, 2}}, "triangle and two midpoints");
}

TEST(TriangulatePolygon, TakesTheBetterDiagonalOfAQuad) {
  const auto triangles = triangulate_polygon({{0, 0, 0}, {1, -0.2, 0}, {2, 0, 0}, {1, 0.2, 0}});
  ASSERT_EQ(triangles.size(), 2u);
  for (const auto& t : triangles) {  // the short diagonal 1 - 3 is in both
    EXPECT_NE(std::find(t.begin(), t.end(), 1), t.end());
    EXPECT_NE(std::find(t.begin(), t.end(), 3), t.end());
  }
}

// Polygons of n corners that are difficult for ear clipping.
std::vector<Vector2> ngon(int n) {
  std::vector<Vector2> polygon;
  for (int k = 0; k < n; ++k)
    polygon.push_back({std::cos(2 * kPi * k / n), std::sin(2 * kPi * k / n)});
  return polygon;
}
std::vector<Vector2> star_of(int n) {
  std::vector<Vector2> polygon = ngon(n);
  for (int k = 1; k < n; k += 2) polygon[k] *= 0.3;
  return polygon;
}
std::vector<Vector2> comb_of(int n) {  // teeth upwards, back along the bottom
  std::vector<Vector2> polygon{{0, -1}};
  for (int k = 0; k + 2 < n; ++k) polygon.push_back({double(n - k), k % 2 == 0 ? 0.0 : 10.0});
  polygon.insert(polygon.begin() + 1, {double(n) + 1, -1});
  return polygon;
}
std::vector<Vector2> spiral_of(int n) {  // outwards along one arm, back along the other
  std::vector<Vector2> polygon;
  const int arm = n / 2;
  const auto point = [&](int k, double offset) {
    const double angle = 8 * kPi * k / arm, radius = 1 + angle / (2 * kPi) + offset;
    return Vector2(radius * std::cos(angle), radius * std::sin(angle));
  };
  for (int k = 0; k < n - arm; ++k) polygon.push_back(point(k, 0.5));
  for (int k = arm - 1; k >= 0; --k) polygon.push_back(point(k, 0));
  return polygon;
}
std::vector<Vector2> square_of(int n) {  // sides of many collinear corners
  std::vector<Vector2> polygon;
  for (int k = 0; k < n; ++k) {
    const double t = 4.0 * k / n, s = t - std::floor(t);
    const Vector2 sides[] = {{s, 0}, {1, s}, {1 - s, 1}, {0, 1 - s}};
    polygon.push_back(sides[int(t)]);
  }
  return polygon;
}

// Work is counted in stop checks: each is for O(n) of work, or for 4096 corners.
TEST(TriangulatePolygon, ManyCornersInTimeOfTheSquareAtMost) {
  using Maker = std::vector<Vector2> (*)(int);
  const std::pair<const char*, Maker> makers[] = {{"ngon", ngon},
                                                  {"star", star_of},
                                                  {"comb", comb_of},
                                                  {"spiral", spiral_of},
                                                  {"square", square_of}};
  for (const auto& [name, make] : makers)
    for (const int n : {3, 4, 5, 8, 20, 63, 64, 65, 100, 500, 2048, 2049, 5000}) {
      if ((make == star_of && n % 2 != 0) || (make == spiral_of && n < 100)) continue;
      SCOPED_TRACE(name + (" " + std::to_string(n)));
      const std::vector<Vector2> polygon = make(n);
      std::vector<Vector3> corners;
      double area = 0;
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vector2 &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        corners.push_back({p.x(), p.y(), 0});
        area += 0.5 * (p.x() * q.y() - p.y() * q.x());
      }
      ASSERT_GT(area, 0);
      const CountedStop stop;
      const auto triangles = triangulate_polygon(corners, stop.check());
      EXPECT_LE(stop.polls(), 4 * n);
      ASSERT_EQ(triangles.size(), corners.size() - 2);
      double sum = 0, least = area;
      for (const auto& t : triangles) {
        const double part =
            signed_area(corners[t[0]], corners[t[1]], corners[t[2]], Vector3::UnitZ());
        sum += part;
        least = std::min(least, part);
      }
      EXPECT_NEAR(sum, area, 1e-9 * area);
      EXPECT_GE(least, -1e-12 * area);
    }
}

TEST(TriangulatePolygon, StopsAnywhere) {
  std::vector<Vector3> corners;
  for (const Vector2& p : star_of(400)) corners.push_back({p.x(), p.y(), 0});
  for (const long k : {1L, 2L, 399L, 400L, 700L, 1100L}) {
    const CountedStop stop(k);
    EXPECT_THROW(triangulate_polygon(corners, stop.check()), Stopped);
    EXPECT_EQ(stop.polls_after(), 0);
  }
}

// Small ones are triangulated nevertheless, large ones are refused.
TEST(TriangulatePolygon, PolygonsThatAreNotSimple) {
  std::mt19937 random(7);
  for (const int n : {5, 30, 300, 2048, 3000}) {
    std::vector<Vector3> corners;
    for (int k = 0; k < n; ++k)
      corners.push_back(
          {(random() % 4096) / 4096.0, (random() % 4096) / 4096.0, (random() % 4096) / 40960.0});
    if (n <= 2048) {
      EXPECT_EQ(triangulate_polygon(corners).size(), to_size(n) - 2);
      continue;
    }
    std::vector<Index> all(corners.size());
    std::iota(all.begin(), all.end(), 0);
    const PolygonMesh mesh = polygon_mesh(corners, std::vector<std::vector<Index>>{all});
    expect_contains(
        error_message(ErrorKind::Unsupported, [&] { SurfaceMesh::from_polygons(mesh); }),
        {"inline.obj:101", "3000 corners", "crosses or touches itself"});
  }
}

TEST(SurfaceMesh, LeavesOutUnreferencedVerticesAndRemembersNumbers) {
  PolygonMesh input =
      polygon_mesh({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {7, 7, 7}, {1, 1, 0}, {0, 1, 0}, {8, 8, 8}},
                   {{1, 2, 4}, {1, 4, 5}});
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
  ASSERT_EQ(mesh.vertex_count(), 4);
  const std::vector<Index> expected{1, 2, 4, 5};
  for (Index v = 0; v < 4; ++v) {
    EXPECT_EQ(mesh.input_vertex(v), expected[v]);
    EXPECT_EQ(mesh.find_input_vertex(mesh.input_vertex(v)), v);
    EXPECT_EQ(Vector3(mesh.positions().row(v).transpose()), input.positions[expected[v]]);
  }
  for (const Index unused : {0, 3, 6, 7, 1000, -1}) EXPECT_EQ(mesh.find_input_vertex(unused), -1);
  EXPECT_EQ(mesh.file(), "inline.obj");
  EXPECT_DOUBLE_EQ(mesh.area(), 1.0);
}

TEST(SurfaceMesh, RemembersThePolygonOfATriangle) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(
      polygon_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {0, 1, 0}, {1, 2, 0}},
                   {{0, 1, 4, 5}, {1, 2, 3, 4}, {5, 4, 6}, {4, 3, 6}}));
  ASSERT_EQ(mesh.face_count(), 6);
  std::vector<Index> polygons;
  for (Index f = 0; f < 6; ++f) polygons.push_back(mesh.input_face(f));
  EXPECT_EQ(polygons, (std::vector<Index>{0, 0, 1, 1, 2, 3}));
  EXPECT_DOUBLE_EQ(mesh.area(), 3.0);
  EXPECT_EQ(mesh.topology().faces, 6);
}

// Expects that every step of a loop is a half-edge of exactly one face, and that all such edges
// occur.
void expect_proper_loops(const SurfaceMesh& mesh) {
  std::set<std::pair<Index, Index>> boundary;
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int k = 0; k < 3; ++k) boundary.insert({mesh.faces()(f, k), mesh.faces()(f, (k + 1) % 3)});
  std::set<std::pair<Index, Index>> inner;
  for (const auto& [a, b] : boundary)
    if (boundary.count({b, a})) inner.insert({a, b});
  for (const auto& edge : inner) boundary.erase(edge);
  std::size_t steps = 0;
  Index last_start = -1;
  for (const auto& loop : mesh.boundary_loops()) {
    EXPECT_EQ(loop.front(), *std::min_element(loop.begin(), loop.end()));
    EXPECT_GT(loop.front(), last_start);
    last_start = loop.front();
    for (std::size_t k = 0; k < loop.size(); ++k, ++steps)
      EXPECT_TRUE(boundary.count({loop[k], loop[(k + 1) % loop.size()]}));
  }
  EXPECT_EQ(steps, boundary.size());
  EXPECT_EQ(mesh.topology().boundary_loops, static_cast<Index>(mesh.boundary_loops().size()));
}

TEST(SurfaceMesh, BoundaryLoopsRunWithTheFaces) {
  const SurfaceMesh square = SurfaceMesh::from_polygons(grid(2));
  ASSERT_EQ(square.boundary_loops().size(), 1u);
  EXPECT_EQ(square.boundary_loops()[0], (std::vector<Index>{0, 1, 2, 5, 8, 7, 6, 3}));

  PolygonMesh reversed = grid(2);
  reverse_lists(reversed.polygons);
  EXPECT_EQ(SurfaceMesh::from_polygons(reversed).boundary_loops()[0],
            (std::vector<Index>{0, 3, 6, 7, 8, 5, 2, 1}));

  for (const char* name : {"cap", "creature", "ribbon", "tube", "wavy_disk"}) {
    SCOPED_TRACE(name);
    expect_proper_loops(*generated(name));
  }
  PolygonMesh annulus = grid(5);
  erase_lists(annulus.polygons, 24, 2);
  annulus.polygon_lines.resize(48);
  const SurfaceMesh two = SurfaceMesh::from_polygons(annulus);
  EXPECT_EQ(two.boundary_loops().size(), 2u);
  expect_proper_loops(two);
}

TEST(SurfaceMesh, CountsTopology) {
  const Topology disk = SurfaceMesh::from_polygons(grid(4)).topology();
  EXPECT_EQ(disk.vertices, 25);
  EXPECT_EQ(disk.edges, 56);
  EXPECT_EQ(disk.faces, 32);
  EXPECT_EQ(disk.components, 1);
  EXPECT_EQ(disk.boundary_loops, 1);
  EXPECT_EQ(disk.euler_characteristic(), 1);
  const Topology closed = SurfaceMesh::from_polygons(torus(8, 6, 0)).topology();
  EXPECT_EQ(closed.boundary_loops, 0);
  EXPECT_EQ(closed.euler_characteristic(), 0);
  const Topology open = SurfaceMesh::from_polygons(torus(8, 6, 1)).topology();
  EXPECT_EQ(open.boundary_loops, 1);
  EXPECT_EQ(open.euler_characteristic(), -1);
}

TEST(SurfaceMesh, KeepsTextureCoordinatesByCorner) {
  PolygonMesh input = grid(1);
  input.polygons = {{0, 1, 3, 2}};
  input.polygon_lines = {101};
  input.texcoords = {{0, 0}, {10, 0}, {10, 20}, {0, 20}};
  input.polygon_texcoords = {{0, 1, 2, 3}};
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
  ASSERT_EQ(mesh.corner_texcoords().rows(), 2);
  for (Index f = 0; f < 2; ++f)
    for (int k = 0; k < 3; ++k) {
      const auto p = mesh.positions().row(mesh.faces()(f, k));
      EXPECT_EQ(mesh.corner_texcoords()(f, 2 * k), 10 * p.x());
      EXPECT_EQ(mesh.corner_texcoords()(f, 2 * k + 1), 20 * p.y());
    }
  input.polygons = {{0, 1, 3}, {0, 3, 2}};
  input.polygon_lines = {101, 102};
  input.polygon_texcoords = {{0, 1, 2}, {}};  // a face without
  const SurfaceMesh half = SurfaceMesh::from_polygons(input);
  EXPECT_EQ(half.texcoord_ids(), (Cells(2, 3) << 0, 1, 2, -1, -1, -1).finished());
  EXPECT_TRUE(half.corner_texcoords().row(0).allFinite());
  EXPECT_TRUE(half.corner_texcoords().row(1).array().isNaN().all());
  input.polygon_texcoords = {{}, {}};
  EXPECT_EQ(SurfaceMesh::from_polygons(input).corner_texcoords().rows(), 0);
}

// Arrays of any order and stride give the mesh of the polygons.
TEST(SurfaceMesh, FromArraysIsFromPolygons) {
  const PolygonMesh input = grid(3, bumpy);
  const SurfaceMesh expected = SurfaceMesh::from_polygons(input);
  const auto vertices = static_cast<Index>(input.positions.size());
  Eigen::MatrixXd v(vertices, 3);  // column-major
  for (Index k = 0; k < vertices; ++k) v.row(k) = input.positions[k];
  Eigen::MatrixXi f(static_cast<Index>(input.polygons.size()), 3);
  for (Index k = 0; k < f.rows(); ++k)
    for (Index c = 0; c < 3; ++c) f(k, c) = input.polygons[k][c];
  const RowMatrix rows = v;
  RowMatrix wide = RowMatrix::Constant(vertices, 5, 7);
  wide.middleCols(1, 3) = v;
  const Points3 points = v;
  for (const SurfaceMesh& mesh :
       {SurfaceMesh::from_arrays(v, f), SurfaceMesh::from_arrays(rows, f),
        SurfaceMesh::from_arrays(wide.middleCols(1, 3), f), SurfaceMesh::from_arrays(points, f),
        SurfaceMesh::from_arrays(Eigen::Map<const RowMatrix>(rows.data(), vertices, 3), f)}) {
    EXPECT_EQ(mesh.positions(), expected.positions());
    EXPECT_EQ(mesh.faces(), expected.faces());
    EXPECT_EQ(mesh.opposites(), expected.opposites());
    EXPECT_TRUE(mesh.file().empty());
  }
}

TEST(SurfaceMesh, FromArraysOfQuadsLeadsBackToRows) {
  RowMatrix v(7, 3);
  v << 9, 9, 9, 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0;
  const Cells quads = (Cells(2, 4) << 1, 2, 5, 4, 2, 3, 6, 5).finished();
  const SurfaceMesh mesh = SurfaceMesh::from_arrays(v, quads);
  EXPECT_EQ(mesh.face_count(), 4);
  EXPECT_EQ(mesh.vertex_count(), 6) << "vertex 0 is used by no face";
  for (Index k = 0; k < mesh.vertex_count(); ++k)
    EXPECT_EQ(mesh.positions().row(k), v.row(mesh.input_vertex(k)));
  for (Index f = 0; f < 4; ++f) EXPECT_EQ(mesh.input_face(f), f / 2);
  EXPECT_EQ(mesh.find_input_vertex(0), -1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
