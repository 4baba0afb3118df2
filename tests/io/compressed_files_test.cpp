// Files compressed by gzip, VTU arrays compressed by zlib.
#include <cstdlib>

#include "compressed_helpers.h"
#include "counted_stop.h"
#include "io_test_helpers.h"
#include "majorant/io/files/inflate.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/io.h"
#include "majorant/io/read_mesh.h"
#include "majorant/maps/map_file.h"

namespace majorant {
namespace {

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string refusal(const std::string& path) {
  return error_message(ErrorKind::Unreadable, [&] { read_mesh(path); });
}

TEST(CompressedFiles, EveryMeshFormat) {
  const TemporaryFolder folder;
  write_vtu(folder.file("plain.vtu"), random_strip(2, 3, 1));
  const std::string vtu = content_of(folder.file("plain.vtu"));
  for (const auto& [name, content] : {std::pair{"a.obj.gz", kObj},
                                      {"A.OBJ.GZ", kObj},
                                      {"a.off.gz", "OFF 3 1 0\n0 0 0 1 0 0 0 1 0 3 0 1 2"},
                                      {"a.vtu.gz", vtu}}) {
    EXPECT_TRUE(is_mesh_name(name));
    EXPECT_GE(read_mesh(folder.write(name, gzip_of(content))).polygons.size(), 1u) << name;
  }
  EXPECT_EQ(read_map(folder.file("a.vtu.gz")).uv, read_vtu(folder.file("plain.vtu")).uv);
  EXPECT_FALSE(is_mesh_name("a.gz"));
  EXPECT_FALSE(is_mesh_name("a.svg.gz"));
}

TEST(CompressedFiles, MembersAndPaddingAreOneFile) {
  const TemporaryFolder folder;
  const std::string content =
      gzip_of(kObj.substr(0, 9)) + gzip_of("") + gzip_of(kObj.substr(9)) + std::string(100, '\0');
  EXPECT_EQ(read_whole_file(folder.write("a.obj.gz", content)), kObj);
}

TEST(CompressedFiles, LargerThanABlock) {
  std::string content = kObj;
  for (int k = 0; k < 200000; ++k) content += "v " + std::to_string(k * 7919 % 10007) + " 0 1\n";
  const TemporaryFolder folder;
  EXPECT_EQ(read_whole_file(folder.write("a.obj.gz", gzip_of(content))), content);
}

TEST(CompressedFiles, DamageIsRefused) {
  const TemporaryFolder folder;
  const std::string good = gzip_of(kObj);
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_NE(refusal(folder.write("a.obj.gz", good.substr(0, length))).find("truncated"),
              std::string::npos);
  std::string bad = good;
  bad[bad.size() - 6] ^= 1;  // the checksum
  EXPECT_NE(refusal(folder.write("a.obj.gz", bad)).find("damaged"), std::string::npos);
  refusal(folder.write("a.obj.gz", good + "x"));
  EXPECT_NE(refusal(folder.write("a.obj.gz", kObj)).find("without .gz"), std::string::npos);
}

TEST(CompressedFiles, ABombEndsWithTheMemoryItMayHave) {
  const std::string bomb = gzip_of(std::string(std::size_t{8} << 20, ' '));
  ASSERT_LT(bomb.size(), 20000u);
  ASSERT_EQ(::setenv("MAJORANT_READING_BYTES", "1000000", 1), 0);
  std::string content;
  const std::string message = error_message(ErrorKind::Unsupported, [&] {
    GunzipStream(ReadingLimit("a.obj.gz")).append(bomb, content);
  });
  EXPECT_EQ(message.find("a.obj.gz: "), 0u) << message;
  EXPECT_LT(content.size(), std::size_t{1} << 20);
  // Also without compression.
  const TemporaryFolder folder;
  const std::string path = folder.write("a.obj", std::string(1000001, ' '));
  error_message(ErrorKind::Unsupported, [&] { read_whole_file(path); });
  ::unsetenv("MAJORANT_READING_BYTES");
  EXPECT_EQ(read_whole_file(path).size(), 1000001u);
}

TEST(CompressedFiles, AByteStandsForNoMoreThanAThousand) {
  const ReadingLimit limit("a.obj.gz");
  const std::size_t most = ReadingLimit::kOnTop + 5 * ReadingLimit::kMaxExpansion;
  limit.require_unpacked(most, 5);
  limit.require_unpacked(ReadingLimit::kOnTop, 0);
  error_message(ErrorKind::Unsupported,
                [&] { limit.require_unpacked(most + ReadingLimit::kMaxExpansion, 5); });
}

TEST(CompressedFiles, StopIsPolledWhileDecompressing) {
  std::string noise(std::size_t{1} << 20, '\0');
  std::mt19937 random(5);
  for (char& c : noise) c = static_cast<char>(random());
  const TemporaryFolder folder;
  const std::string path = folder.write("a.obj.gz", gzip_of(noise));
  CountedStop stop(3);
  EXPECT_THROW(read_whole_file(path, stop.check()), Stopped);
}

TEST(CompressedFiles, VtuArrays) {
  const TemporaryFolder folder;
  MapFile map = random_strip(3, 40, 2);
  map.chart = Eigen::VectorXi::LinSpaced(40, 0, 39) / 20;
  write_vtu(folder.file("plain.vtu"), map);
  const std::string plain = content_of(folder.file("plain.vtu"));
  for (const std::size_t block : {64u, 320u, 32768u}) {
    const std::string path = folder.write("packed.vtu", compressed_vtu(plain, block));
    const MapFile read = read_vtu(path);
    EXPECT_EQ(read.points, map.points);
    EXPECT_EQ(read.uv, map.uv);
    EXPECT_EQ(read.cells, map.cells);
    EXPECT_EQ(read.chart, map.chart);
    EXPECT_EQ(read.claims, map.claims);
  }
  std::string other = compressed_vtu(plain, 64);
  other.replace(other.find("vtkZLib"), 7, "vtkLZ4x");
  EXPECT_NE(refusal(folder.write("other.vtu", other)).find("vtkLZ4x"), std::string::npos);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
