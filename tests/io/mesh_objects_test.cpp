#include "majorant/io/mesh_objects.h"

#include <gtest/gtest.h>

#include "io_test_helpers.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"

namespace majorant {
namespace {

constexpr const char* kRoom =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    "o chair\nv 5 0 0\nv 6 0 0\nv 5 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl red\nf 4/1 5/2 6/3\n"
    "o table\nl 1 2\nf 3 2 1\n"
    "o chair\nv 6 1 0\nvt 1 1\ng back\nf 6/3 5/2 7/4\n";

TEST(MeshObjects, LinesOfAnObj) {
  const TemporaryFolder folder;
  const PolygonMesh mesh = read_mesh(folder.write("room.obj", kRoom));
  const MeshObjects objects = objects_of(mesh);
  EXPECT_EQ(objects.names, (std::vector<std::string>{"", "chair", "table"}));
  EXPECT_EQ(objects.of_polygon, (std::vector<Index>{0, 1, 2, 1}));
  const ObjectMesh chair = object_mesh(mesh, objects, 1);
  EXPECT_EQ(chair.vertices, (std::vector<Index>{3, 4, 5, 6}));
  EXPECT_EQ(chair.polygons, (std::vector<Index>{1, 3}));
  EXPECT_EQ(chair.mesh.polygons, (IndexLists{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(chair.mesh.polygon_texcoords, (IndexLists{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(chair.mesh.positions.back(), Vector3(6, 1, 0));
  EXPECT_EQ(chair.mesh.texcoords.back(), Vector2(1, 1));
  const std::vector<std::pair<Index, std::string>> lines{
      {0, "o chair"}, {0, "usemtl red"}, {1, "o table"}, {1, "o chair"}, {1, "g back"}};
  EXPECT_EQ(chair.mesh.directives, lines);
  const ObjectMesh table = object_mesh(mesh, objects, 2);
  EXPECT_EQ(table.vertices, (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(table.mesh.polygons, (IndexLists{{2, 1, 0}}));
  EXPECT_TRUE(table.mesh.texcoords.empty() && table.mesh.polygon_texcoords.empty());
}

TEST(MeshObjects, ChartsOfJoinedMapsAreNumberedOn) {
  const auto map = [](int face, std::vector<int> charts) {
    MapFile file;
    file.degree = 1;
    file.points = Points3::Zero(3, 3);
    file.uv = Points2::Zero(3, 2);
    const auto cells = static_cast<Index>(std::max<std::size_t>(charts.size(), 1));
    file.cells.resize(cells, 3);
    file.input_face.resize(cells);
    for (Index c = 0; c < cells; ++c) {
      file.cells.row(c) << 0, 1, 2;
      file.input_face[c] = face + static_cast<int>(c);
    }
    file.chart.resize(static_cast<Index>(charts.size()));
    for (std::size_t c = 0; c < charts.size(); ++c) file.chart[static_cast<Index>(c)] = charts[c];
    return file;
  };
  const MapFile all = joined({map(3, {}), map(4, {1, 0, 1}), map(0, {0, 1}), map(2, {})});
  const std::vector<int> numbers(all.chart.begin(), all.chart.end());
  EXPECT_EQ(numbers, (std::vector<int>{3, 4, 5, 0, 2, 1, 2}));  // of faces 0 to 6
}

TEST(MeshObjects, CellsOfAPolygonAreOfItsObject) {
  PolygonMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}};
  mesh.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}};
  mesh.polygons = mesh.polygon_texcoords = {{0, 1, 2, 3}, {1, 4, 2}};
  mesh.directives = {{1, "o wing"}};
  EXPECT_EQ(object_of_cells(objects_of(mesh), to_map_file(mesh)), (std::vector<Index>{0, 0, 1}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
