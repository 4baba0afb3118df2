#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "cube_map.h"
#include "io_test_helpers.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"

namespace majorant {
namespace {

// Returns the corners of the faces with their texture coordinates, independent of indices.
std::vector<std::array<double, 5>> corners_of(const PolygonMesh& mesh) {
  std::vector<std::array<double, 5>> corners;
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p)
    for (std::size_t k = 0; k < mesh.polygons[p].size(); ++k) {
      const Vector3& x = mesh.positions[mesh.polygons[p][k]];
      const Vector2& t = mesh.texcoords[mesh.polygon_texcoords[p][k]];
      corners.push_back({x[0], x[1], x[2], t[0], t[1]});
    }
  return corners;
}

// A closed surface with cuts: the PLY has the mesh and the proof of the OBJ.
TEST(WritePly, IsTheMeshOfTheObj) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 3; ++degree) {
    const MapFile map = to_map_file(cube_map(degree));
    const PolygonMesh input = cube();
    ProofRequest required;
    required.surface = &input;
    required.cuts = CutRule::Seams;
    const TessellationOptions options{.refine = degree};
    const std::string ply = folder.file("a.ply"), obj = folder.file("a.obj");
    write_ply(ply, map, &input, options, certification(ply, required));
    write_obj(obj, map, &input, options, certification(obj, required));
    const PolygonMesh a = read_mesh(ply), b = read_mesh(obj);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.polygons, b.polygons);
    EXPECT_EQ(corners_of(a), corners_of(b));
    EXPECT_GT(a.texcoords.size(), a.positions.size());
    EXPECT_NE(content_of(ply).find("comment cone vertex "), std::string::npos);
  }
}

TEST(WritePly, VerticesOfNoFaceAndColours) {
  const TemporaryFolder folder;
  PolygonMesh input;
  input.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  input.polygons = {{1, 2, 3}};
  input.colors = {{1, 0, 0}, {0, 0.2, 0}, {0, 0, 1}, {0.4, 0.6, 0.8}};
  MapFile map = random_strip(1, 1, 1);
  map.input_vertex << 1, 2, 3;
  for (Index p = 0; p < 3; ++p) map.points.row(p) = input.positions[p + 1];
  write_ply(folder.file("a.ply"), map, &input);
  const PolygonMesh read = read_mesh(folder.file("a.ply"));
  EXPECT_EQ(read.positions, input.positions);
  EXPECT_EQ(read.polygons, input.polygons);
  ASSERT_EQ(read.colors.size(), 4u);
  for (std::size_t v = 0; v < 4; ++v) EXPECT_LE((read.colors[v] - input.colors[v]).norm(), 1e-15);
  input.colors[2].setConstant(std::numeric_limits<double>::quiet_NaN());
  write_ply(folder.file("a.ply"), map, &input);
  EXPECT_TRUE(read_mesh(folder.file("a.ply")).colors.empty());
}

TEST(WritePly, LargePolygons) {
  const TemporaryFolder folder;
  PolygonMesh input;
  MapFile map;
  constexpr Index kCorners = 300;
  for (Index k = 0; k < kCorners; ++k)
    input.positions.emplace_back(std::cos(2 * std::numbers::pi * k / kCorners),
                                 std::sin(2 * std::numbers::pi * k / kCorners), 0);
  std::vector<Index> corners(kCorners);
  std::iota(corners.begin(), corners.end(), 0);
  input.polygons.push_back(corners);
  map.points.resize(kCorners, 3);
  map.input_vertex = Eigen::VectorXi::LinSpaced(kCorners, 0, kCorners - 1);
  map.input_face = Eigen::VectorXi::Zero(kCorners - 2);
  map.cells.resize(kCorners - 2, 3);
  for (Index k = 0; k < kCorners; ++k) map.points.row(k) = input.positions[k];
  for (Index k = 0; k + 2 < kCorners; ++k) map.cells.row(k) << 0, k + 1, k + 2;
  map.uv = map.points.leftCols<2>();
  write_ply(folder.file("a.ply"), map, &input);
  EXPECT_EQ(read_mesh(folder.file("a.ply")).polygons, input.polygons);
}

std::string wedges(const std::string& faces, const std::string& vertex = "") {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\n" +
         vertex +
         "element face 2\nproperty list uchar int vertex_indices\n"
         "property list uchar float texcoord\nproperty int texnumber\nend_header\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n" +
         faces;
}

// MeshLab writes six numbers for each triangle.
TEST(WritePly, WedgesAreRead) {
  const TemporaryFolder folder;
  const std::string path =
      folder.write("a.ply", wedges("3 0 1 2 6 0 0 1 0 1 1 0\n3 0 2 3 6 0 0 1 1.5 0 1 0\n"));
  const PolygonMesh mesh = read_mesh(path);
  ASSERT_EQ(mesh.texcoords.size(), 5u);  // vertex 0 has one, vertex 2 two
  EXPECT_EQ(mesh.polygon_texcoords[0][0], mesh.polygon_texcoords[1][0]);
  EXPECT_NE(mesh.polygon_texcoords[0][2], mesh.polygon_texcoords[1][1]);
  EXPECT_EQ(mesh.texcoords[mesh.polygon_texcoords[1][1]], Vector2(1, 1.5));
  const MapFile map = read_map(path);
  EXPECT_EQ(map.points.rows(), 5);
  ProofRequest required;
  required.cuts = CutRule::Free;
  EXPECT_EQ(MapProof(map, path, required).verdict(), ProofStatus::Proven);
}

TEST(WritePly, InvalidWedgesAreRefused) {
  const TemporaryFolder folder;
  const std::string none = folder.write("a.ply", wedges("3 0 1 2 0 0\n3 0 2 3 0 0\n"));
  EXPECT_TRUE(read_mesh(none).texcoords.empty());
  const std::string some = folder.write("a.ply", wedges("3 0 1 2 6 0 0 1 0 1 1 0\n3 0 2 3 0 0\n"));
  expect_contains(error_message(ErrorKind::Unreadable, [&] { read_map(some); }), {"face 2"});
  const std::string odd = folder.write("a.ply", wedges("3 0 1 2 5 0 0 1 0 1 0\n3 0 2 3 0 0\n"));
  expect_contains(error_message(ErrorKind::Unreadable, [&] { read_map(odd); }),
                  {"a.ply:", "3 corners and 5"});
  const std::string nan = folder.write("a.ply", wedges("3 0 1 2 6 0 0 nan 0 1 1 0\n3 0 2 3 0 0\n"));
  expect_contains(error_message(ErrorKind::Unreadable, [&] { read_map(nan); }),
                  {"a.ply:", "no finite number"});
  for (const std::string& path : {odd, nan}) EXPECT_TRUE(read_mesh(path).texcoords.empty());
}

std::string copies(const std::string& vertices) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
         "property double z\nproperty double s\nproperty double t\nproperty int input_vertex\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         vertices + "3 0 1 2\n";
}

TEST(WritePly, InvalidCopiesAreRefused) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& vertices) {
    return error_message(ErrorKind::Unreadable,
                         [&] { read_mesh(folder.write("a.ply", copies(vertices))); });
  };
  expect_contains(refusal("0 0 0 0 0 0\n1 0 0 1 0 1\n0 1 0 0 1 2\n5 5 0 3 3 0\n"),
                  {"input_vertex 0 is at two places"});
  expect_contains(refusal("0 0 0 0 0 0\n1 0 0 1 0 1\n0 1 0 0 1 2\n0 0 0 3 3 4\n"),
                  {"4 is out of range"});
  expect_contains(refusal("0 0 0 0 0 0\n1 0 0 1 0 1\n0 1 0 0 1 3\n0 0 0 3 3 0\n"),
                  {"2 is missing"});
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
