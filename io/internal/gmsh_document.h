// A .msh file as lists of nodes, elements, entities and views, whatever its version and encoding.
// Meshes, surfaces and maps are views of one; a writer makes one of each.
//
//   const GmshFile file = read_gmsh_file(path, text, GmshParts::Volume, stop);
//   text = gmsh_content(file.document, {GmshVersion::New, GmshEncoding::Text}, nullptr);
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/internal/source_file.h"
#include "majorant/io/volume_files.h"

namespace majorant {

struct GmshFormat {
  GmshVersion version;
  GmshEncoding encoding;
  bool operator==(const GmshFormat&) const = default;
};

// Sections of our own, which other programs pass over: of every node the vertex, of every element
// the face of the input that it is, as the arrays of the same names in a .vtu.
inline constexpr std::string_view kGmshInputVertex = "input_vertex", kGmshInputFace = "input_face";

struct GmshDocument {
  using EntityName = std::pair<int, int>;  // dimension, tag

  struct Element {
    std::int64_t tag = 0;
    int type = 0;      // gmsh's number
    int physical = 0;  // of 2.2; 0: none
    int entity = 0;    // its tag
    std::size_t first_node = 0;
  };
  struct Entity {
    std::array<double, 6> box;  // of points x, y, z alone
    std::vector<int> physicals, bounding;
  };
  // Numbers of nodes or elements, by their tags.
  template <class Number>
  struct Tagged {
    std::vector<std::int64_t> tags;
    std::vector<Number> numbers;
  };

  GmshFormat format{};
  // The nodes, in the order of the file.
  std::vector<std::int64_t> node_tags;
  std::vector<double> coordinates;        // 3 each
  std::vector<EntityName> node_entities;  // dimension -1: the version does not say
  std::vector<Element> elements;
  std::vector<std::int64_t> element_nodes;  // tags, from first_node on
  std::map<EntityName, Entity> entities;    // of 4.1
  std::string physical_names;               // the section as it is, or nothing
  Tagged<double> u, v;                      // the views of a map; empty: not there
  Tagged<Index> input_vertex, input_face;
  std::vector<std::string> others;  // what else the file has, by name

  std::array<double, 3> node(std::size_t k) const {
    return {coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]};
  }
};

// A document and where its file has the numbers.
struct GmshFile {
  GmshFile(std::string file, std::string bytes)
      : path(std::move(file)), content(std::move(bytes)) {}

  GmshDocument document;
  std::string path, content;
  ByteOrder order = ByteOrder::Little;                      // of a binary file
  std::vector<PlacedCoordinates::Place> coordinates, u, v;  // of each number
  std::vector<std::size_t> lists;                           // of each element: of its first node

  // Throws Error(Unreadable) with the place of a list.
  [[noreturn]] void fail_at(std::size_t place, std::string_view problem) const;
};

// The rows of nodes by gmsh's tags.
class GmshTags {
 public:
  // Throws Error(Unreadable) for a tag that comes twice.
  explicit GmshTags(const GmshFile& file);
  Index row(std::int64_t tag) const;  // -1: none
  // The row of a node of an element. Throws Error(Unreadable) where there is none.
  Index row_in(std::size_t element, std::int64_t tag) const;

 private:
  const GmshFile& file_;
  std::vector<Index> row_;  // by tag, where these are dense
  std::map<std::int64_t, Index> sparse_;
};

// The kind of content that is read. A surface has points, segments and complete triangles alone;
// views of maps and the numbers of the input are read with it.
enum class GmshParts { Volume, Surface };

// The whole file; content: decompressed. Throws Error(Unreadable), Error(Unsupported) as
// read_volume_mesh(); Stopped.
GmshFile read_gmsh_file(const std::string& path, std::string content, GmshParts parts,
                        const StopCheck& stop);
// The section $MeshFormat alone.
GmshFormat read_gmsh_format(const std::string& path, std::string content);

// Makes a document of a mesh: rows of points from 1, numbers of cells from 1 as they come, regions
// as entities and physical groups. Throws Error(Unsupported) for nodes that are not those of a
// lattice.
GmshDocument gmsh_document_of(const VolumeMesh& mesh);

// Nodes and elements in their order, with their tags. left_out: what that version or encoding has
// no place for here; may be null. Throws Error(Unsupported) for tags that 2.2 cannot hold.
std::string gmsh_content(const GmshDocument& document, const GmshFormat& wanted,
                         std::vector<std::string>* left_out);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
