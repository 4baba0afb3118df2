#include <algorithm>

#include "io_test_helpers.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/volume_files.h"

namespace majorant {
namespace {

// Returns the flat triangle of every degree, slightly bent in the plane: it is valid.
MapFile bent(int degree) {
  MapFile map = random_strip(degree, 1, 4);
  const auto indices = bezier_multi_indices(degree);
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const double x = double(indices[k][1]) / degree, y = double(indices[k][2]) / degree;
    map.points.row(static_cast<Index>(k)) << x, y, 1 + x;
    map.uv.row(static_cast<Index>(k)) << x + 0.1 * y * y, y + 0.1 * x * y / 3;
  }
  return map;
}

TEST(Msh, ImageReadsBack) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 10; ++degree) {
    const MapFile map = random_strip(degree, 4, static_cast<unsigned>(degree));
    write_msh(folder.file("a.msh"), map, MshContent::Image);
    const MapFile read = read_map(folder.file("a.msh"));
    EXPECT_EQ(read.degree, degree);
    EXPECT_EQ(read.cells, map.cells);
    EXPECT_LE((read.uv - map.uv).cwiseAbs().maxCoeff(), 1e-11) << degree;
    for (const Index corner : map.cells.leftCols<3>().reshaped()) {
      EXPECT_EQ(read.uv.row(corner), map.uv.row(corner));
      EXPECT_EQ(read.points.row(corner).head<2>(), map.uv.row(corner));
    }
  }
}

TEST(Msh, SurfaceHasTheMapAsViews) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 10; ++degree) {
    const MapFile map = random_strip(degree, 4, static_cast<unsigned>(degree));
    write_msh(folder.file("a.msh"), map, MshContent::Surface);
    const MapFile read = read_msh(folder.file("a.msh"));
    EXPECT_EQ(read.points, map.points);
    EXPECT_EQ(read.cells, map.cells);
    EXPECT_LE((read.uv - map.uv).cwiseAbs().maxCoeff(), 1e-11) << degree;
    const PolygonMesh mesh = read_mesh(folder.file("a.msh"));
    EXPECT_EQ(mesh.polygons.size(), 4u);
    EXPECT_EQ(mesh.texcoords.size(), mesh.positions.size());
  }
}

TEST(Msh, WrittenFilesAreProven) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 8; ++degree) {
    const MapFile map = bent(degree);
    for (const MshContent content : {MshContent::Image, MshContent::Surface}) {
      const std::string path = folder.file("a.msh");
      write_msh(path, map, content,
                certification(path, {}, content == MshContent::Image ? &map : nullptr));
      EXPECT_EQ(MapProof(read_msh(path), path, {}).verdict(), ProofStatus::Proven) << degree;
    }
  }
  // A map other than the written one: its cells are not those of the file.
  const MapFile map = random_strip(2, 2, 1), other = bent(2);
  const std::string path = folder.file("b.msh");
  expect_contains(
      error_message(
          ErrorKind::Invalid,
          [&] { write_msh(path, other, MshContent::Image, certification(path, {}, &map)); }),
      {"b.msh is not written", "cells"});
  EXPECT_FALSE(std::filesystem::exists(path));
}

// Returns two triangles at both sides of a slit: at its ends they share vertices, at its midpoint
// are two vertices.
PolygonMesh slit() {
  PolygonMesh mesh;
  mesh.file = "slit";
  mesh.positions = {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {1, 1, 1}, {1, -1, 1}, {1, 0, 1}};
  mesh.polygons = {{0, 1, 3}, {1, 2, 3}, {0, 4, 5}, {5, 4, 2}};
  return mesh;
}

TEST(Msh, VerticesAtOnePlaceStayApart) {
  const TemporaryFolder folder;
  const PolygonMesh surface = slit();
  PolygonMesh mapped = surface;
  for (const Vector3& p : surface.positions) mapped.texcoords.emplace_back(p.head<2>());
  mapped.texcoords[1].y() = 0.125;  // the slit is open in the plane
  mapped.polygon_texcoords = mapped.polygons;
  const MapFile map = to_map_file(mapped);
  const ProofRequest required{.surface = &surface, .labels = ProofRequest::FaceLabels::Compared};
  const std::string path = folder.file("a.msh");
  write_msh(path, map, MshContent::Surface, certification(path, required));
  const MapFile read = read_msh(path);
  EXPECT_EQ(read.input_vertex, map.input_vertex);
  EXPECT_EQ(read.input_face, map.input_face);
  EXPECT_EQ(MapProof(read, path, required).first_defect(), "");
  EXPECT_EQ(MapProof(read, path, {}).first_defect(), "");
  // The proof before the rename is for the file: nothing is taken from the map.
  MapFile unnamed = map;
  unnamed.input_vertex.resize(0);
  unnamed.input_face.resize(0);
  const std::string other = folder.file("b.msh");
  expect_contains(
      error_message(
          ErrorKind::Invalid,
          [&] { write_msh(other, unnamed, MshContent::Surface, certification(other, required)); }),
      {"b.msh is not written", "sides of 2 inner edges differ"});
}

TEST(Msh, DamagedNumbersOfTheInputAreRefused) {
  const TemporaryFolder folder;
  MapFile map = random_strip(1, 2, 3);
  map.input_face = Eigen::VectorXi::LinSpaced(2, 0, 1);
  write_msh(folder.file("a.msh"), map, MshContent::Surface);
  const std::string text = content_of(folder.file("a.msh"));
  const std::string faces = "$input_face\n2\n1 0\n2 1\n$Endinput_face\n";
  ASSERT_NE(text.find(faces), std::string::npos);
  for (const auto& [bad, says] : std::vector<std::pair<std::string, std::string>>{
           {"$input_face\n1\n1 0\n$Endinput_face\n", "input_face has no line for tag 2"},
           {"$input_face\n2\n1 0\n1 1\n$Endinput_face\n", "tag 1"},
           {"$input_face\n2\n1 0\n2 -2\n$Endinput_face\n", "input_face -2 is out of range"},
           {"$input_face\n2\n1 0\n2 1 1\n$Endinput_face\n", "a.msh:"},
           {"$input_face\n3\n1 0\n2 1\n$Endinput_face\n", "a.msh:"},
           {faces + faces, "there twice"}}) {
    std::string damaged = text;
    damaged.replace(text.find(faces), faces.size(), bad);
    const std::string path = folder.write("a.msh", damaged);
    expect_contains(error_message(ErrorKind::Unreadable, [&] { read_msh(path); }), {says});
  }
}

TEST(Msh, ChartsAreEntities) {
  const TemporaryFolder folder;
  MapFile map = random_strip(2, 6, 1);
  map.chart.resize(6);
  map.chart << 4, 0, 4, 0, 0, 2;  // points are shared across charts
  write_msh(folder.file("a.msh"), map, MshContent::Image);
  const std::string text = content_of(folder.file("a.msh"));
  expect_contains(text,
                  {"$Entities\n0 0 3 0\n1 ", "$Elements\n3 6 1 6\n2 1 9 3\n2 ", "\n2 5 9 2\n1 "});
  const MapFile read = read_msh(folder.file("a.msh"));
  EXPECT_EQ(read.cells, map.cells);
}

// Returns a file as gmsh writes it: points and lines, non-contiguous tags, nodes of no triangle,
// coordinates on curves.
std::string of_gmsh() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 2 \"# x\"\n$EndPhysicalNames\n"
         "$Nodes\n2 5 2 90\n0 1 0 1\n90\n5 5 0\n2 1 1 4\n7\n2\n5\n4\n1 0 0 0.5 0\n0 0 0 0 0\n0 1 0 "
         "1 1\n"
         "1 1 0 1 1\n$EndNodes\n$Elements\n3 4 1 9\n0 1 15 1\n1 90\n1 1 1 1\n2 2 7\n"
         "2 1 2 2\n9 7 4 5\n3 2 7 5\n$EndElements\n";
}

TEST(Msh, FilesOfGmsh) {
  const TemporaryFolder folder;
  const MapFile map = read_msh(folder.write("a.msh", of_gmsh()));
  ASSERT_EQ(map.cells.rows(), 2);  // by tag: 3, 9; nodes by tag: 2 4 5 7 90
  EXPECT_EQ(map.cells.row(0), Eigen::RowVector3i(0, 3, 2));
  EXPECT_EQ(map.cells.row(1), Eigen::RowVector3i(3, 1, 2));
  EXPECT_EQ(map.uv.row(3), Eigen::RowVector2d(1, 0));
  EXPECT_EQ(MapProof(map, "a.msh", {}).verdict(), ProofStatus::Proven);
  const PolygonMesh mesh = read_mesh(folder.file("a.msh"));
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_TRUE(mesh.texcoords.empty());
}

// One file in every version and encoding: one reader gives surfaces, maps and cells.
TEST(Msh, EveryVersionAndEncoding) {
  const TemporaryFolder folder;
  const std::string first = folder.write("a.msh", of_gmsh());
  const MapFile expected = read_msh(first);
  const VolumeMesh cells = read_volume_mesh(first);
  for (const GmshVersion version : {GmshVersion::Old, GmshVersion::New})
    for (const GmshEncoding encoding : {GmshEncoding::Text, GmshEncoding::Binary}) {
      const std::string path = folder.file("b.msh");
      write_volume_mesh(path, cells, {version, encoding});
      const MapFile map = read_msh(path);
      EXPECT_EQ(map.cells, expected.cells);
      EXPECT_EQ(map.uv, expected.uv);
      EXPECT_EQ(map.points, expected.points);
      EXPECT_EQ(read_mesh(path).polygons, read_mesh(first).polygons);
    }
}

TEST(Msh, Refusals) {
  const auto refuses = [](const std::string& from, const std::string& to,
                          const std::vector<std::string>& says) {
    const TemporaryFolder folder;
    std::string text = of_gmsh();
    ASSERT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    const std::string path = folder.write("a.msh", text);
    const std::string message = error_message(ErrorKind::Unreadable, [&] { read_msh(path); });
    expect_contains(message, says);
    expect_contains(message, {"a.msh"});
  };
  refuses("4.1 0", "2.2 0", {"a.msh:", "$EndNodes"});  // lists of 4.1
  refuses("4.1 0", "4.1 1", {"byte order"});
  refuses("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", "", {"$MeshFormat"});
  refuses("2 1 2 2\n9", "2 1 3 2\n9", {"type 3"});
  refuses("2 1 2 2\n9", "3 1 4 2\n9", {"volume"});
  refuses("2 1 2 2\n9", "2 1 2 3\n9", {"$EndElements"});
  refuses("2 1 2 2\n9", "2 1 2 1\n9", {"$EndElements", "counts"});
  refuses("9 7 4 5\n", "9 7 4 6\n", {"element 9", "node 6"});
  refuses("9 7 4 5\n", "3 7 4 5\n", {"two elements", "tag 3"});
  refuses("\n2\n5\n4\n", "\n2\n5\n5\n", {"two nodes", "tag 5"});
  refuses("1 1 0 1 1\n", "1 1 0.5 1 1\n", {"no map"});
  refuses("1 1 0 1 1\n", "1 nan 0 1 1\n", {"y coordinate", "not finite"});
  refuses("$EndElements\n", "", {"truncated"});
  const std::string view =
      "$EndElements\n$NodeData\n1\n\"u\"\n1\n0\n3\n0\n1\n1\n2 0.5\n$EndNodeData\n";
  std::string both = view + view.substr(view.find("$NodeData"));
  refuses("$EndElements\n", both, {"\"u\"", "once"});
  refuses("$EndElements\n", view, {"view u has no value for node 4"});
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
