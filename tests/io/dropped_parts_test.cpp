// Damaged parts of a mesh file that do not belong to the shape: dropped with one warning per kind,
// refused where the part is needed, and never written.
#include "majorant/io/internal/dropped_parts.h"

#include "io_test_helpers.h"
#include "majorant/io/formats.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/written_mark.h"

namespace majorant {
namespace {

using Polygons = IndexLists;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

class DroppedPartsOf : public ::testing::Test {
 protected:
  PolygonMesh read(const std::string& name, std::string_view content,
                   Strictness strictness = Strictness::Shape) const {
    return read_mesh(folder_.write(name, content), {}, strictness);
  }
  // Reads the file with this one warning, and expects an error where every part is required.
  PolygonMesh warned(const std::string& name, const std::string& content,
                     const std::vector<std::string>& warning) const {
    const PolygonMesh mesh = read(name, content);
    EXPECT_EQ(mesh.warnings.size(), 1u) << content;
    if (!mesh.warnings.empty()) expect_contains(mesh.warnings[0], warning);
    EXPECT_TRUE(refused(name, content, Strictness::Everything).starts_with(folder_.file(name)));
    return mesh;
  }
  std::string refused(const std::string& name, const std::string& content,
                      Strictness strictness) const {
    return error_message(ErrorKind::Unreadable, [&] { read(name, content, strictness); });
  }

  TemporaryFolder folder_;
};

TEST_F(DroppedPartsOf, ObjTextureCoordinatesThatAreNoNumbers) {
  const std::string text = kSquare +
                           "vt 0 0\nvt nan 0\nvt 1 1\nvt\nvt 0 0.1\n"
                           "f 1/1 2/2 3/3\nf 1/1 3/3 4/5\nf 1/1 3/4 4/5\n";
  const PolygonMesh mesh = read("a.obj", text);
  EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{}, {0, 1, 2}, {}}));
  EXPECT_EQ(mesh.texcoords, (std::vector<Vector2>{{0, 0}, {1, 1}, {0, 0.1}}));
  EXPECT_EQ(mesh.texcoord_rounding.size(), 3u);
  EXPECT_GT(mesh.texcoord_rounding[2][1], 0);
  ASSERT_EQ(mesh.warnings.size(), 2u);
  expect_contains(mesh.warnings[0],
                  {"a.obj:6: texture coordinate 'nan' is not finite: left out", "as is 1 more"});
  expect_contains(mesh.warnings[1], {"a.obj:10: vt 2 is left out", "as is 1 more"});
  for (const Strictness strictness : {Strictness::Texcoords, Strictness::Everything})
    expect_contains(refused("a.obj", text, strictness), {"a.obj:6: ", "correct the file"});
  EXPECT_EQ(obj_text(mesh), mark_text(MarkStyle::FirstLine) + kSquare +
                                "vt 0 0\nvt 1 1\nvt 0 0.1\n"
                                "f 1 2 3\nf 1/1 3/2 4/3\nf 1 3 4\n");
}

TEST_F(DroppedPartsOf, ObjIndicesOutOfRange) {
  const std::string one = "f 1/1 2/1 3/1\n";
  for (const std::string bad : {"9", "0", "-9", "x", "1x", "99999999999999999999", "4294967297"}) {
    const std::string text = kSquare + "vt 0 0\n" + one + "f 1/1 3/" + bad + " 4/1\n";
    const PolygonMesh mesh = warned("a.obj", text, {"a.obj:7: ", "without texture coordinates"});
    EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{0, 0, 0}, {}})) << bad;
    refused("a.obj", text, Strictness::Texcoords);
    const std::string normals = kSquare + "vn 0 0 1\nf 1//1 2//1 3//1\nf 1 3//" + bad + " 4//1\n";
    EXPECT_EQ(warned("a.obj", normals, {"a.obj:7: ", "without normals"}).polygon_normals,
              (Polygons{{0, 0, 0}, {}}))
        << bad;
    read("a.obj", normals, Strictness::Texcoords);
  }
  const PolygonMesh none = warned("a.obj", kSquare + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n",
                                  {"a.obj:5: vt index 1 out of range, the file has 0", "1 more"});
  EXPECT_TRUE(none.polygon_texcoords.empty());
}

TEST_F(DroppedPartsOf, ObjNormalsAndColours) {
  const PolygonMesh mesh = warned("a.obj", "v 0 0 0 0 nan 1\nv 1 0 0 1 0 0\nv 0 1 0 red\nf 1 2 3\n",
                                  {"a.obj:1: colour 'nan' is not finite: left out, as is 1 more"});
  EXPECT_EQ(obj_text(mesh),
            mark_text(MarkStyle::FirstLine) + "v 0 0 0\nv 1 0 0 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const PolygonMesh turned = read("a.obj", kSquare +
                                               "vn 0 0\nvn 0 0 1\nf 1//1 2//1 3//1\n"
                                               "f 1//2 3//2 4//2\n");
  EXPECT_EQ(turned.normals, (std::vector<Vector3>{{0, 0, 1}}));
  EXPECT_EQ(turned.polygon_normals, (Polygons{{}, {0, 0, 0}}));
  expect_contains(turned.warnings.at(0), {"a.obj:5: normal component is missing: left out"});
}

TEST_F(DroppedPartsOf, ObjSlashesPointsAndLines) {
  const PolygonMesh mesh = warned("a.obj", kSquare + "vt 0 0\nf 1/1/ 2/1/ 3/1/\nf 1/ 3// 4\n",
                                  {"a.obj:6: '1/1/' ends with a slash", "as are 4 more"});
  EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{0, 0, 0}, {}}));
  for (const std::string bad : {"l 1 9", "l 1 0", "p -7", "p 1x", "l 1 2 99999999999999999999"})
    EXPECT_EQ(
        warned("a.obj", kSquare + "l 1 2\n" + bad + "\np 4\nf 1 2 3\n", {"a.obj:6: "}).directives,
        (std::vector<std::pair<Index, std::string>>{{0, "l 1 2"}, {0, "p 4"}}))
        << bad;
}

TEST_F(DroppedPartsOf, OffColoursAndAnAdditionalLine) {
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n", faces = "3 0 1 2\n3 0 2 3\n";
  const Polygons both{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(warned("a.off", "OFF\n4 2 0\n" + vertices + faces + "3 1 2 3\n",
                   {"a.off:9: one line more than 4 vertices and 2 faces: left out"})
                .polygons,
            both);
  EXPECT_EQ(warned("a.off", "OFF\n4 2 0\n" + vertices + "3 0 1 2 nan 0 x\n3 0 2 3\n",
                   {"a.off:7: face colour 'nan' is not finite: left out, as is 1 more"})
                .polygons,
            both);
  EXPECT_EQ(
      warned("a.off",
             "COFF\n4 2 0\n0 0 0 1 1 1 1\n1 0 0 1 inf 1 1\n1 1 0 1 1 1 1\n0 1 0 1 1 1 1\n" + faces,
             {"a.off:4: vertex attribute 'inf'"})
          .polygons,
      both);
}

std::string ply(const std::string& u, const std::string& v, const std::string& third,
                const std::string& behind = "") {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
         "property float z\nproperty float " +
         u + "\nproperty float " + v +
         "\nproperty float red\nproperty float green\nproperty float blue\nelement face 2\n"
         "property list uchar int vertex_index\nend_header\n0 0 0 0 0 1 1 1\n1 0 0 1 0 1 1 1\n" +
         third + "\n0 1 0 0 1 1 1 1\n3 0 1 3\n3 1 2 3\n" + behind;
}

TEST_F(DroppedPartsOf, PlyOfVertices) {
  for (const auto& [u, v] : {std::pair("s", "t"),
                             {"u", "v"},
                             {"texture_u", "texture_v"},
                             {"texcoord_u", "texcoord_v"}}) {
    EXPECT_EQ(read("a.ply", ply(u, v, "1 1 0 1 1 1 1 1")).texcoords[2], Vector2(1, 1)) << u;
    for (const std::string bad : {"nan", "inf", "x"}) {
      const std::string text = ply(u, v, "1 1 0 1 " + bad + " 1 1 1");
      const PolygonMesh mesh = read("a.ply", text);
      EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{0, 1, 2}, {}}));
      EXPECT_EQ(mesh.texcoords, (std::vector<Vector2>{{0, 0}, {1, 0}, {0, 1}}));
      ASSERT_EQ(mesh.warnings.size(), 2u);
      expect_contains(mesh.warnings[0], {"a.ply:17: a texture coordinate is no finite number"});
      expect_contains(mesh.warnings[1], {"a.ply:20: ", "vertex 2", "without texture coordinates"});
      expect_contains(refused("a.ply", text, Strictness::Texcoords), {"a.ply:17: "});
    }
  }
  EXPECT_FALSE(warned("a.ply", ply("s", "t", "1 1 0 1 1 nan 1 1"), {"a.ply:17: a colour"})
                   .colors[2]
                   .allFinite());
  EXPECT_EQ(
      warned("a.ply", ply("s", "t", "1 1 0 1 1 1 1 1", "3 0 1 2\n"), {"a.ply:21: one line more"})
          .polygons.size(),
      2u);
  for (const char* position : {"nan 1 0 1 1 1 1 1", "x 1 0 1 1 1 1 1"})
    refused("a.ply", ply("s", "t", position), Strictness::Shape);
}

TEST_F(DroppedPartsOf, PlyOfCorners) {
  const auto with = [](const std::string& coordinates) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
           "property float z\nelement face 2\nproperty list uchar int vertex_indices\n"
           "property list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
           "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 " +
           coordinates + "\n";
  };
  EXPECT_TRUE(read("a.ply", with("0")).warnings.empty());
  for (const char* bad : {"4 0 0 1 1", "6 0 0 1 nan 0 1", "6 0 0 1 1 0 x"}) {
    const PolygonMesh mesh = warned("a.ply", with(bad), {"a.ply:16: "});
    EXPECT_EQ(mesh.polygon_texcoords, (Polygons{{0, 1, 2}, {}})) << bad;
    EXPECT_EQ(mesh.texcoords.size(), 3u);
    refused("a.ply", with(bad), Strictness::Texcoords);
  }
}

TEST_F(DroppedPartsOf, FilesThatAreMapsNeedTheirTextureCoordinates) {
  const std::string path = folder_.write(
      "a.obj", kSquare + "vt 0 0\nvt 1 0\nvt 1 1\nvn x\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  expect_contains(error_message(ErrorKind::Unreadable, [&] { read_map(path); }),
                  {"a.obj:10: vt index 4 out of range, the file has 3"});
  const std::string good =
      folder_.write("b.obj", kSquare + "vt 0 0\nvt 1 0\nvt 1 1\nvn x\nf 1/1 2/2 3/3\n");
  EXPECT_EQ(read_map(good).warnings.size(), 1u);
  error_message(ErrorKind::Unreadable, [&] { read_map(good, {}, Strictness::Everything); });
}

TEST_F(DroppedPartsOf, UnreadableFormatsAreNamed) {
  for (const auto& [name, format] :
       {std::pair("a.fbx", "FBX"), {"A.3MF", "3MF"}, {"a.dae.gz", "COLLADA"}, {"a.3ds", "3DS"}}) {
    EXPECT_EQ(foreign_format(name), format);
    expect_contains(error_message(ErrorKind::Unsupported, [&] { read_mesh(name); }), {format});
  }
  EXPECT_EQ(foreign_format("fbx.obj"), "");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
