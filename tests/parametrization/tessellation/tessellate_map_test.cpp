#include "majorant/parametrization/tessellation/tessellate_map.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "certify/exact_curves.h"
#include "io/io_test_helpers.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/tessellation/internal/cut_pieces.h"
#include "majorant/parametrization/tessellation/internal/map_pieces.h"

namespace majorant {
namespace {

using exact::Rational;
using Polygons = IndexLists;

// Returns twice the area, in exact arithmetic.
Rational area(const Vector2& a, const Vector2& b, const Vector2& c) {
  const auto minus = [](double x, double y) { return Rational(x) - Rational(y); };
  return minus(b.x(), a.x()) * minus(c.y(), a.y()) - minus(b.y(), a.y()) * minus(c.x(), a.x());
}

int count_not_positive(const PolygonMesh& mesh) {
  int count = 0;
  for (const auto& t : mesh.polygon_texcoords)
    for (std::size_t k = 2; k < t.size(); ++k)
      count += area(mesh.texcoords[t[0]], mesh.texcoords[t[k - 1]], mesh.texcoords[t[k]]) <= 0;
  return count;
}

// Returns the edges that only one polygon has. Fails where two polygons have the same side.
using Edges = std::set<std::pair<Index, Index>>;
Edges open_edges(const Polygons& polygons) {
  Edges edges, open;
  for (const auto& p : polygons)
    for (std::size_t k = 0; k < p.size(); ++k)
      EXPECT_TRUE(edges.emplace(p[k], p[(k + 1) % p.size()]).second);
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) open.emplace(a, b);
  return open;
}

// nx x ny unit squares on the plane z = 0, and the map that interpolates `bend` at its control
// points. The map equals `bend`, up to rounding, if that is a polynomial of at most the map's
// degree.
struct BentGrid {
  PolygonMesh input;
  MapFile map;

  template <class Bend>
  BentGrid(int degree, int nx, int ny, const Bend& bend) {
    for (int y = 0; y <= ny; ++y)
      for (int x = 0; x <= nx; ++x) input.positions.emplace_back(x, y, 0);
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        const Index v = y * (nx + 1) + x;
        input.polygons.push_back({v, v + 1, v + nx + 2, v + nx + 1});
      }
    auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(input));
    const Vec uv = Vec::Zero(2 * mesh->vertex_count());
    BezierMap linear = BezierMap::linear(std::move(mesh), uv);
    while (linear.degree() < degree) linear = linear.elevated();
    map = to_map_file(linear);
    const auto indices = bezier_multi_indices(degree);
    const auto size = static_cast<Index>(indices.size());
    Points3 places(size, 3);
    for (Index k = 0; k < size; ++k)
      for (Index c = 0; c < 3; ++c) places(k, c) = double(indices[k][c]) / degree;
    const Eigen::MatrixXd to_control = bernstein_values(degree, places).inverse();
    for (Index c = 0; c < map.cells.rows(); ++c) {
      Eigen::MatrixXd values(size, 2);
      for (Index k = 0; k < size; ++k) {
        const auto point = map.points.row(map.cells(c, k));
        values.row(k) = bend(point[0], point[1]).transpose();
      }
      const Eigen::MatrixXd control = to_control * values;
      for (Index k = 0; k < size; ++k) map.uv.row(map.cells(c, k)) = control.row(k);
    }
  }
};

// A strip around a circle: the larger the turn, the larger the curvature of its cells.
struct Arc {
  double turn;  // radians per unit of x
  Vector2 operator()(double x, double y) const {
    const double angle = turn * x, radius = 4 - y;
    return {radius * std::sin(angle), 4 - radius * std::cos(angle)};
  }
};

// Quadratic cells ABC, BAD and CBE. The curve from A to B passes below C, its chord above: ABC
// needs one cut at that edge. Control points other than the middle of AB are on straight lines.
struct OneBentEdge {
  PolygonMesh input;
  MapFile map;

  OneBentEdge() {
    input.positions = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1, 0}, {3, 1, 0}};
    input.polygons = {{0, 1, 2}, {1, 0, 3}, {2, 1, 4}};
    map.degree = 2;
    map.uv.resize(12, 2);
    map.uv.topRows<5>() << 0, 0, 2, 0, 1, -0.25, 1, -4, 3, 1;
    map.uv.row(5) << 1, -2;
    map.points.resize(12, 3);
    for (std::size_t v = 0; v < 5; ++v)
      map.points.row(static_cast<Index>(v)) = input.positions[v].transpose();
    map.cells.resize(3, 6);
    map.cells << 0, 1, 2, 5, 6, 7, 1, 0, 3, 5, 8, 9, 2, 1, 4, 6, 10, 11;
    const std::map<Index, std::pair<Index, Index>> middles = {
        {6, {1, 2}}, {7, {2, 0}}, {8, {0, 3}}, {9, {3, 1}}, {10, {1, 4}}, {11, {4, 2}}};
    map.points.row(5) = (map.points.row(0) + map.points.row(1)) / 2;
    for (const auto& [p, ends] : middles) {
      map.uv.row(p) = (map.uv.row(ends.first) + map.uv.row(ends.second)) / 2;
      map.points.row(p) = (map.points.row(ends.first) + map.points.row(ends.second)) / 2;
    }
    map.input_vertex = Eigen::VectorXi::Constant(12, -1);
    map.input_vertex.head<5>() << 0, 1, 2, 3, 4;
    map.input_face = Eigen::VectorXi::LinSpaced(3, 0, 2);
  }

  // Gives cell BAD its own points at another place: a cut along AB.
  void cut() {
    const Index n = map.points.rows();
    map.points.conservativeResize(n + 3, 3);
    map.uv.conservativeResize(n + 3, 2);
    map.input_vertex.conservativeResize(n + 3);
    Index copy = n;
    for (const Index p : {1, 0, 5}) {
      map.points.row(copy) = map.points.row(p);
      map.uv.row(copy) = map.uv.row(p);
      map.input_vertex[copy] = map.input_vertex[p];
      std::replace(map.cells.row(1).begin(), map.cells.row(1).end(), p, copy++);
    }
    for (const Index p : {n, n + 1, n + 2, 3, 8, 9}) map.uv(p, 0) += 10;
  }
};

TEST(TessellateMap, CellsThatAreValidWithStraightEdgesStay) {
  for (int degree = 2; degree <= 4; ++degree) {
    const BentGrid grid(degree, 12, 3, Arc{0.3});
    const PolygonMesh mesh = tessellate_map(grid.map, &grid.input);
    EXPECT_EQ(mesh.positions, grid.input.positions);
    EXPECT_EQ(mesh.polygons, grid.input.polygons);
    EXPECT_EQ(mesh.texcoords.size(), grid.input.positions.size());
    EXPECT_EQ(count_not_positive(tessellate_map(grid.map, nullptr)), 0);
    EXPECT_EQ(tessellate_map(grid.map, nullptr).polygons.size(), 72u);
  }
}

TEST(TessellateMap, OneCutSuffices) {
  const OneBentEdge example;
  EXPECT_EQ(count_not_positive(mesh_from_map(example.map, "")), 1);
  for (const PolygonMesh* input : {&example.input, static_cast<const PolygonMesh*>(nullptr)}) {
    const PolygonMesh mesh = tessellate_map(example.map, input);
    EXPECT_EQ(mesh.polygons, (Polygons{{0, 5, 2}, {5, 1, 2}, {5, 0, 3}, {1, 5, 3}, {2, 1, 4}}));
    EXPECT_EQ(mesh.polygon_texcoords, mesh.polygons);
    EXPECT_EQ(count_not_positive(mesh), 0);
    EXPECT_EQ(mesh.positions[5], Vector3(1, 0, 0));
    EXPECT_EQ(mesh.texcoords[5], Vector2(1, -1));
  }
}

TEST(TessellateMap, CutsAreClosedInSpace) {
  OneBentEdge example;
  example.cut();
  const PolygonMesh mesh = tessellate_map(example.map, &example.input);
  EXPECT_EQ(mesh.polygons, (Polygons{{0, 5, 2}, {5, 1, 2}, {5, 0, 3}, {1, 5, 3}, {2, 1, 4}}));
  EXPECT_EQ(mesh.texcoords.size(), 5u + 2 + 2);
  EXPECT_EQ(count_not_positive(mesh), 0);
  EXPECT_EQ(open_edges(mesh.polygons).size(), 5u);
  EXPECT_EQ(open_edges(mesh.polygon_texcoords).size(), 5u + 4);
  std::set<double> middles;  // of AB, in the plane
  for (const auto& t : mesh.texcoords)
    if (t.y() == -1) middles.insert(t.x());
  EXPECT_EQ(middles, (std::set<double>{1, 11}));
}

TEST(TessellateMap, PiecesArePositiveAndFitTogether) {
  for (int degree = 2; degree <= 4; ++degree)
    for (const int refine : {1, 3}) {
      // Cells are long, sheared by half a cell and bent by more than their width: corners of a row
      // are beyond the chords of the next one. det J = 1/2.
      const auto bend = [](double x, double y) {
        const double u = 4 * x + 2 * y;
        return Vector2(u, u * u / 20 + y / 8);
      };
      const BentGrid grid(degree, 4, 2, bend);
      const PolygonMesh mesh = tessellate_map(grid.map, nullptr, {.refine = refine});
      EXPECT_EQ(count_not_positive(mesh), 0);
      EXPECT_GE(mesh.polygons.size(), to_size(16 * refine * refine));
      if (refine == 1) {
        EXPECT_GT(count_not_positive(mesh_from_map(grid.map, "")), 0);
        EXPECT_GT(mesh.polygons.size(), 16u);
      }
      EXPECT_EQ(mesh.polygon_texcoords, mesh.polygons);  // one chart, no cut
      const Edges open = open_edges(mesh.polygons);
      Edges turned;
      for (const auto& [a, b] : open) turned.emplace(b, a);
      for (const auto& [a, b] : open) {  // all are on the boundary of the grid
        const Vector3 &p = mesh.positions[a], &q = mesh.positions[b];
        EXPECT_TRUE((p.x() == q.x() && (p.x() == 0 || p.x() == 4)) ||
                    (p.y() == q.y() && (p.y() == 0 || p.y() == 2)));
      }
      Rational covered = 0;
      for (const auto& t : mesh.polygons) {
        const auto flat = [&](std::size_t k) -> Vector2 { return mesh.positions[t[k]].head<2>(); };
        EXPECT_GT(area(flat(0), flat(1), flat(2)), 0);
        covered += area(flat(0), flat(1), flat(2));
      }
      EXPECT_NEAR(covered.convert_to<double>(), 16, 1e-12);
    }
}

TEST(TessellateMap, PointsLieOnTheMap) {
  const BentGrid grid(3, 2, 1, Arc{0.1});
  const PolygonMesh mesh = tessellate_map(grid.map, nullptr, {.refine = 2});
  ASSERT_EQ(mesh.polygons.size(), 16u);
  EXPECT_EQ(mesh.positions.size(), 15u);  // one midpoint per edge
  EXPECT_EQ(mesh.texcoords.size(), 15u);
  const auto edge = bezier_edge_points(3, 0);
  Vector2 middle = Vector2::Zero();
  const double weights[] = {0.125, 0.375, 0.375, 0.125};
  for (std::size_t s = 0; s < 4; ++s)
    middle += weights[s] * grid.map.uv.row(grid.map.cells(0, edge[s]));
  EXPECT_NEAR((mesh.texcoords[mesh.polygon_texcoords[0][1]] - middle).norm(), 0, 1e-15);
  const Vector3 flat =
      (grid.map.points.row(grid.map.cells(0, 0)) + grid.map.points.row(grid.map.cells(0, 1))) / 2;
  EXPECT_EQ(mesh.positions[mesh.polygons[0][1]], flat);
}

TEST(TessellateMap, SidesSharedInTheMapAndCutInTheInput) {
  PolygonMesh input;  // a square of two triangles without common vertices, joined in the map
  input.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  input.polygons = {{0, 1, 2}, {3, 5, 4}};
  MapFile map;
  map.degree = 2;
  map.points.resize(9, 3);
  map.points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0.5, 0, 0, 0.5, 0.5, 0, 0, 0.5, 0, 1, 0.5, 0,
      0.5, 1, 0;
  map.uv = map.points.leftCols<2>();
  map.cells.resize(2, 6);
  map.cells << 0, 1, 2, 4, 5, 6, 1, 3, 2, 7, 8, 5;
  map.input_vertex.resize(9);
  map.input_vertex << 0, 1, 2, 5, -1, -1, -1, -1, -1;
  map.input_face = Eigen::VectorXi::LinSpaced(2, 0, 1);
  map.uv.row(5) << 0.3, 0.3;  // bends the common edge: its midpoint is (0.4, 0.4)
  for (const int refine : {1, 2, 3}) {
    const PolygonMesh mesh = tessellate_map(map, &input, {.refine = refine});
    EXPECT_EQ(count_not_positive(mesh), 0);
    // One component in the plane, two in space, whose new vertices have equal positions.
    EXPECT_EQ(open_edges(mesh.polygon_texcoords).size(), to_size(4 * refine)) << refine;
    EXPECT_EQ(open_edges(mesh.polygons).size(), to_size(6 * refine)) << refine;
  }
  // Its two sides are not a boundary that intersects itself.
  EXPECT_EQ(tessellate_map(map, &input, {.overlap = Overlap::Excluded}).polygons, input.polygons);
}

TEST(TessellateMap, NamesCellsThatAreNotInjective) {
  const TemporaryFolder folder;
  OneBentEdge example;
  example.map.uv.row(4) << 1, -3;  // CBE is inverted
  const std::string message = error_message(
      ErrorKind::Invalid, [&] { write_obj(folder.file("out.obj"), example.map, &example.input); });
  EXPECT_NE(message.find("cell 2:"), std::string::npos) << message;
  EXPECT_NE(message.find("out.obj"), std::string::npos) << message;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  const MapFile nonsense = random_strip(3, 40, 11);
  const std::string many =
      error_message(ErrorKind::Invalid, [&] { tessellate_map(nonsense, nullptr); });
  EXPECT_NE(many.find("and others"), std::string::npos) << many;
}

TEST(TessellateMap, VerticesWoundTwiceAreNotValid) {
  MapFile map;  // five triangles of 144 degrees
  map.degree = 1;
  map.uv.resize(6, 2);
  map.points = Points3::Zero(6, 3);
  map.cells.resize(5, 3);
  map.uv.row(0).setZero();
  for (Index k = 0; k < 5; ++k) {
    const double angle = 0.1 + 0.8 * 3.14159265358979 * k;
    map.uv.row(k + 1) << std::cos(angle), std::sin(angle);
    map.points.row(k + 1) << std::cos(angle / 2), std::sin(angle / 2), 0;
    map.cells.row(k) << 0, k + 1, (k + 1) % 5 + 1;
  }
  const CornerMesh coarse = corner_mesh(map, "");
  EXPECT_EQ(count_not_positive(mesh_from_map(map, "")), 0);
  const MapPieces pieces(map, coarse, 1);
  const std::vector<MapPieces::Edge> spokes = spokes_of_wound_vertices(pieces);
  EXPECT_EQ(spokes.size(), 5u);
  for (const auto& spoke : spokes) EXPECT_EQ(pieces.points(spoke.cell)[spoke.i].vt, 0);
  error_message(ErrorKind::Invalid, [&] { tessellate_map(map, nullptr, {.refine = 2}); });
  for (Index k = 0; k < 5; ++k) map.uv.row(k + 1) = map.points.row(k + 1).head<2>();
  EXPECT_TRUE(spokes_of_wound_vertices(MapPieces(map, corner_mesh(map, ""), 1)).empty());
  EXPECT_EQ(tessellate_map(map, nullptr, {.refine = 2}).polygons.size(), 20u);
}

// Returns two separate cells: (0, 0), (2, 0), (1, 3) with a notch in its lower edge, up to (1,
// 0.5), and a straight triangle.
MapFile notch_and(const Vector2& a, const Vector2& b, const Vector2& c) {
  MapFile map;
  map.degree = 2;
  map.uv.resize(12, 2);
  map.uv << 0, 0, 2, 0, 1, 3, 1, 1, 1.5, 1.5, 0.5, 1.5, a.x(), a.y(), b.x(), b.y(), c.x(), c.y(),
      (a + b)[0] / 2, (a + b)[1] / 2, (b + c)[0] / 2, (b + c)[1] / 2, (c + a)[0] / 2,
      (c + a)[1] / 2;
  map.points = Points3::Zero(12, 3);
  map.points.leftCols<2>() = map.uv;
  map.points.bottomRows<6>().col(2).setOnes();
  map.cells.resize(2, 6);
  map.cells << 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11;
  return map;
}

TEST(TessellateMap, WithoutOverlapTheStraightBoundaryIsSimple) {
  const auto faces = [](const MapFile& map, Overlap overlap) {
    return tessellate_map(map, nullptr, {.overlap = overlap}).polygons.size();
  };
  const MapFile apart = notch_and({0.5, -2}, {1.5, -2}, {1, -1});
  EXPECT_EQ(faces(apart, Overlap::Excluded), 2u);
  const MapFile crossing = notch_and({0.8, -1}, {1.2, -1}, {1, 0.25});
  EXPECT_EQ(faces(crossing, Overlap::Allowed), 2u);
  EXPECT_EQ(faces(crossing, Overlap::Excluded), 3u);
  const MapFile nested = notch_and({0.9, 0.0625}, {1.1, 0.0625}, {1, 0.25});
  EXPECT_EQ(faces(nested, Overlap::Allowed), 2u);
  EXPECT_EQ(faces(nested, Overlap::Excluded), 3u);
  // The tip touches the curve itself, and a triangle of the tessellation.
  const MapFile touching = notch_and({0.8, -1}, {1.2, -1}, {1, 0.5});
  error_message(ErrorKind::Invalid, [&] { faces(touching, Overlap::Excluded); });
  const MapFile inside = notch_and({0.9, 1}, {1.1, 1}, {1, 1.5});
  error_message(ErrorKind::Invalid, [&] { faces(inside, Overlap::Excluded); });
}

TEST(TessellateMap, PolygonsWhoseImageIsNotSimpleBecomeTriangles) {
  for (const double angle : {2.6, 1.8}) {  // three triangles of that angle around corner 0
    PolygonMesh input;
    MapFile map;
    map.degree = 1;
    map.points = Points3::Zero(5, 3);
    map.uv = Points2::Zero(5, 2);
    input.positions.emplace_back(0, 0, 0);
    for (Index k = 1; k < 5; ++k) {
      map.points.row(k) << std::cos(0.5 * k), std::sin(0.5 * k), 0;
      map.uv.row(k) << std::cos(angle * k), std::sin(angle * k);
      input.positions.emplace_back(map.points.row(k).transpose());
    }
    input.polygons = {{0, 1, 2, 3, 4}};
    map.cells.resize(3, 3);
    map.cells << 0, 1, 2, 0, 2, 3, 0, 3, 4;
    map.input_vertex = Eigen::VectorXi::LinSpaced(5, 0, 4);
    map.input_face = Eigen::VectorXi::Zero(3);
    const PolygonMesh mesh = tessellate_map(map, &input);
    EXPECT_EQ(count_not_positive(mesh), 0);
    EXPECT_EQ(mesh.polygons.size(), angle > 2 ? 3u : 1u);
  }
}

TEST(TessellateMap, NormalsAndGroupsFollow) {
  OneBentEdge example;
  example.input.normals = {{0, 0, 1}, {0, 1, 0}};
  example.input.polygon_normals = {{0, 1, 0}, {}, {0, 0, 1}};
  example.input.positions.emplace_back(9, 9, 9);  // no face uses it
  example.input.directives = {{0, "g a"}, {2, "g b"}};
  const PolygonMesh mesh = tessellate_map(example.map, &example.input);
  EXPECT_EQ(mesh.positions[5], Vector3(9, 9, 9));
  EXPECT_EQ(mesh.polygons, (Polygons{{0, 6, 2}, {6, 1, 2}, {6, 0, 3}, {1, 6, 3}, {2, 1, 4}}));
  ASSERT_EQ(mesh.polygon_normals, (Polygons{{0, 2, 0}, {2, 1, 0}, {}, {}, {0, 0, 1}}));
  EXPECT_NEAR((mesh.normals[2] - Vector3(0, 1, 1) / std::sqrt(2.0)).norm(), 0, 1e-15);
  EXPECT_EQ(mesh.directives, (std::vector<std::pair<Index, std::string>>{{0, "g a"}, {4, "g b"}}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
