#include "majorant/io/files_read_by.h"

#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "io_test_helpers.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/material_lines.h"

namespace majorant {
namespace {

namespace fs = std::filesystem;

class FilesReadBy : public testing::Test {
 protected:
  std::string write(const std::string& name, std::string_view content) const {
    fs::create_directories(fs::path(folder_.file(name)).parent_path());
    return folder_.write(name, content);
  }
  // Returns names relative to the folder, in alphabetical order.
  std::set<std::string> of(const std::string& name) const {
    std::set<std::string> names;
    for (const std::string& file : files_read_by(folder_.file(name))) {
      EXPECT_TRUE(fs::exists(file)) << file;
      EXPECT_TRUE(names.insert(fs::path(file).lexically_relative(folder_.path()).string()).second)
          << file;
    }
    return names;
  }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
};

using Names = std::set<std::string>;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(FilesReadBy, LibrariesOfAnObjAndTheirImages) {
  for (const char* image : {"wood.png", "my bark.png", "textures/deep/bumps.png", "relief.png",
                            "shine.png", "2.png", "mirror.png", "normals.png", "unused.png"})
    write(image, "x");
  write("a.mtl",
        "# materials\nnewmtl wood\nKd 1 1 1\n  map_Kd wood.png\r\nmap_Ks -blendu on -mm 0 1 my "
        "bark.png\nbump -bm 0.5 textures\\deep\\bumps.png\ndisp -o 1 1 1 relief.png\n"
        "map_Pr -s 2 -t 0.5 0.5 shine.png\ndecal -o 1 2.png\nrefl -type sphere mirror.png\n"
        "norm -imfchan r  normals.png  \nmap_Ke missing.png\nmap_Kd wood.png\nillum unused.png\n");
  write("a.obj", "mtllib a.mtl\n" + kTriangle);
  EXPECT_EQ(of("a.obj"), (Names{"a.mtl", "wood.png", "my bark.png", "textures/deep/bumps.png",
                                "relief.png", "shine.png", "2.png", "mirror.png", "normals.png"}));
}

TEST_F(FilesReadBy, NamesOfLibraries) {
  for (const char* library :
       {"a.mtl", "b.mtl", "my own.mtl", "in/c.mtl", "d # e.mtl", "plain", "last.mtl", "not.mtl"})
    write(library, "");
  write("in/c.mtl", "map_Kd wood.png\n");
  write("in/wood.png", "x");
  write("wood.png", "x");
  const auto of_lines = [&](const std::string& lines) {
    write("a.obj", lines);
    return of("a.obj");
  };
  EXPECT_EQ(of_lines("mtllib a.mtl b.mtl\n"), (Names{"a.mtl", "b.mtl"}));
  EXPECT_EQ(of_lines(kTriangle + "\tmtllib my own.mtl # not.mtl"), (Names{"my own.mtl"}));
  EXPECT_EQ(of_lines("mtllib in\\c.mtl\n"), (Names{"in/c.mtl", "in/wood.png"}));
  EXPECT_EQ(of_lines("mtllib in/../a.mtl\n"), (Names{"in/../a.mtl"}));
  EXPECT_EQ(of_lines("mtllib d # e.mtl\n"), (Names{"d # e.mtl"}));
  EXPECT_EQ(of_lines("mtllib plain\nmtllib plain\n"), (Names{"plain"}));
  EXPECT_EQ(of_lines("mtllib a.mtl \\\r\n  b.mtl\r\nmtllib \\\n\\\nlast.mtl"),
            (Names{"a.mtl", "b.mtl", "last.mtl"}));
  EXPECT_EQ(of_lines("\xEF\xBB\xBFmtllib a.mtl\n"), (Names{"a.mtl"}));
  EXPECT_EQ(of_lines("g a\rmtllib a.mtl\rmtllib b.mtl\r"), (Names{"a.mtl", "b.mtl"}));
  EXPECT_EQ(of_lines("# mtllib not.mtl\ng mtllib not.mtl\nmtllibs not.mtl\nmtllib none.mtl\n"
                     "mtllib\nmtllib in\n"),
            Names());
}

// Blocks of a file end anywhere: in the keyword, in the name, between a backslash and its line end.
TEST_F(FilesReadBy, LinesAcrossBlocks) {
  for (const char* library : {"a.mtl", "b.mtl", "c.mtl"}) write(library, "");
  constexpr std::size_t kBlock = 1 << 16;
  for (std::size_t before = kBlock - 24; before <= kBlock + 2; ++before) {
    const std::string comment = "#" + std::string(before - 2, '-') + "\n";
    write("a.obj", comment + "mtllib a.mtl \\\n b.mtl\n" + kTriangle + "mtllib c.mtl");
    EXPECT_EQ(of("a.obj"), (Names{"a.mtl", "b.mtl", "c.mtl"})) << before;
  }
  // Lines longer than any name.
  const std::string dashes(5 << 20, '-');
  write("a.obj", "#" + dashes + "\nmtllib a.mtl\n#" + dashes + "mtllib b.mtl\nmtllib c.mtl\n");
  EXPECT_EQ(of("a.obj"), (Names{"a.mtl", "c.mtl"}));
  std::string blanks = "mtllib ";
  for (int k = 0; k < 400000; ++k) blanks += "mtllib \\\n";
  write("a.obj", blanks + "\nmtllib a.mtl\n");
  EXPECT_TRUE(of("a.obj").contains("a.mtl"));
}

TEST_F(FilesReadBy, CompressedObj) {
  write("a.mtl", "map_Kd wood.png\n");
  write("wood.png", "x");
  const std::string text = "mtllib a.mtl\n" + kTriangle;
  gzFile file = gzopen(folder().file("a.obj.gz").c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  EXPECT_EQ(of("a.obj.gz"), (Names{"a.mtl", "wood.png"}));
  write("b.obj.gz", text);  // is not compressed
  EXPECT_EQ(of("b.obj.gz"), Names());
}

// Data in a .gltf are skipped, for any ends of blocks and any escapes.
TEST_F(FilesReadBy, DataOfGltfAcrossBlocks) {
  write("a.bin", "x");
  constexpr std::size_t kBlock = 1 << 16;
  const std::string begin = R"({"extras": ")";
  for (const std::string data : {R"(data:AAAA)", R"(data:,\"data:\\)", R"(data:\\\"x)"})
    for (std::size_t before = kBlock - 30; before <= kBlock + 2; ++before) {
      const std::string dashes(before - begin.size(), '-');
      write("a.gltf",
            begin + dashes + R"(", "buffers": [{"uri": ")" + data + R"("}, {"uri": "a.bin"}]})");
      EXPECT_EQ(of("a.gltf"), (Names{"a.bin"})) << data << before;
    }
}

// Files that readers refuse are named, but not opened.
TEST_F(FilesReadBy, OutsideOfTheFolder) {
  write("a.mtl", "map_Kd wood.png\n");
  write("wood.png", "x");
  write("in/a.obj", "mtllib ../a.mtl\nmtllib " + folder().file("a.mtl") + "\n");
  EXPECT_EQ(of("in/a.obj"), (Names{"in/../a.mtl", "a.mtl"}));
}

TEST_F(FilesReadBy, BrokenAndStrangeFiles) {
  EXPECT_EQ(of("none.obj"), Names());
  fs::create_directory(folder().file("folder.obj"));
  EXPECT_EQ(of("folder.obj"), Names());
  ASSERT_EQ(::mkfifo(folder().file("fifo.obj").c_str(), 0600), 0);
  EXPECT_EQ(of("fifo.obj"), Names());  // and does not wait
  ASSERT_EQ(::mkfifo(folder().file("fifo.mtl").c_str(), 0600), 0);
  write("binary.mtl", std::string("\0\1map_Kd wood.png\n", 18));
  write("a.obj", std::string("mtllib fifo.mtl\n\0\nmtllib binary.mtl\n", 36));
  EXPECT_EQ(of("a.obj"), (Names{"binary.mtl", "fifo.mtl"}));
  write("a.obj", "mtllib " + std::string(100000, 'a') + "\n");
  EXPECT_EQ(of("a.obj"), Names());
  for (const char* name : {"a.glb", "a.gltf", "a.pvtu"})
    for (const char* text : {"", "glTF", "{", "[[", "{\"buffers\": [{\"uri\": 3}]}", "<VTKFile>"}) {
      write(name, text);
      EXPECT_EQ(of(name), Names()) << name << ": " << text;
    }
  write("a.stl", "solid mtllib a.obj\n");
  EXPECT_EQ(of("a.stl"), Names());
}

TEST_F(FilesReadBy, BuffersAndImagesOfGltf) {
  for (const char* name : {"my data.bin", "b%.bin", "in/wood.png", "other.png", "extra.bin"})
    write(name, "x");
  const std::string json =
      R"({"accessors": [{"extras": {"uri": "extra.bin"}}], "asset": {"version": "2.0"},
          "buffers": [{"uri": "my%20data.bin", "byteLength": 1}, {"byteLength": 3, "uri":
            "data:application/octet-stream;base64,AAAA"}, {"uri":"b%.bin"}, {"uri":"none.bin"}],
          "images": [{"uri": "in/w\u006fod.png"}, {"uri": "data:image/png;base64,AA\"=="},
            {"bufferView": 0, "name": "\"data:"}, {"uri": "other.png"}], "uri": "extra.bin"})";
  const Names names{"my data.bin", "b%.bin", "in/wood.png", "other.png"};
  write("a.gltf", json);
  EXPECT_EQ(of("a.gltf"), names);
  const auto number = [](std::size_t n) {
    const auto value = static_cast<std::uint32_t>(n);
    return std::string(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  const std::string binary(1 << 20, '"');
  write("a.glb", "glTF" + number(2) + number(28 + json.size() + binary.size()) +
                     number(json.size()) + "JSON" + json + number(binary.size()) +
                     std::string("BIN\0", 4) + binary);
  EXPECT_EQ(of("a.glb"), names);
}

TEST_F(FilesReadBy, PiecesOfAPvtu) {
  write("a_0.vtu", "x");
  write("in/a & b.vtu", "x");
  write("a.pvtu",
        "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"a_0.vtu\"/>"
        "<Piece Source=\"in/a &amp; b.vtu\"/><Piece Source=\"none.vtu\"/></PUnstructuredGrid>"
        "</VTKFile>");
  EXPECT_EQ(of("a.pvtu"), (Names{"a_0.vtu", "in/a & b.vtu"}));
}

// Paths relative to that folder.
TEST_F(FilesReadBy, RelativePaths) {
  write("in/a.mtl", "");
  write("in/a.obj", "mtllib a.mtl\n");
  const fs::path before = fs::current_path();
  fs::current_path(folder().path());
  EXPECT_EQ(files_read_by("in/a.obj"), std::vector<std::string>{"in/a.mtl"});
  fs::current_path(folder().file("in"));
  EXPECT_EQ(files_read_by("a.obj"), std::vector<std::string>{"a.mtl"});
  fs::current_path(before);
}

TEST(MaterialLines, OptionsBeforeNames) {
  const auto name = [](std::string_view line) {
    const auto image = material_image(line);
    return image ? image->name : "-";
  };
  EXPECT_EQ(name("map_Kd a.png"), "a.png");
  EXPECT_EQ(name("  map_Kd\t-o 1 2 3 a b.png \r"), "a b.png");
  EXPECT_EQ(name("map_Kd -o 1 2 3 4 5.png"), "4 5.png");
  EXPECT_EQ(name("map_Kd -s 1 -t 1 1 -mm 0 1 -clamp on in\\a.png"), "in/a.png");
  EXPECT_EQ(name("bump -bm 1.0"), "");
  EXPECT_EQ(name("bumpy a.png"), "-");
  EXPECT_EQ(name("Kd 1 1 1"), "-");
  const auto options = material_image("map_d -s 1 1 -mm 0 1 a.png")->options;
  ASSERT_EQ(options.size(), 2u);
  EXPECT_EQ(options[0].name, "-s");
  EXPECT_EQ(options[1].name, "-mm");
  EXPECT_EQ(options[1].values, (std::vector<std::string_view>{"0", "1"}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
