// A .msh file as a list of nodes, elements and entities, whatever its version and encoding: what it
// takes to write it in another one.
//
//   const GmshDocument document = read_gmsh_document(path, text, stop);
//   text = gmsh_content(document, {GmshVersion::New, GmshEncoding::Text}, {});
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/volume_files.h"

namespace majorant {

struct GmshFormat {
  GmshVersion version;
  GmshEncoding encoding;
  bool operator==(const GmshFormat&) const = default;
};

struct GmshDocument {
  using EntityName = std::pair<int, int>;  // dimension, tag

  struct Node {
    std::int64_t tag;
    std::array<double, 3> at;
    EntityName entity{-1, 0};  // -1: the version does not say
  };
  struct Element {
    std::int64_t tag;
    int type;      // gmsh's number
    int physical;  // of 2.2; 0: none
    int entity;    // its tag
    std::size_t first_node;
  };
  struct Entity {
    std::array<double, 6> box;  // of points x, y, z alone
    std::vector<int> physicals, bounding;
  };

  GmshFormat format{};
  std::vector<Node> nodes;
  std::vector<Element> elements;
  std::vector<std::int64_t> element_nodes;  // tags, from first_node on
  std::map<EntityName, Entity> entities;    // of 4.1
  std::string physical_names;               // the section as it is, or nothing
  std::vector<std::string> others;          // what else the file has, by name
};

// What a number of gmsh's is.
int gmsh_node_count(int type);
int gmsh_dimension(int type);

// Reads the section $MeshFormat. These throw as read_volume_mesh().
GmshFormat read_gmsh_format(const std::string& path, std::string content);
GmshDocument read_gmsh_document(const std::string& path, std::string content,
                                const StopCheck& stop);

// Makes a document of a mesh: rows of points from 1, numbers of cells from 1 as they come, regions
// as entities and physical groups. Throws Error(Unsupported) for nodes that are not those of a
// lattice.
GmshDocument gmsh_document_of(const VolumeMesh& mesh);

// Nodes and elements in their order, with their tags. left_out: what that version or encoding has
// no place for here. Throws Error(Unsupported) for tags that 2.2 cannot hold.
std::string gmsh_content(const GmshDocument& document, const GmshFormat& wanted,
                         std::vector<std::string>* left_out);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
