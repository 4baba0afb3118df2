// Irregularities of real files that readers accept: OFF as a stream, strips of PLY, unknown
// keywords of OBJ; and the parts of an OBJ that are kept.
#include "io_test_helpers.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/material_files.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/written_mark.h"

namespace majorant {
namespace {

using Polygons = IndexLists;

PolygonMesh read(const std::string& name, std::string_view content) {
  const TemporaryFolder folder;
  return read_mesh(folder.write(name, content));
}

TEST(LenientReaders, OffMayHaveAnyLineBreaks) {
  for (const std::string content :
       {"OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3\n0 1\n2\n3 0\n2 3\n",  // faces across lines
        "OFF 4 2 5 0 0 0 1 0 0 1 1 0 0 1 0 3 0 1 2 3 0 2 3",              // one line
        "OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0 1 2 3 0 2 3\n",        // several per line
        "OFF\n4 2 0\n0 0 0 1 0 0\n1 1 0 0 1 0\n3 0\n1 2\n3 0\n2 3\n",     // V + F lines
        "OFF # a\n# b\n4 # c\n2\n0 # d\n0 0 # e\n0\n1 0 0\n1 1 0 # f\n\n0 1 0\n3 0 1 2\n3 0 2 3\n",
        "OFF\n4 2 0\n0 0 0 9 9 9\n1 0 0 9 9 9\n1 1 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2\n3 0 2 3\n",
        "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 3 0.5 0 0 1\n",
        "COFF\n4 2 0\n0 0 0 1 1 1 1 1 0 0 1 1 1 1\n1 1 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0\n1\n2 7\n3 0 "
        "2 "
        "3\n",
        "STCNOFF\n4 2 0\n0 0 0 1 1 1 1 1 1 1 1 1\n1 0 0 1 1 1 1 1 1 1\n1 1\n1 1 0 1 1 1 1 1 1 1 1 "
        "1\n"
        "0 1 0 1 1 1 1 1 1 1 1 1\n3 0 1 2\n3 0 2 3\n"}) {
    const PolygonMesh mesh = read("a.off", content);
    ASSERT_EQ(mesh.positions.size(), 4u) << content;
    EXPECT_EQ(mesh.positions[2], Vector3(1, 1, 0)) << content;
    EXPECT_EQ(mesh.positions[3], Vector3(0, 1, 0)) << content;
    EXPECT_EQ(mesh.polygons, (Polygons{{0, 1, 2}, {0, 2, 3}})) << content;
  }
}

// Headers with a larger number of faces than the file: its complete faces are read.
TEST(LenientReaders, FewerFacesThanAnnounced) {
  const std::string off = "OFF\n4 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
      "float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
      "0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  const TemporaryFolder folder;
  for (const auto& [name, content] : {std::pair("a.off", off), std::pair("a.ply", ply)}) {
    const PolygonMesh mesh = read(name, content);
    EXPECT_EQ(mesh.polygons, (Polygons{{0, 1, 2}, {0, 2, 3}})) << name;
    EXPECT_EQ(mesh.faces_missing, 2) << name;
    ASSERT_EQ(mesh.warnings.size(), 1u) << name;
    EXPECT_NE(mesh.warnings[0].find("2 of the 4 faces"), std::string::npos) << mesh.warnings[0];
    const std::string path = folder.write(name, content);
    error_message(ErrorKind::Unreadable,
                  [&] { read_mesh(path, StopCheck(), Strictness::Everything); });
    for (const std::size_t cut : {1, 2, 3, 9}) {  // within a line of a face, or without any face
      const std::string truncated =
          folder.write(name, content.substr(0, content.size() - (cut == 9 ? 18 : cut)));
      error_message(ErrorKind::Unreadable, [&] { read_mesh(truncated); });
    }
  }
}

TEST(LenientReaders, OffErrorsNameTheLineOfAFace) {
  const PolygonMesh mesh = read("a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0\n1 2 3\n0 1 2\n");
  EXPECT_EQ(mesh.polygon_lines, (std::vector<long>{6, 7}));
}

TEST(LenientReaders, UnknownWordsOfObjAreOneWarning) {
  const PolygonMesh mesh = read("a.obj",
                                "newthing 1 2\nv 0 0 0\nv 1 0 0\ncurv 0 1 1\nv 0 1 0\nf 1 2 3\n"
                                "newthing\nbevel on\n");
  EXPECT_EQ(mesh.polygons.size(), 1u);
  ASSERT_EQ(mesh.warnings.size(), 1u);
  for (const char* part : {"a.obj:1: 3 lines", "'newthing'", "'curv'"})
    EXPECT_NE(mesh.warnings[0].find(part), std::string::npos) << mesh.warnings[0];
  EXPECT_EQ(mesh.warnings[0].find("bevel"), std::string::npos);
  EXPECT_TRUE(read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").warnings.empty());
}

TEST(LenientReaders, ObjKeepsPointsLinesAndColours) {
  const std::string text =
      "v 0 0 0 0.25 0.5 1\nv 1 0 0\nv 0 1 0 1 1 1\nv 9 9 9 1\n"
      "g a\nf 1 2 3\np 4\nl 1 2 4\nlod 3\n";
  const PolygonMesh mesh = read("a.obj", text);
  EXPECT_EQ(mesh.colors[0], Vector3(0.25, 0.5, 1));
  EXPECT_FALSE(mesh.colors[1].allFinite());
  EXPECT_EQ(obj_text(mesh), mark_text(MarkStyle::FirstLine) +
                                "v 0 0 0 0.25 0.5 1\nv 1 0 0\nv 0 1 0 1 1 1\nv 9 9 9\n"
                                "g a\nf 1 2 3\np 4\nl 1 2 4\nlod 3\n");
  const PolygonMesh other =
      read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nl -1/1 -2/1\nf 1 2 3\n");
  EXPECT_EQ(other.directives[0].second, "l 3 2");
  EXPECT_TRUE(other.colors.empty());
}

std::string ply(const std::string& strips) {
  return "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
         "property float z\nproperty uchar red\nproperty ushort green\nproperty float blue\n"
         "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
         "0 0 0 255 0 .5\n1 0 0 51 65535 0\n0 1 0 0 0 0\n1 1 0 0 0 0\n0 2 0 0 0 0\n" +
         strips + "\n";
}

TEST(LenientReaders, PlyStripsTurnAndBeginAnew) {
  const PolygonMesh mesh = read("a.ply", ply("11 0 1 2 3 4 -1 0 1 -1 4 3"));
  EXPECT_EQ(mesh.polygons, (Polygons{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}}));
  // A repeated vertex reverses the strip without a face.
  EXPECT_EQ(read("a.ply", ply("6 0 1 2 2 3 4")).polygons, (Polygons{{0, 1, 2}, {3, 2, 4}}));
  const TemporaryFolder folder;
  for (const char* strips : {"3 0 1 5", "3 0 1 -2", "3 0 1 1.5", "3 0 1", "2 0 1"})
    error_message(ErrorKind::Unreadable, [&] { read_mesh(folder.write("bad.ply", ply(strips))); });
}

TEST(LenientReaders, PlyColoursAreParts) {
  const PolygonMesh mesh = read("a.ply", ply("3 0 1 2"));
  ASSERT_EQ(mesh.colors.size(), 5u);
  EXPECT_EQ(mesh.colors[0], Vector3(1, 0, 0.5));
  EXPECT_EQ(mesh.colors[1], Vector3(0.2, 1, 0));
}

// 200,000 words: linear time is a moment, quadratic time a day.
TEST(LenientReaders, MaterialFilesOfALongLine) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "in" / "sub");
  std::filesystem::create_directory(folder.path() / "out");
  folder.write("in/w1 w2", "");
  const MaterialFiles materials(folder.file("in/a.obj"), folder.file("out/b.obj"));
  for (const char* prefix : {"w", "sub/w", "none/w"}) {
    std::string line = "mtllib";
    for (int k = 0; k < 200000; ++k) line += std::string(" ") + prefix + std::to_string(k);
    const std::string moved = materials.repointed(line);
    EXPECT_NE(moved.find(std::string(" ../in/") + prefix + "199999"), std::string::npos);
    EXPECT_EQ(moved.find("\nmtllib ../in/w1 w2") != std::string::npos, prefix == std::string("w"));
  }
}

TEST(LenientReaders, MaterialFilesAreNamedFromTheOutput) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "in" / "sub");
  std::filesystem::create_directory(folder.path() / "out");
  const std::string from = folder.file("in/a.obj"), to = folder.file("out/b.obj");
  for (const char* name : {"in/my own.mtl", "in/plain", "in/two words", "in/sub/c.mtl"})
    folder.write(name, "");
  const MaterialFiles materials(from, to);
  const auto moved = [&](const std::string& line) { return materials.repointed(line); };
  EXPECT_EQ(moved("mtllib a.mtl"), "mtllib ../in/a.mtl");
  EXPECT_EQ(moved("mtllib  sub/c.mtl  ../x.mtl # y"), "mtllib ../in/sub/c.mtl ../x.mtl");
  EXPECT_EQ(moved("mtllib a.mtl my own.mtl plain"),
            "mtllib ../in/a.mtl ../in/plain\nmtllib ../in/my own.mtl");
  EXPECT_EQ(moved("mtllib two words"), "mtllib ../in/two words");
  EXPECT_EQ(moved("mtllib not there.mtl"), "mtllib ../in/not there.mtl");
  EXPECT_EQ(moved("mtllib /abs/a.mtl"), "mtllib /abs/a.mtl");
  EXPECT_EQ(moved("mtllib"), "mtllib");
  const std::string odd = "mtllib  a.mtl  b c.mtl";
  EXPECT_EQ(MaterialFiles(from, folder.file("in/b.obj")).repointed(odd), odd);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
