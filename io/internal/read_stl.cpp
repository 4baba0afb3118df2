// STL, both encodings. Binary: 80 bytes, uint32 count, 50 bytes per facet (normal, 3 corners,
// attribute), little endian. Ascii: solid / facet / outer loop / vertex / endloop / endfacet.
// Normals are ignored: the order of the corners carries the orientation.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "majorant/framework/error.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/mesh_readers.h"
#include "majorant/io/internal/text_cursor.h"

namespace majorant {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kFacetBytes = 50;

// Joins corners with exactly equal coordinates to vertices, numbered by first appearance.
class VertexMerger {
 public:
  explicit VertexMerger(std::vector<Vector3>& positions) : positions_(positions) {}

  Index vertex(const Vector3& position) {
    Key key;
    for (std::size_t k = 0; k < 3; ++k) {
      // turns -0 into 0
      key[k] = std::bit_cast<std::uint64_t>(position[static_cast<int>(k)] + 0.0);
    }
    const auto [entry, is_new] = numbers_.try_emplace(key, static_cast<Index>(positions_.size()));
    if (is_new) positions_.push_back(position);
    return entry->second;
  }

 private:
  using Key = std::array<std::uint64_t, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t hash = 0;
      for (const std::uint64_t word : key) {
        hash = (hash ^ word) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
      }
      return static_cast<std::size_t>(hash);
    }
  };

  std::vector<Vector3>& positions_;
  std::unordered_map<Key, Index, Hash> numbers_;
};

void add_triangle(PolygonMesh& mesh, VertexMerger& merger, const std::array<Vector3, 3>& corners,
                  long record) {
  std::array<Index, 3> polygon;
  std::transform(corners.begin(), corners.end(), polygon.begin(),
                 [&merger](const Vector3& corner) { return merger.vertex(corner); });
  mesh.polygons.push_back(polygon);
  mesh.polygon_lines.push_back(record);
}

PolygonMesh read_binary_stl(const std::string& path, std::string_view content,
                            const StopCheck& stop) {
  const auto count = load_bytes<std::uint32_t>(content.data() + 80, ByteOrder::Little);
  if (content.size() != kHeaderBytes + kFacetBytes * std::size_t{count}) {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: neither ascii STL nor binary STL ({} facets announced, {} bytes); "
                            "truncated or another format",
                            path, count, content.size()));
  }
  PolygonMesh mesh;
  mesh.file = path;
  mesh.polygons.reserve(count, 3 * std::size_t{count});
  VertexMerger merger(mesh.positions);
  ByteCursor cursor(path, content.substr(kHeaderBytes), ByteOrder::Little);
  ParsedBytes parsed(content.size());
  for (long facet = 1; facet <= static_cast<long>(count); ++facet) {
    if (facet % static_cast<long>(StopCheck::kPeriod) == 0) {
      stop.poll();
      parsed.reach(content.size() - cursor.remaining());
    }
    cursor.skip(3 * sizeof(float));
    std::array<Vector3, 3> corners;
    for (Vector3& corner : corners) {
      for (int k = 0; k < 3; ++k) corner[k] = static_cast<double>(cursor.next<float>());
      if (!corner.allFinite()) {
        throw Error(
            ErrorKind::Unreadable,
            fmt::format("{}: facet {}: a coordinate is not finite; correct the file", path, facet));
      }
    }
    cursor.skip(sizeof(std::uint16_t));
    add_triangle(mesh, merger, corners, facet);
  }
  return mesh;
}

bool equals_ignoring_case(std::string_view a, std::string_view lower) {
  return std::equal(a.begin(), a.end(), lower.begin(), lower.end(), [](unsigned char x, char y) {
    return std::tolower(x) == static_cast<unsigned char>(y);
  });
}

class AsciiStlReader {
 public:
  AsciiStlReader(const std::string& path, std::string_view text, const StopCheck& stop)
      : cursor_(path, text, TextLines::Plain, stop), merger_(mesh_.positions) {
    mesh_.file = path;
  }

  PolygonMesh read() {
    std::size_t expected = 0;  // the next step in the cycle of a facet
    while (cursor_.next_line()) expected = read_line(cursor_.next_token(), expected);
    if (expected != kOutside) cursor_.fail("the last facet or endsolid is missing; truncated");
    return std::move(mesh_);
  }

 private:
  static constexpr std::array<std::string_view, 9> kCycle = {
      "solid", "facet", "outer", "vertex", "vertex", "vertex", "endloop", "endfacet", "endsolid"};
  static constexpr std::size_t kOutside = 0;
  static constexpr std::size_t kFacet = 1;

  // Returns the next expected step. After endfacet another facet or endsolid may follow.
  std::size_t read_line(std::string_view keyword, std::size_t expected) {
    if (expected == kFacet && equals_ignoring_case(keyword, "endsolid")) return kOutside;
    if (!equals_ignoring_case(keyword, kCycle[expected])) {
      cursor_.fail(fmt::format("{} where '{}' is expected; correct the file", in_quotes(keyword),
                               kCycle[expected]));
    }
    if (kCycle[expected] == "vertex") {
      Vector3& corner = corners_[expected - 3];
      for (int k = 0; k < 3; ++k) corner[k] = cursor_.next_number("coordinate");
      cursor_.require_end_of_line();
    }
    if (kCycle[expected] != "endfacet") return expected + 1;
    add_triangle(mesh_, merger_, corners_, cursor_.line());
    return kFacet;
  }

  TextCursor cursor_;
  PolygonMesh mesh_;
  VertexMerger merger_;
  std::array<Vector3, 3> corners_;
};

bool looks_binary(std::string_view content) {
  if (content.size() < kHeaderBytes) return false;
  const auto count = load_bytes<std::uint32_t>(content.data() + 80, ByteOrder::Little);
  if (content.size() == kHeaderBytes + kFacetBytes * std::size_t{count}) return true;
  const std::size_t word = content.find_first_not_of(" \t\r\n");  // binary files may begin with
                                                                  // "solid", too
  return word == std::string_view::npos || !equals_ignoring_case(content.substr(word, 5), "solid");
}

}  // namespace

PolygonMesh read_stl(const std::string& path, std::string content, const StopCheck& stop) {
  PolygonMesh mesh;
  if (looks_binary(content)) {
    mesh = read_binary_stl(path, content, stop);
  } else {
    require_text(path, content);
    mesh = AsciiStlReader(path, content, stop).read();
  }
  require_complete(mesh);
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
