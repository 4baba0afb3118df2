#include <Eigen/Geometry>
#include <limits>
#include <map>

#include "io_test_helpers.h"
#include "majorant/io/formats.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/written_mark.h"

namespace majorant {
namespace {

using Polygons = IndexLists;

// A quad (two cells) and a triangle, with a cut along their common edge (vertices 2 and 3).
struct QuadExample {
  PolygonMesh input;
  MapFile map;

  QuadExample() {
    input.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.1, 0}};
    input.polygons = {{1, 2, 3, 4}, {2, 5, 3}};
    input.normals = {{0, 0, 1}};
    input.polygon_normals = {{0, 0, 0, 0}, {}};
    input.directives = {{0, "mtllib m.mtl"}, {0, "g a"}, {1, "usemtl red"}, {2, "s off"}};
    map.degree = 1;
    map.input_vertex.resize(7);
    map.input_vertex << 1, 2, 3, 4, 2, 5, 3;
    map.points.resize(7, 3);
    for (Index p = 0; p < 7; ++p) {
      map.points.row(p) = input.positions[static_cast<std::size_t>(map.input_vertex[p])];
    }
    map.uv.resize(7, 2);
    map.uv << 0, 0, 1.0 / 3.0, 0, 1, 1e-300, 0, 1, 5, 0, 6, 0, 5, 1;
    map.cells.resize(3, 3);
    map.cells << 4, 5, 6, 0, 1, 2, 0, 2, 3;
    map.input_face.resize(3);
    map.input_face << 1, 0, 0;
  }
};

TEST(WriteObj, DegreeOneKeepsTheInput) {
  const TemporaryFolder folder;
  const QuadExample example;
  write_obj(folder.file("out.obj"), example.map, &example.input);
  const PolygonMesh mesh = read_mesh(folder.file("out.obj"));
  EXPECT_EQ(mesh.positions, example.input.positions);
  EXPECT_EQ(mesh.polygons, example.input.polygons);
  EXPECT_EQ(mesh.normals, example.input.normals);
  EXPECT_EQ(mesh.polygon_normals, example.input.polygon_normals);
  EXPECT_EQ(mesh.directives, example.input.directives);
  EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{0, 1, 2, 3}, {4, 5, 6}}));
  ASSERT_EQ(mesh.texcoords.size(), 7u);
  for (Index p = 0; p < 7; ++p) {
    EXPECT_EQ(mesh.texcoords[static_cast<std::size_t>(p)], example.map.uv.row(p).transpose());
  }
}

// The map has the quad reversed: its corners run backwards, each with its own vt. Comments about
// cones by the writer belong to the map; others are the user's.
TEST(WriteObj, CommentsAboutConesAreReplaced) {
  const TemporaryFolder folder;
  QuadExample example;
  example.map.cone = decltype(example.map.cone)::Zero(7);
  example.map.cone[1] = 3;
  example.input.directives = {{0, "# cones of the rocket"},
                              {0, "# cone vertex 2 quarter_turns 3, as it should be"},
                              {1, "#cone vertex 2 quarter_turns 3"}};
  write_obj(folder.file("out.obj"), example.map, &example.input);
  EXPECT_TRUE(
      content_of(folder.file("out.obj"))
          .starts_with(mark_text(MarkStyle::FirstLine) +
                       "# cones: vertices count from 0; angle = quarter_turns * 90 degrees\n"
                       "# cone vertex 2 quarter_turns 3\n"));
  EXPECT_EQ(read_mesh(folder.file("out.obj")).directives, example.input.directives);
}

TEST(WriteObj, MarksOfVerticesAreNumbers) {
  QuadExample example;
  example.input.directives = {{0, "v 8"}, {0, "g a"}};
  EXPECT_EQ(obj_text(example.input).find("v 8"), std::string::npos);
  for (const char* line : {"v x", "v 8 9", "v "}) {
    example.input.directives = {{0, line}};
    EXPECT_NE(obj_text(example.input).find(std::string("\n") + line + "\nf "), std::string::npos);
  }
}

TEST(WriteObj, TurnedFacesAreWrittenTurned) {
  const TemporaryFolder folder;
  QuadExample example;
  example.map.cells.row(1) << 0, 2, 1;
  example.map.cells.row(2) << 0, 3, 2;
  write_obj(folder.file("out.obj"), example.map, &example.input);
  const PolygonMesh mesh = read_mesh(folder.file("out.obj"));
  EXPECT_EQ(mesh.polygons, (Polygons{{4, 3, 2, 1}, {2, 5, 3}}));
  EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{3, 2, 1, 0}, {4, 5, 6}}));
}

TEST(WriteObj, AFaceThatHasAVertexTwiceHasATextureCoordinateForEachCorner) {
  const TemporaryFolder folder;
  QuadExample example;
  example.input.polygons = {{1, 2, 3, 4}, {2, 5, 2}};
  example.map.input_vertex[6] = 2;
  example.map.points.row(6) = example.map.points.row(4);
  write_obj(folder.file("out.obj"), example.map, &example.input);
  const PolygonMesh mesh = read_mesh(folder.file("out.obj"));
  EXPECT_EQ(mesh.polygons, (Polygons{{1, 2, 3, 4}, {2, 5, 2}}));
  EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{0, 1, 2, 3}, {4, 5, 6}}));
}

// New vertices on edges have a colour if both ends of the edge have one.
TEST(WriteObj, ColoursOfNewVertices) {
  const TemporaryFolder folder;
  QuadExample example;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  example.input.colors = {{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {nan, nan, nan}, {0, 0, 1}};
  write_obj(folder.file("out.obj"), example.map, &example.input, {.refine = 2});
  const PolygonMesh mesh = read_mesh(folder.file("out.obj"));
  ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
  int checked = 0;
  for (std::size_t v = 6; v < mesh.positions.size(); ++v) {
    const Vector3& at = mesh.positions[v];
    if (at == Vector3(0.5, 0, 0)) checked += mesh.colors[v] == Vector3(0.5, 0, 0);
    if (at == Vector3(0.5, 0.5, 0)) checked += mesh.colors[v] == Vector3(0.5, 0.5, 0);
    if (at == Vector3(0.5, 1, 0)) checked += !mesh.colors[v].allFinite();
  }
  EXPECT_EQ(checked, 3);
}

TEST(WriteObj, CutPolygonsBecomeTriangles) {
  const TemporaryFolder folder;
  QuadExample example;
  example.map.points.conservativeResize(8, 3);
  example.map.uv.conservativeResize(8, 2);
  example.map.input_vertex.conservativeResize(8);
  example.map.points.row(7) = example.map.points.row(0);
  example.map.uv.row(7) << -3, -3;
  example.map.input_vertex[7] = 1;
  example.map.cells(2, 0) = 7;
  write_obj(folder.file("out.obj"), example.map, &example.input);
  const PolygonMesh mesh = read_mesh(folder.file("out.obj"));
  EXPECT_EQ(mesh.polygons, (Polygons{{1, 2, 3}, {1, 3, 4}, {2, 5, 3}}));
  EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{0, 1, 2}, {7, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(mesh.directives[2], (std::pair<Index, std::string>{2, "usemtl red"}));
}

TEST(WriteObj, WithoutInputWritesTheCells) {
  const TemporaryFolder folder;
  const QuadExample example;
  write_obj(folder.file("out.obj"), example.map, nullptr);
  const PolygonMesh mesh = read_mesh(folder.file("out.obj"));
  EXPECT_EQ(mesh.polygons, (Polygons{{1, 2, 3}, {1, 3, 4}, {2, 5, 3}}));
  EXPECT_EQ(mesh.positions.size(), 6u);
}

TEST(WriteObj, RefusesAnotherInputAndBadRefinement) {
  const TemporaryFolder folder;
  QuadExample example;
  const std::string path = folder.file("out.obj");
  error_message(ErrorKind::Usage, [&] { write_obj(path, example.map, nullptr, {.refine = 0}); });
  error_message(ErrorKind::Usage,
                [&] { write_obj(path, example.map, nullptr, {.refine = 2000000000}); });
  example.input.polygons.resize(1);
  error_message(ErrorKind::Invalid, [&] { write_obj(path, example.map, &example.input); });
  example.input.polygons = {{0, 1, 2, 3}, {2, 5, 3}};
  error_message(ErrorKind::Invalid, [&] { write_obj(path, example.map, &example.input); });
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WriteObj, RefinedEdgesAreSharedAndCutsStayCuts) {
  const TemporaryFolder folder;
  const QuadExample example;
  constexpr int K = 3;
  write_obj(folder.file("out.obj"), example.map, &example.input, {.refine = K});
  const PolygonMesh mesh = read_mesh(folder.file("out.obj"));
  ASSERT_EQ(mesh.polygons.size(), 3u * K * K);
  // 6 input vertices, 7 edges with K - 1 samples, 3 cells with (K - 1)(K - 2) / 2. The cut adds one
  // edge and two corners in the plane, but no unreferenced vertex.
  EXPECT_EQ(mesh.positions.size(), 6u + 7 * (K - 1) + 3 * (K - 1) * (K - 2) / 2);
  EXPECT_EQ(mesh.texcoords.size(), 7u + 8 * (K - 1) + 3 * (K - 1) * (K - 2) / 2);
  for (std::size_t v = 0; v < 6; ++v) EXPECT_EQ(mesh.positions[v], example.input.positions[v]);
  EXPECT_EQ(mesh.directives[2], (std::pair<Index, std::string>{2 * K * K, "usemtl red"}));
  double area = 0.0;
  std::map<std::pair<Index, Index>, int> edges;
  for (const auto& t : mesh.polygons) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
    const auto p = [&](std::size_t k) { return mesh.positions[static_cast<std::size_t>(t[k])]; };
    const double twice = (p(1) - p(0)).cross(p(2) - p(0))[2];
    EXPECT_GT(twice, 0.0);
    area += 0.5 * twice;
  }
  EXPECT_NEAR(area, 1.5, 1e-14);
  int boundary = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    boundary += edges.count({edge.second, edge.first}) == 0;
  }
  EXPECT_EQ(boundary, 5 * K);
}

TEST(WriteObj, DoublesSurvive) {
  const TemporaryFolder folder;
  MapFile map = random_strip(1, 200, 4);
  write_obj(folder.file("out.obj"), map, nullptr);
  const PolygonMesh mesh = read_mesh(folder.file("out.obj"));
  for (Index p = 0; p < map.uv.rows(); ++p) {
    EXPECT_EQ(mesh.texcoords[static_cast<std::size_t>(p)], map.uv.row(p).transpose());
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
