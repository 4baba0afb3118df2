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
#include <vector>

#include "majorant/framework/argument_check.h"
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
//
// The table has a power of two of slots, at most half of them used. A corner is in the first slot
// from its hash on that has its coordinates.
class VertexMerger {
 public:
  explicit VertexMerger(std::vector<Vector3>& positions) : positions_(positions) {}

  // Makes room for so many vertices.
  void reserve(std::size_t vertices) {
    positions_.reserve(vertices);
    if (2 * vertices > slots_.size()) resize(std::bit_ceil(2 * vertices));
  }

  static std::uint64_t hash_of(const Vector3& position) {
    std::uint64_t hash = 0;
    for (int k = 0; k < 3; ++k) {
      // turns -0 into 0
      hash = (hash ^ std::bit_cast<std::uint64_t>(position[k] + 0.0)) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 32;
    }
    return hash;
  }

  // Loads the slot of a corner that is about to come.
  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & mask()]); }

  Index vertex(const Vector3& position, std::uint64_t hash) {
    if (2 * positions_.size() >= slots_.size()) resize(2 * slots_.size());
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    std::uint64_t at = hash & mask();
    for (; slots_[at].vertex >= 0; at = (at + 1) & mask())
      if (slots_[at].tag == tag && positions_[slots_[at].vertex] == position)
        return slots_[at].vertex;
    slots_[at] = {counted("vertices", positions_.size()), tag};
    positions_.push_back(position);
    return slots_[at].vertex;
  }

 private:
  struct Slot {
    Index vertex = -1;
    std::uint32_t tag = 0;  // upper bits of the hash
  };

  std::uint64_t mask() const { return slots_.size() - 1; }

  void resize(std::size_t size) {
    slots_.assign(size, {});
    for (std::size_t v = 0; v < positions_.size(); ++v) {
      const std::uint64_t hash = hash_of(positions_[v]);
      std::uint64_t at = hash & mask();
      while (slots_[at].vertex >= 0) at = (at + 1) & mask();
      slots_[at] = {static_cast<Index>(v), static_cast<std::uint32_t>(hash >> 32)};
    }
  }

  std::vector<Vector3>& positions_;
  std::vector<Slot> slots_ = std::vector<Slot>(std::size_t{1} << 10);
};

using Corners = std::array<Vector3, 3>;

// Corners of several facets, whose slots are loaded before they are looked up.
class FacetMerger {
 public:
  explicit FacetMerger(PolygonMesh& mesh) : mesh_(mesh), vertices_(mesh.positions) {}

  // Makes room for the facets of a closed surface, which has half as many vertices.
  void reserve(std::size_t facets) {
    mesh_.polygons.reserve(facets, 3 * facets);
    mesh_.polygon_lines.reserve(facets);
    vertices_.reserve(facets / 2 + 2);
  }

  void add(const Corners& corners, long record) {
    Waiting& facet = waiting_[count_++];
    facet.corners = corners;
    facet.record = record;
    for (std::size_t k = 0; k < 3; ++k) {
      facet.hashes[k] = VertexMerger::hash_of(corners[k]);
      vertices_.prefetch(facet.hashes[k]);
    }
    if (count_ == waiting_.size()) flush();
  }

  // Call it after the last facet.
  void flush() {
    for (std::size_t f = 0; f < count_; ++f) {
      const Waiting& facet = waiting_[f];
      std::array<Index, 3> polygon;
      for (std::size_t k = 0; k < 3; ++k)
        polygon[k] = vertices_.vertex(facet.corners[k], facet.hashes[k]);
      mesh_.polygons.push_back(polygon);
      mesh_.polygon_lines.push_back(facet.record);
    }
    count_ = 0;
  }

 private:
  struct Waiting {
    Corners corners;
    std::array<std::uint64_t, 3> hashes;
    long record = 0;
  };

  PolygonMesh& mesh_;
  VertexMerger vertices_;
  std::array<Waiting, 32> waiting_;
  std::size_t count_ = 0;
};

PolygonMesh read_binary_stl(const std::string& path, std::string_view content,
                            const StopCheck& stop) {
  const auto count = load_bytes<std::uint32_t>(content.data() + 80, ByteOrder::Little);
  if (content.size() != kHeaderBytes + kFacetBytes * std::size_t{count}) {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: neither ascii STL nor binary STL ({} facets announced, {} bytes); "
                            "truncated or another format",
                            path, count, content.size()));
  }
  counted("facets", count, 3);
  PolygonMesh mesh;
  mesh.file = path;
  FacetMerger merger(mesh);
  merger.reserve(count);
  const char* at = content.data() + kHeaderBytes;
  ParsedBytes parsed(content.size());
  for (long facet = 1; facet <= static_cast<long>(count); ++facet) {
    if (facet % static_cast<long>(StopCheck::kPeriod) == 0) {
      stop.poll();
      parsed.reach(static_cast<std::size_t>(at - content.data()));
    }
    Corners corners;
    const char* coordinate = at + 3 * sizeof(float);  // behind the normal
    for (Vector3& corner : corners) {
      for (int k = 0; k < 3; ++k, coordinate += sizeof(float))
        corner[k] = static_cast<double>(load_bytes<float>(coordinate, ByteOrder::Little));
      if (!corner.allFinite()) {
        throw Error(
            ErrorKind::Unreadable,
            fmt::format("{}: facet {}: a coordinate is not finite; correct the file", path, facet));
      }
    }
    merger.add(corners, facet);
    at += kFacetBytes;
  }
  merger.flush();
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
      : cursor_(path, text, TextLines::Plain, stop), merger_(mesh_) {
    mesh_.file = path;
  }

  PolygonMesh read() {
    std::size_t expected = 0;  // the next step in the cycle of a facet
    while (cursor_.next_line()) expected = read_line(cursor_.next_token(), expected);
    if (expected != kOutside) cursor_.fail("the last facet or endsolid is missing; truncated");
    merger_.flush();
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
    merger_.add(corners_, cursor_.line());
    return kFacet;
  }

  TextCursor cursor_;
  PolygonMesh mesh_;
  FacetMerger merger_;
  Corners corners_;
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
