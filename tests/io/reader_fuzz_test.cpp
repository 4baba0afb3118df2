// Damaged files: every reader gives a result or an Error for any bytes. Run it under
// -fsanitize=address,undefined (preset asan).
#include <algorithm>
#include <functional>

#include "compressed_helpers.h"
#include "io_test_helpers.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/read_vertex_lists.h"

namespace majorant {
namespace {

void require_valid(const PolygonMesh& mesh) {
  ASSERT_FALSE(mesh.positions.empty());
  ASSERT_FALSE(mesh.polygons.empty());
  for (const Vector3& p : mesh.positions) ASSERT_TRUE(p.allFinite());
  for (const Vector2& t : mesh.texcoords) ASSERT_TRUE(t.allFinite());
  const auto require_lists = [&](const IndexLists& lists, std::size_t count) {
    ASSERT_TRUE(lists.empty() || lists.size() == mesh.polygons.size());
    for (std::size_t p = 0; p < lists.size(); ++p) {
      ASSERT_TRUE(lists[p].empty() || lists[p].size() == mesh.polygons[p].size());
      for (const Index i : lists[p]) ASSERT_TRUE(i >= 0 && static_cast<std::size_t>(i) < count);
    }
  };
  require_lists(mesh.polygons, mesh.positions.size());
  require_lists(mesh.polygon_texcoords, mesh.texcoords.size());
  require_lists(mesh.polygon_normals, mesh.normals.size());
  for (const auto& polygon : mesh.polygons) ASSERT_GE(polygon.size(), 3u);
}

std::string ply(const std::string& format, const std::string& records) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n" +
         records;
}

std::string example(const std::string& extension) {
  const TemporaryFolder folder;
  if (extension == "obj") {
    return "mtllib a\nv 0 0 0\nl 1 -1\nnew word\nv 1.5e-3 0 0 \\\n 1\nv 0 1 0\nvt 0 0\nvn 0 0 1\ng "
           "x\n"
           "f 1/1/1 2/1/1 3/1/1\nf -1//1 -2//1 -3//1\nf 1 2 3 # c\n";
  }
  if (extension == "off") return "COFF\n3 1 0\n0 0 0 1\n1 0 0 1\n0 1 0 1\n3 0 1 2 7\n";
  if (extension == "stream.off") return "OFF 3 1\n0 0 0 1 0 0\n0 1 0 3 0\n1 2\n";
  if (extension == "strips.ply") {
    std::string text = ply("ascii", "0 0 0\n1 0 0\n0 1 0\n7 0 1 2 -1 0 2 1\n");
    return text.replace(text.find("face"), 4, "tristrips");
  }
  if (extension == "ascii.ply") return ply("ascii", "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  if (extension == "little.ply") {
    std::string records(36 + 13, '\0');
    records[36] = 3;
    records[41] = 1;
    records[45] = 2;
    return ply("binary_little_endian", records);
  }
  if (extension == "big.ply") {
    std::string records(36 + 13, '\0');
    records[36] = 3;
    records[44] = 1;
    records[48] = 2;
    return ply("binary_big_endian", records);
  }
  if (extension == "ascii.stl") {
    return "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
           "endloop\nendfacet\nendsolid a\n";
  }
  if (extension == "binary.stl") {
    std::string data(84 + 100, '\0');
    data[80] = 2;
    return data;
  }
  if (extension == "json") {
    return R"({"index_base": 1, "handles": [{"vertex": 1, "target": [0.5, -1e2]},
              {"vertex": 2, "target": "initial"}], "other": [true, null, "\u00e9"]})";
  }
  if (extension == "wedges.ply") {
    std::string text = ply("ascii", "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 6 0 0 1 0 0 1\n");
    return text.insert(text.find("end_header"), "property list uchar float texcoord\n");
  }
  if (extension == "copies.ply") {
    write_ply(folder.file("map.ply"), random_strip(1, 2, 1), nullptr);
    return content_of(folder.file("map.ply"));
  }
  if (extension == "msh" || extension == "views.msh") {
    const bool is_image = extension == "msh";
    write_msh(folder.file("map.msh"), random_strip(2, 2, 1),
              is_image ? MshContent::Image : MshContent::Surface);
    return content_of(folder.file("map.msh"));
  }
  if (extension == "lagrange.vtu") {
    write_vtu(folder.file("map.vtu"), random_strip(2, 2, 1), VtuCells::Lagrange);
    return content_of(folder.file("map.vtu"));
  }
  if (extension == "glb" || extension == "gltf") {
    write_gltf(folder.file("map." + extension), random_strip(1, 2, 1), nullptr);
    return content_of(folder.file("map." + extension));
  }
  if (extension == "obj.gz") return gzip_of(example("obj"));
  write_vtu(folder.file("map.vtu"), random_strip(2, 2, 1));
  const std::string vtu = content_of(folder.file("map.vtu"));
  return extension == "zlib.vtu" ? compressed_vtu(vtu, 48) : vtu;
}

class ReaderFuzz : public ::testing::TestWithParam<std::string> {
 protected:
  // Reads the bytes as a file of the tested format; returns whether there is a result.
  bool survives(const std::string& content) const {
    const std::string path = folder_.write("fuzz." + GetParam(), content);
    try {
      if (GetParam() == "json") {
        read_handles(path, 10);
      } else {
        require_valid(read_mesh(path));
        if (GetParam().ends_with("msh")) read_map(path);
      }
      return true;
    } catch (const Error& error) {
      // Other versions and extensions of other names are recognized, but not supported.
      const bool may_be_other = GetParam() == "glb" || GetParam() == "gltf";
      if (!may_be_other || error.kind() != ErrorKind::Unsupported) {
        EXPECT_EQ(error.kind(), ErrorKind::Unreadable) << error.what();
      }
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos) << error.what();
      return false;
    }
  }

  TemporaryFolder folder_;
};

TEST_P(ReaderFuzz, ExampleIsValid) { EXPECT_TRUE(survives(example(GetParam()))); }

TEST_P(ReaderFuzz, TruncatedAtEveryByte) {
  const std::string content = example(GetParam());
  for (std::size_t length = 0; length < content.size(); ++length) {
    survives(content.substr(0, length));
  }
}

TEST_P(ReaderFuzz, RandomDamage) {
  const std::string content = example(GetParam());
  const std::string pieces = "0123456789-+.eE/\\#\n\r\t <>\"'=&;{}[],_nif\xFF\x7F\x80";
  std::mt19937 random(17);
  const auto below = [&random](std::size_t bound) { return random() % bound; };
  for (int round = 0; round < 1500; ++round) {
    std::string damaged = content;
    for (std::size_t hit = 0; hit <= below(4); ++hit) {
      const std::size_t at = below(damaged.size());
      switch (below(5)) {
        case 0:
          damaged[at] = static_cast<char>(below(256));
          break;
        case 1:
          damaged[at] = pieces[below(pieces.size())];
          break;
        case 2:
          damaged.erase(at, 1 + below(3));
          break;
        case 3:
          damaged.insert(at, 1, pieces[below(pieces.size())]);
          break;
        default:
          damaged.insert(at, damaged.substr(below(damaged.size()), below(20)));
      }
      if (damaged.empty()) damaged.assign(1, 'x');
    }
    survives(damaged);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, ReaderFuzz,
                         ::testing::Values("obj", "off", "ascii.ply", "little.ply", "big.ply",
                                           "ascii.stl", "binary.stl", "vtu", "json", "stream.off",
                                           "strips.ply", "obj.gz", "zlib.vtu", "wedges.ply",
                                           "copies.ply", "msh", "views.msh", "lagrange.vtu", "glb",
                                           "gltf"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
