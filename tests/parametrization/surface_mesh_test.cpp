// Polygons become triangles, the file's numbers are kept, boundary loops run with the faces.
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <set>

#include "parametrization/parametrization_test_helpers.h"

namespace majorant {
namespace {

double signed_area(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& normal) {
  return 0.5 * (b - a).cross(c - a).dot(normal);
}

// All of a plane polygon's triangulations, whatever corner it starts at, in both orientations, in
// the xy plane and tilted: n - 2 triangles, none inverted or empty, together the polygon.
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
          const double part =
              signed_area(corners[at(t[0])], corners[at(t[1])], corners[at(t[2])], normal);
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

// A corner on the line between its neighbours must not become an empty ear.
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

TEST(SurfaceMesh, LeavesOutUnreferencedVerticesAndRemembersNumbers) {
  PolygonMesh input =
      polygon_mesh({{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {7, 7, 7}, {1, 1, 0}, {0, 1, 0}, {8, 8, 8}},
                   {{1, 2, 4}, {1, 4, 5}});
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(input);
  ASSERT_EQ(mesh.vertex_count(), 4);
  const std::vector<Index> expected{1, 2, 4, 5};
  for (Index v = 0; v < 4; ++v) {
    EXPECT_EQ(mesh.input_vertex(v), expected[at(v)]);
    EXPECT_EQ(mesh.find_input_vertex(mesh.input_vertex(v)), v);
    EXPECT_EQ(Vector3(mesh.positions().row(v).transpose()), input.positions[at(expected[at(v)])]);
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

// Every step of a loop is a half-edge of a face, no other face has it, and all such edges occur.
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
  for (auto& polygon : reversed.polygons) std::reverse(polygon.begin(), polygon.end());
  EXPECT_EQ(SurfaceMesh::from_polygons(reversed).boundary_loops()[0],
            (std::vector<Index>{0, 3, 6, 7, 8, 5, 2, 1}));

  for (const char* name : {"cap", "creature", "ribbon", "tube", "wavy_disk"}) {
    SCOPED_TRACE(name);
    expect_proper_loops(*generated(name));
  }
  PolygonMesh annulus = grid(5);
  annulus.polygons.erase(annulus.polygons.begin() + 24, annulus.polygons.begin() + 26);
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
  input.polygon_texcoords = {{0, 1, 2}, {}};  // a face without: none at all
  EXPECT_EQ(SurfaceMesh::from_polygons(input).corner_texcoords().rows(), 0);
}

}  // namespace
}  // namespace majorant
