// Byte counts of files: read, parsed, written.
#include "majorant/io/files/byte_counts.h"

#include "io_test_helpers.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/read_mesh.h"

namespace majorant {
namespace {

// Returns a strip of `triangles` triangles as OBJ.
std::string strip(int triangles) {
  std::string text;
  for (int k = 0; k < triangles + 2; ++k)
    text += "v " + std::to_string(k) + " " + std::to_string(k % 2) + " 0\n";
  for (int k = 1; k <= triangles; ++k)
    text += "f " + std::to_string(k) + " " + std::to_string(k + 1 + k % 2) + " " +
            std::to_string(k + 2 - k % 2) + "\n";
  return text;
}

TEST(ByteCounts, GrowWithFiles) {
  const TemporaryFolder folder;
  const std::string path = folder.file("strip.obj"), text = strip(20000);
  ASSERT_GT(text.size(), ParsedBytes::kLeast);
  const ByteCounts& counts = byte_counts();
  const auto written = counts.written.load(), to_read = counts.to_read.load(),
             read = counts.read.load(), to_parse = counts.to_parse.load(),
             parsed = counts.parsed.load();
  write_file_atomically(path, text);
  EXPECT_EQ(counts.written - written, text.size());
  EXPECT_EQ(counts.read, read);
  EXPECT_EQ(read_mesh(path).polygons.size(), 20000u);
  EXPECT_EQ(counts.written - written, text.size());
  EXPECT_EQ(counts.to_read - to_read, text.size());
  EXPECT_EQ(counts.read - read, text.size());
  EXPECT_EQ(counts.to_parse - to_parse, text.size());
  EXPECT_EQ(counts.parsed - parsed, text.size());
}

TEST(ByteCounts, UnparsedBytesAreSubtracted) {
  const auto to_parse = byte_counts().to_parse.load(), parsed = byte_counts().parsed.load();
  {
    ParsedBytes bytes(2 * ParsedBytes::kLeast);
    bytes.reach(ParsedBytes::kLeast);
    ParsedBytes ahead = bytes;  // NOLINT: a copy counts nothing
    ahead.reach(2 * ParsedBytes::kLeast);
    ParsedBytes small(9);
    small.reach(9);
  }
  EXPECT_EQ(byte_counts().to_parse - to_parse, ParsedBytes::kLeast);
  EXPECT_EQ(byte_counts().parsed - parsed, ParsedBytes::kLeast);
}

TEST(ByteCounts, BytesAreFormattedWithUnits) {
  EXPECT_EQ(bytes_text(999), "999 bytes");
  EXPECT_EQ(bytes_text(12345), "12.3 kB");
  EXPECT_EQ(bytes_text(61000000), "61 MB");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
