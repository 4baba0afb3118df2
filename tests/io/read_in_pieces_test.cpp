// Files read and written in pieces, by any number of threads, equal those of one thread.
#include <fmt/format.h>

#include <random>

#include "io_test_helpers.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/base64.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"

namespace majorant {
namespace {

// Returns a grid of n squares per side with lines of many kinds and lengths: several pieces, which
// end anywhere.
std::string grid_text(int n, std::string_view line_end) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::string text = "# a grid\n\nmtllib none.mtl\n";
  const auto add = [&](const std::string& line) { text.append(line).append(line_end); };
  for (int k = 0; k < (n + 1) * (n + 1); ++k) {
    const int kind = k % 7;
    std::string line = fmt::format("v {} {} {:.7f}", k % (n + 1), k / (n + 1), uniform(random));
    if (kind == 2) line += " 0.25 0.5 1";
    if (kind == 3) line = "  " + line + "   # a comment \\";
    if (kind == 4) line.insert(line.find(' '), fmt::format(" \\{}\t", line_end));
    if (kind == 5) add("");
    add(line);
    add(fmt::format("vt {} {}", uniform(random), kind == 1 ? 0.125 : uniform(random)));
  }
  for (int j = 0; j < n; ++j) {
    if (j % 5 == 0) add(fmt::format("g row{}", j));
    if (j % 9 == 0) add(fmt::format("l {} {}", j + 1, j + 2));
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i + 1, b = a + 1, c = b + n + 1, d = a + n + 1;
      if (i % 3 == 0)
        add(fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}", a, b, c, d));
      else
        add(fmt::format("f {0}/{0} {1}/{1} {2}/{2}\nf {0}/{0} \\{4}{2}/{2} {3}/{3}", a, b, c, d,
                        line_end));
    }
  }
  return text;
}

void expect_same(const PolygonMesh& mesh, const PolygonMesh& expected) {
  EXPECT_EQ(mesh.positions, expected.positions);
  EXPECT_EQ(mesh.texcoords, expected.texcoords);
  EXPECT_EQ(mesh.texcoord_rounding, expected.texcoord_rounding);
  EXPECT_EQ(mesh.normals, expected.normals);
  EXPECT_EQ(mesh.polygons, expected.polygons);
  EXPECT_EQ(mesh.polygon_texcoords, expected.polygon_texcoords);
  EXPECT_EQ(mesh.polygon_normals, expected.polygon_normals);
  EXPECT_EQ(mesh.polygon_lines, expected.polygon_lines);
  EXPECT_EQ(mesh.directives, expected.directives);
  EXPECT_EQ(mesh.warnings, expected.warnings);
  ASSERT_EQ(mesh.colors.size(), expected.colors.size());
  for (std::size_t v = 0; v < mesh.colors.size(); ++v) {
    EXPECT_EQ(mesh.colors[v].allFinite(), expected.colors[v].allFinite());
    if (mesh.colors[v].allFinite()) {
      EXPECT_EQ(mesh.colors[v], expected.colors[v]);
    }
  }
}

// Expects the same mesh, or the same message, for any number of threads.
void expect_same_by_any_threads(const std::string& path) {
  const auto read = [&](int threads, PolygonMesh& mesh) {
    const ThreadCount some(threads);
    try {
      mesh = read_mesh(path);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  PolygonMesh expected;
  const std::string message = read(1, expected);
  for (const int threads : {2, 3, 8}) {
    PolygonMesh mesh;
    EXPECT_EQ(read(threads, mesh), message);
    expect_same(mesh, expected);
  }
}

TEST(ReadInPieces, ObjOfAnyLines) {
  const TemporaryFolder folder;
  for (const std::string line_end : {"\n", "\r\n"}) {
    const std::string text = grid_text(90, line_end);
    ASSERT_GT(text.size(), std::size_t{1} << 19);
    expect_same_by_any_threads(folder.write("grid.obj", text));
    EXPECT_EQ(read_mesh(folder.file("grid.obj")).polygons.size(), 90u * 150);
  }
}

TEST(ReadInPieces, ObjWhosePiecesDependOnEachOther) {
  const TemporaryFolder folder;
  const std::string text = grid_text(60, "\n");
  const std::size_t middle = text.find('\n', text.size() / 2) + 1, end = text.size() - 1;
  for (const std::string line :
       {"f -1 -2 -3\n", "f 1 2 999999\n", "f 1 2 x\n", "v 1 2\n", "v 1 2 nan\n", "vt x y\n",
        "vn 0 0\n", "f 1/1 2 3\n", "f 1/99999999 2/1 3/1\n", "curv 1 2\n", "l 1 999999\n", "?\n",
        "f 1 2\n", "v 0 0 0\nf -1 -2 1\n"})
    for (const std::size_t place : {middle, text.find('\n', end - 200) + 1})
      expect_same_by_any_threads(
          folder.write("a.obj", text.substr(0, place) + line + text.substr(place)));
}

TEST(ReadInPieces, AllPlacesOfABorder) {
  // Each time the border is one character later: in a continuation, a comment, numbers.
  const TemporaryFolder folder;
  const std::string text = grid_text(30, "\r\n");
  const std::string head(std::size_t{1} << 17, '#');
  for (std::size_t shift = 0; shift < 160; shift += 5)
    expect_same_by_any_threads(folder.write("a.obj", head.substr(shift + 500) + "\n" + text));
}

TEST(ReadInPieces, MapsInEveryFormat) {
  const TemporaryFolder folder;
  for (const int degree : {1, 3}) {
    MapFile map = random_strip(degree, 20000, 3);
    map.input_vertex = Eigen::VectorXi::Constant(map.points.rows(), -1);
    map.input_face =
        Eigen::VectorXi::LinSpaced(map.cells.rows(), 0, static_cast<Index>(map.cells.rows()) - 1);
    for (const std::string name : {"a.vtu", "a.msh"}) {
      std::string expected;
      MapFile back;
      for (const int threads : {1, 2, 5}) {
        const ThreadCount some(threads);
        if (name == "a.vtu")
          write_vtu(folder.file(name), map);
        else
          write_msh(folder.file(name), map, MshContent::Surface);
        const std::string bytes = content_of(folder.file(name));
        const MapFile read = read_map(folder.file(name));
        if (threads == 1) {
          expected = bytes;
          back = read;
        }
        EXPECT_TRUE(bytes == expected);
        EXPECT_EQ(read.points, back.points);
        EXPECT_EQ(read.uv, back.uv);
        EXPECT_EQ(read.uv_rounding, back.uv_rounding);
        EXPECT_EQ(read.cells, back.cells);
        EXPECT_EQ(read.input_face, back.input_face);
      }
      EXPECT_EQ(back.points, map.points);
      EXPECT_EQ(back.cells, map.cells);
    }
  }
}

TEST(ReadInPieces, BrokenLinesOfMsh) {
  const TemporaryFolder folder;
  write_msh(folder.file("a.msh"), random_strip(1, 20000, 3), MshContent::Surface);
  const std::string text = content_of(folder.file("a.msh"));
  for (const double part : {0.1, 0.4, 0.6, 0.8, 0.999}) {
    const std::size_t place =
        text.find('\n', static_cast<std::size_t>(part * static_cast<double>(text.size()))) + 1;
    for (const std::string line : {"", "\n", "# a comment\n", "x\n", "1 nan\n", "1 2 3 4 5 6\n"})
      expect_same_by_any_threads(
          folder.write("b.msh", text.substr(0, place) + line + text.substr(place)));
    expect_same_by_any_threads(folder.write("b.msh", text.substr(0, place)));
  }
}

TEST(ReadInPieces, TextOfManyLines) {
  PolygonMesh mesh;
  const TemporaryFolder folder;
  mesh = read_mesh(folder.write("grid.obj", grid_text(60, "\n")));
  mesh.directives.emplace_back(static_cast<Index>(mesh.polygons.size()), "# the end");
  std::string expected;
  for (const int threads : {1, 2, 7}) {
    const ThreadCount some(threads);
    const std::string text = obj_text(mesh);
    if (threads == 1) expected = text;
    EXPECT_TRUE(text == expected);
  }
  EXPECT_TRUE(expected.ends_with("\n# the end\n"));
}

TEST(ReadInPieces, Base64OfAnySize) {
  std::mt19937 random(1);
  std::string bytes;
  for (int k = 0; k < 200000; ++k) bytes += static_cast<char>(random() & 255u);
  for (const std::size_t size : {0, 1, 2, 3, 49151, 49152, 49153, 199999, 200000}) {
    std::string expected;
    for (const int threads : {1, 4}) {
      const ThreadCount some(threads);
      std::string text = "before";
      append_base64(std::string_view(bytes).substr(0, size), text);
      text.erase(0, 6);
      if (threads == 1) expected = text;
      EXPECT_TRUE(text == expected);
      EXPECT_EQ(text.size(), base64_length(size));
      EXPECT_TRUE(decode_base64(text) == bytes.substr(0, size)) << size;
      EXPECT_TRUE(decode_base64(text + text) == bytes.substr(0, size) + bytes.substr(0, size));
      if (size < 4) continue;
      text[size / 2] = '*';
      EXPECT_FALSE(decode_base64(text));
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
