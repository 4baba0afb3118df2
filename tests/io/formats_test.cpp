// The table of formats: properties of its rows, and a format that only this file adds.
#include "majorant/io/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "io_test_helpers.h"
#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/files/input_file.h"

namespace majorant {
namespace {

// Reads lines "x y z u v", one per corner and three per triangle, without shared vertices.
PolygonMesh read_tri(const std::string& path, const StopCheck& stop, Strictness /*everything*/) {
  std::istringstream numbers(read_whole_file(path, stop));
  PolygonMesh mesh;
  mesh.file = path;
  for (double x, y, z, u, v; numbers >> x >> y >> z >> u >> v;) {
    mesh.positions.emplace_back(x, y, z);
    mesh.texcoords.emplace_back(u, v);
  }
  if (mesh.positions.empty() || mesh.positions.size() % 3 != 0)
    throw Error(ErrorKind::Unreadable, path + ": no whole triangles");
  for (Index k = 0; k < static_cast<Index>(mesh.positions.size()); k += 3)
    mesh.polygons.push_back({k, k + 1, k + 2});
  mesh.polygon_texcoords = mesh.polygons;
  return mesh;
}

void write_tri(const std::string& path, const MapFile& map, const PolygonMesh* /*input*/,
               const MapFileOptions& /*options*/, const FileVerification& verify) {
  if (map.degree != 1)
    throw Error(ErrorKind::Unsupported, "cannot write " + path + ": straight triangles alone");
  std::string text;
  for (const Index p : map.cells.reshaped<Eigen::RowMajor>())
    text += fmt::format("{} {} {} {} {}\n", map.points(p, 0), map.points(p, 1), map.points(p, 2),
                        map.uv(p, 0), map.uv(p, 1));
  write_file_atomically(path, text, verify);
}

void add_tri() {
  if (find_format(".tri") != nullptr) return;
  add_format({.extension = ".tri",
              .name = "corners of triangles",
              .read_surface = &read_tri,
              .write_map = &write_tri,
              .has_texcoords = true});
}

MapFile one_triangle() {
  MapFile map;
  map.degree = 1;
  map.points.resize(3, 3);
  map.points << 0, 0, 1, 2, 0, 1, 0, 2, 1.5;
  map.uv.resize(3, 2);
  map.uv << 0, 0, 1, 0.1, 0, 1;
  map.cells.resize(1, 3);
  map.cells << 0, 1, 2;
  return map;
}

TEST(Formats, AUserFormatIsReadAndWrittenLikeAnyOther) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.tri");
  const MapFile map = one_triangle();
  EXPECT_FALSE(is_mesh_name("A.TRI.gz"));
  expect_contains(error_message(ErrorKind::Usage, [&] { write_map_file(path, map, nullptr); }),
                  {"a.tri", ".vtu, .obj, .ply, .glb, .gltf or .msh"});
  add_tri();
  EXPECT_TRUE(is_mesh_name("A.TRI.gz"));
  write_map_file(path, map, nullptr, {}, certification(path, {}));
  const MapFile read = read_map(path);
  EXPECT_EQ(read.points, map.points);
  EXPECT_EQ(read.uv, map.uv);
  EXPECT_EQ(read_mesh(path).polygons.size(), 1u);
  write_map_file(folder.file("a.obj"), read, nullptr, {}, certification("a.obj", {}));
  // An invalid map is not written, and the message names the format.
  MapFile folded = map;
  folded.uv.row(1).swap(folded.uv.row(2));
  expect_contains(error_message(ErrorKind::Invalid,
                                [&] {
                                  const std::string other = folder.file("b.tri");
                                  write_map_file(other, folded, nullptr, {},
                                                 certification(other, {}));
                                }),
                  {"b.tri is not written"});
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.tri")));
  expect_contains(
      error_message(ErrorKind::Unreadable, [&] { read_mesh(folder.write("a.bin", "nothing")); }),
      {"unknown mesh format", ".msh or .tri"});
}

TEST(Formats, RowsAreAddedOnce) {
  add_tri();
  EXPECT_THROW(add_format({.extension = ".tri", .name = "again"}), InvalidArgument);
  EXPECT_THROW(add_format({.extension = ".obj", .name = "again"}), InvalidArgument);
  for (const char* const bad : {"", ".", "tri", ".Tri", ".a b"})
    EXPECT_THROW(add_format({.extension = bad, .name = "x"}), InvalidArgument) << bad;
}

// Every use names the formats of the documentation, for any order of rows.
TEST(Formats, UsesNameTheirFormats) {
  const auto expect = [](FormatUse use, std::vector<std::string> expected) {
    std::vector<std::string> found = extensions_for(use);
    std::erase(found, ".tri");
    EXPECT_EQ(found, expected);
    for (const std::string& extension : expected) {
      EXPECT_TRUE(is_for(use, "a" + extension + ".gz"));
      EXPECT_TRUE(serves(*find_format(extension), use));
    }
  };
  expect(FormatUse::ReadSurface, {".obj", ".off", ".ply", ".stl", ".glb", ".gltf", ".vtu", ".msh"});
  expect(FormatUse::ReadMap, {".vtu", ".pvtu", ".msh"});
  expect(FormatUse::ReadTexcoords, {".obj", ".ply", ".glb", ".gltf"});
  expect(FormatUse::ReadCells, {".msh", ".mesh", ".vtu"});
  expect(FormatUse::WriteMap, {".vtu", ".obj", ".ply", ".glb", ".gltf", ".msh"});
  expect(FormatUse::WriteQuads, {".obj", ".ply", ".vtu"});
  expect(FormatUse::WriteCells, {".msh", ".vtu"});
  expect(FormatUse::WriteVersions, {".msh"});
  expect(FormatUse::Show, {".svg", ".png", ".html"});
  EXPECT_EQ(in_words({".a", ".b", ".c"}, "or"), ".a, .b or .c");
  EXPECT_EQ(in_words({".a"}, "or"), ".a");
  EXPECT_EQ(in_words({}, "or"), "");
}

TEST(Formats, TheDocsHaveTheTable) {
  std::string table = formats_in_markdown();
  if (const std::size_t own = table.find("| `.tri`"); own != std::string::npos)
    table.erase(own, table.find('\n', own) + 1 - own);
  const std::string page = content_of(std::string(MAJORANT_SOURCE_DIR) + "/docs/files.md");
  EXPECT_NE(page.find("\n" + table + "\n"), std::string::npos)
      << "docs/files.md, \"Formats\", should have this table:\n"
      << table;
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
