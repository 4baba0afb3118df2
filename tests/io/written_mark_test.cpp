#include "majorant/io/written_mark.h"

#include <sys/stat.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "cube_map.h"
#include "io_test_helpers.h"
#include "majorant/io/io.h"
#include "majorant/io/pvtu.h"
#include "majorant/io/read_mesh.h"
#include "public_data.h"

namespace majorant {
namespace {

std::size_t count_of(std::string_view text, std::string_view what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

// Counts "majorant 0.1.0", also in "majorant": "0.1.0"; claims stored as bytes are not counted.
std::size_t marks_in(const std::string& path) {
  const std::string text = content_of(path);
  return count_of(text, written_mark()) + count_of(text, "\"majorant\":\"" + written_version()) +
         count_of(text, "\"majorant\": \"" + written_version());
}

MapFile claiming_nothing(MapFile map) {
  map.claims.clear();
  return map;
}

TEST(WrittenMark, IsInEveryMapThatIsWritten) {
  const TemporaryFolder folder;
  for (int degree = 1; degree <= 2; ++degree) {
    const MapFile map = claiming_nothing(to_map_file(cube_map(degree)));
    const PolygonMesh input = cube();
    for (const char* name : {"a.obj", "a.ply", "a.glb", "a.gltf", "a.msh", "a.vtu", "b.msh"}) {
      SCOPED_TRACE(name);
      const std::string path = folder.file(name);
      if (path.ends_with(".obj")) write_obj(path, map, &input);
      if (path.ends_with(".ply")) write_ply(path, map, &input);
      if (path.ends_with(".glb") || path.ends_with(".gltf")) write_gltf(path, map, &input);
      if (path.ends_with(".msh"))
        write_msh(path, map, name[0] == 'a' ? MshContent::Image : MshContent::Surface);
      if (path.ends_with(".vtu")) write_vtu(path, map);
      EXPECT_TRUE(takes_mark(path));
      EXPECT_TRUE(has_mark(path));
      EXPECT_EQ(marks_in(path), 1u);
      EXPECT_EQ(read_map(path).cells.rows(), map.cells.rows());
    }
  }
}

// In every format, the mark is as early in the file as readers allow.
TEST(WrittenMark, StandsWhereReadersTakeComments) {
  const TemporaryFolder folder;
  const MapFile map = to_map_file(cube_map(1));
  const PolygonMesh input = cube();
  const std::string mark = written_mark();
  write_obj(folder.file("a.obj"), map, &input);
  EXPECT_TRUE(content_of(folder.file("a.obj")).starts_with("# " + mark + "\n# cones: "));
  write_ply(folder.file("a.ply"), map, &input);
  EXPECT_TRUE(
      content_of(folder.file("a.ply"))
          .starts_with("ply\nformat binary_little_endian 1.0\ncomment " + mark + "\ncomment cone"));
  write_msh(folder.file("a.msh"), map, MshContent::Image);
  EXPECT_TRUE(content_of(folder.file("a.msh"))
                  .starts_with("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\n" + mark +
                               "\n$EndComments\n$"));
}

// In a map with claims these are the mark, as bytes. A file that VTK saves of one has another
// writer.
TEST(WrittenMark, ClaimsAreOneAsTheyAreWritten) {
  const TemporaryFolder folder;
  const MapFile map = random_strip(2, 3, 1);
  const std::string path = folder.file("a.vtu");
  write_vtu(path, map);
  EXPECT_TRUE(has_mark(path));
  EXPECT_EQ(marks_in(path), 0u);
  std::string text = content_of(path);
  const std::size_t at = text.find("format=\"ascii\"");
  text.replace(at, 14, "format=\"ascii\" RangeMin=\"32\" RangeMax=\"125\"");
  EXPECT_FALSE(has_mark(folder.write("saved.vtu", text)));
  text = content_of(path);
  text.replace(text.find("<?xml"), 0, "\xEF\xBB\xBF");
  EXPECT_TRUE(has_mark(folder.write("marked.vtu", text)));
  write_vtu(path, claiming_nothing(map));
  EXPECT_TRUE(content_of(path).starts_with("<?xml version=\"1.0\"?>\n<!-- " + written_mark() +
                                           " -->\n<VTKFile "));
  EXPECT_EQ(read_vtu(path).claims, "");
}

TEST(WrittenMark, IsInFilesOfPieces) {
  const TemporaryFolder folder;
  const MapFile map = random_strip(2, 3, 1);
  write_vtu(folder.file("a_0.vtu"), map);
  const std::string path = folder.write("a.pvtu", pvtu_text(map, {"a_0.vtu"}));
  EXPECT_TRUE(has_mark(path));
  EXPECT_EQ(marks_in(path), 1u);
  EXPECT_EQ(read_pvtu(path).cells.rows(), 3);
}

// Written repeatedly, by any number of versions: one mark.
TEST(WrittenMark, IsReplacedInWhatIsReadAndWritten) {
  const TemporaryFolder folder;
  const MapFile map = claiming_nothing(to_map_file(cube_map(1)));
  const PolygonMesh plain = cube();
  write_obj(folder.file("a.obj"), map, &plain);
  const std::string text = content_of(folder.file("a.obj"));
  folder.write("b.obj", "# majorant 0.0.7\n# majorant of a regiment\n" + text);
  const PolygonMesh input = read_mesh(folder.file("b.obj"));
  for (int k = 0; k < 3; ++k) {
    const PolygonMesh again = read_mesh(folder.file(k == 0 ? "b.obj" : "a.obj"));
    EXPECT_EQ(again.directives, input.directives);
    write_obj(folder.file("a.obj"), map, &again);
    EXPECT_EQ(count_of(content_of(folder.file("a.obj")), "# majorant"), 2u);
    EXPECT_EQ(marks_in(folder.file("a.obj")), 1u);
  }
  write_gltf(folder.file("a.glb"), map, &plain);
  for (int k = 0; k < 3; ++k) {
    const PolygonMesh again = read_mesh(folder.file("a.glb"));
    MapFile of_again = to_map_file(again);
    write_gltf(folder.file("a.glb"), of_again, &again);
    EXPECT_EQ(marks_in(folder.file("a.glb")), 1u);
  }
}

nlohmann::json asset_of(const std::string& path) {
  return nlohmann::json::parse(content_of(path))["asset"];
}

// The name of the program that made a model is kept.
TEST(WrittenMark, LeavesTheGeneratorOfOthers) {
  const TemporaryFolder folder;
  const MapFile map = claiming_nothing(to_map_file(cube_map(1)));
  const PolygonMesh plain = cube();
  const std::string path = folder.file("a.gltf");
  const auto written_with = [&](const nlohmann::json& asset) {
    write_gltf(path, map, &plain);
    nlohmann::json file = nlohmann::json::parse(content_of(path));
    file["asset"] = asset;
    folder.write("b.gltf", file.dump());
    EXPECT_FALSE(has_mark(folder.file("b.gltf"))) << asset;
    const PolygonMesh input = read_mesh(folder.file("b.gltf"));
    write_gltf(path, to_map_file(input), &input);
    EXPECT_TRUE(has_mark(path)) << asset;
    EXPECT_EQ(marks_in(path), 1u);
    const PolygonMesh again = read_mesh(path);
    const nlohmann::json first = asset_of(path);
    write_gltf(path, to_map_file(again), &again);
    EXPECT_EQ(asset_of(path), first);
    return first;
  };
  const nlohmann::json of_blender{{"version", "2.0"}, {"generator", "Blender"}};
  EXPECT_EQ(written_with(of_blender),
            nlohmann::json({{"version", "2.0"},
                            {"generator", "Blender"},
                            {"extras", {{"majorant", written_version()}}}}));
  EXPECT_EQ(
      written_with({{"version", "2.0"}, {"extras", {{"a", 1}}}}),
      nlohmann::json({{"version", "2.0"}, {"generator", written_mark()}, {"extras", {{"a", 1}}}}));
  EXPECT_EQ(written_with({{"version", "2.0"}, {"generator", "Blender"}, {"extras", 3}}),
            nlohmann::json({{"version", "2.0"}, {"generator", written_mark()}, {"extras", 3}}));
}

TEST(WrittenMark, FilesOfOthersHaveNone) {
  const TemporaryFolder folder;
  const std::string mark = written_mark(), json = R"("version": "2.0", "generator": )";
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"a.obj", ""},
           {"a.obj", "# Blender v2.91.0 OBJ File: 'a.blend'\n# www.blender.org\nv 0 0 0\n"},
           {"a.obj", "# another\n# " + mark + "\nv 0 0 0\n"},  // in a copied comment
           {"a.obj", "# " + mark + " and more\nv 0 0 0\n"},
           {"a.obj", "# majorant\nv 0 0 0\n"},
           {"a.obj", "# " + mark},  // truncated
           {"a.ply", "ply\nformat ascii 1.0\ncomment VCGLIB generated\nend_header\n"},
           {"a.ply", "comment " + mark + "\n"},
           {"a.ply", "ply"},
           {"a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 0\n$EndEntities\n"},
           {"a.msh", "$Comments\n" + mark + "\n$EndComments\n$Nodes\n"},
           {"a.mesh", "MFEM mesh v1.0\n\n#\n# MFEM Geometry Types\n#\ndimension\n2\n"},
           {"a.mesh", " MeshVersionFormatted 2\n Dimension 3\n"},
           {"a.vtu", "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n"},
           {"a.pvtu", "<VTKFile type=\"PUnstructuredGrid\"><!-- " + mark + " --></VTKFile>\n"},
           {"a.gltf", "{\"asset\": {" + json + "\"Khronos glTF Blender I/O v3.4\"}}"},
           {"a.gltf", "{\"asset\": {" + json + "\"THREE\"}, \"generator\": \"" + mark + "\"}"},
           {"a.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"extras\": {\"majorant\": \"1\"}}"},
           {"a.gltf", "no JSON"},
           {"a.glb", "glTF"},
           {"a.glb", "{\"asset\": {" + json + "\"majorette 3\"}}"},
           {"a.png", "# " + mark + "\n"},
           {"a.json", "{\"asset\": {" + json + "\"" + mark + "\"}}"}})
    EXPECT_FALSE(has_mark(folder.write(name, text))) << name << ": " << text;
  EXPECT_FALSE(has_mark(folder.file("none.obj")));
  std::filesystem::create_directory(folder.file("folder.obj"));
  EXPECT_FALSE(has_mark(folder.file("folder.obj")));
  ASSERT_EQ(::mkfifo(folder.file("fifo.obj").c_str(), 0600), 0);
  EXPECT_FALSE(has_mark(folder.file("fifo.obj")));  // and does not wait
  EXPECT_FALSE(takes_mark("a.png") || takes_mark("a.json") || takes_mark("a.svg"));
}

TEST(WrittenMark, PublicFilesHaveNone) {
  const std::filesystem::path all = public_data("bad").parent_path();
  if (all.empty()) GTEST_SKIP() << kNoPublicData;
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(all)) {
    const std::string path = entry.path();
    if (!takes_mark(path) || path.ends_with(".vtu")) continue;  // results of the library
    ++files;
    EXPECT_FALSE(has_mark(path)) << path;
  }
  EXPECT_GT(files, 100);
}

// A mark among the nodes of the read content replaces that of another version.
TEST(WrittenMark, IsPutIntoContent) {
  const std::string mark = written_mark(), old = "majorant 0.0.12";
  struct Case {
    const char* format;
    std::string before, after;  // the mark
    std::string begin, end;
  };
  const std::vector<Case> cases{
      {".mesh", "MFEM mesh v1.0\n", "\n# two squares\ndimension\n2\n", "# ", "\n"},
      {".mesh", "MeshVersionFormatted 2\n", "Dimension 3\n", "# ", "\n"},
      {".mesh", "\n# by hand\n MeshVersionFormatted\n\n2 \n", " Dimension\n3\n", "# ", "\n"},
      {".msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "$Nodes\n", "$Comments\n",
       "\n$EndComments\n"},
      {".msh", std::string("$MeshFormat\n4.1 1 8\n\1\0\0\0\n$EndMeshFormat\n", 40),
       "$Comments\nof a user\n$EndComments\n", "$Comments\n", "\n$EndComments\n"},
      {".vtu", "<?xml version=\"1.0\"?>\n", "<VTKFile>", "<!-- ", " -->\n"},
      {".vtu", "<?xml version=\"1.0\"?>\r\n", "<VTKFile>", "<!-- ", " -->\n"},
      {".vtu", "<?xml version=\"1.0\"?>", "<VTKFile>", "<!-- ", " -->\n"},
      {".vtu", "", "<VTKFile>", "<!-- ", " -->\n"}};
  const TemporaryFolder folder;
  for (const Case& c : cases) {
    SCOPED_TRACE(c.before);
    const std::string bare = c.before + c.after;
    const std::string marked = c.before + c.begin + mark + c.end + c.after;
    EXPECT_EQ(with_mark(mark_style(c.format), bare), marked);
    EXPECT_EQ(with_mark(mark_style(c.format), marked), marked);
    EXPECT_EQ(with_mark(mark_style(c.format), c.before + c.begin + old + c.end + c.after), marked);
    EXPECT_TRUE(has_mark(folder.write(std::string("a") + c.format, marked)));
    EXPECT_FALSE(has_mark(folder.write(std::string("a") + c.format, bare)));
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
