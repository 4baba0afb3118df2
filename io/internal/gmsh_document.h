// A .msh file as lists of nodes, elements, entities and views, independent of version and encoding.
// Readers make meshes, surfaces and maps from it, and writers make it from them.
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

// Sections of our own, which other programs skip: the input's vertex of each node, and the input's
// face of each element, like the arrays of the same names in a .vtu.
inline constexpr std::string_view kGmshInputVertex = "input_vertex", kGmshInputFace = "input_face";

struct GmshDocument {
  using EntityName = std::pair<int, int>;  // dimension and tag

  struct Element {
    std::int64_t tag = 0;
    int type = 0;      // gmsh's number of the type
    int physical = 0;  // in 2.2; 0: none
    int entity = 0;    // tag of the entity
    std::size_t first_node = 0;
  };
  struct Entity {
    std::array<double, 6> box;  // for points only x, y, z
    std::vector<int> physicals, bounding;
  };
  // Values of nodes or elements, by tag.
  template <class Number>
  struct Tagged {
    std::vector<std::int64_t> tags;
    std::vector<Number> numbers;
  };

  GmshFormat format{};
  // Tags of the nodes, in the order of the file.
  std::vector<std::int64_t> node_tags;
  std::vector<double> coordinates;        // 3 for each node
  std::vector<EntityName> node_entities;  // dimension -1: unknown in this version
  std::vector<Element> elements;
  std::vector<std::int64_t> element_nodes;  // tags, from first_node on
  std::map<EntityName, Entity> entities;    // in 4.1
  std::string physical_names;               // the section verbatim; may be empty
  Tagged<double> u, v;                      // the views of a map; may be empty
  Tagged<Index> input_vertex, input_face;
  std::vector<std::string> others;  // names of other contents of the file

  std::array<double, 3> node(std::size_t k) const {
    return {coordinates[3 * k], coordinates[3 * k + 1], coordinates[3 * k + 2]};
  }
};

// A document with the places of its numbers in the file.
struct GmshFile {
  GmshFile(std::string file, std::string bytes)
      : path(std::move(file)), content(std::move(bytes)) {}

  GmshDocument document;
  std::string path, content;
  ByteOrder order = ByteOrder::Little;                      // for binary files
  std::vector<PlacedCoordinates::Place> coordinates, u, v;  // by number
  std::vector<std::size_t> lists;                           // by element: place of its first node

  // Throws Error(Unreadable) with the place of a list.
  [[noreturn]] void fail_at(std::size_t place, std::string_view problem) const;
};

// The rows of nodes by gmsh's tags.
class GmshTags {
 public:
  // Throws Error(Unreadable) for repeated tags.
  explicit GmshTags(const GmshFile& file);
  Index row(std::int64_t tag) const;  // -1: none
  // Returns the row of a node of an element. Throws Error(Unreadable) if there is none.
  Index row_in(std::size_t element, std::int64_t tag) const;

 private:
  const GmshFile& file_;
  std::vector<Index> row_;  // by tag, if tags are dense
  std::map<std::int64_t, Index> sparse_;
};

// The content to read. Surface: only points, segments and complete triangles, with the views of
// maps and the numbers of the input.
enum class GmshParts { Volume, Surface };

// Reads the whole file; content: decompressed. Throws the errors Unreadable and Unsupported of
// read_volume_mesh(); Stopped.
GmshFile read_gmsh_file(const std::string& path, std::string content, GmshParts parts,
                        const StopCheck& stop);
// Reads the section $MeshFormat alone.
GmshFormat read_gmsh_format(const std::string& path, std::string content);

// Makes a document from a mesh: points and cells numbered from 1, regions as entities and physical
// groups. Throws Error(Unsupported) for nodes that are not on a lattice.
GmshDocument gmsh_document_of(const VolumeMesh& mesh);

// Returns the file, with nodes and elements in their order and with their tags. left_out: contents
// that the version or encoding cannot hold; may be null. Throws Error(Unsupported) for tags that
// 2.2 cannot hold.
std::string gmsh_content(const GmshDocument& document, const GmshFormat& format,
                         std::vector<std::string>* left_out);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
