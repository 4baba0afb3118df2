#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <optional>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/cell_collector.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/source_file.h"
#include "majorant/io/internal/text_cursor.h"

namespace majorant {
namespace {

// Returns the type of a section of cells. At degree 2 the nodes of edges follow the corners in
// VTK's order.
std::optional<CellType> medit_type(std::string_view keyword) {
  using enum CellShape;
  static const std::map<std::string_view, CellType> kTypes{{"Edges", {Segment, 1}},
                                                           {"EdgesP2", {Segment, 2}},
                                                           {"Triangles", {Triangle, 1}},
                                                           {"TrianglesP2", {Triangle, 2}},
                                                           {"Quadrilaterals", {Quad, 1}},
                                                           {"Tetrahedra", {Tetrahedron, 1}},
                                                           {"TetrahedraP2", {Tetrahedron, 2}},
                                                           {"Prisms", {Wedge, 1}},
                                                           {"Hexahedra", {Hexahedron, 1}}};
  const auto found = kTypes.find(keyword);
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

// Returns the number of numbers per entry in sections that do not concern cells.
std::optional<int> other_entries(std::string_view keyword, int dim) {
  static const std::map<std::string_view, int> kSizes{{"Corners", 1},
                                                      {"Ridges", 1},
                                                      {"RequiredVertices", 1},
                                                      {"RequiredEdges", 1},
                                                      {"RequiredTriangles", 1},
                                                      {"RequiredQuadrilaterals", 1},
                                                      {"RequiredTetrahedra", 1},
                                                      {"ParallelVertices", 1},
                                                      {"NormalAtVertices", 2},
                                                      {"TangentAtVertices", 2}};
  if (keyword == "Normals" || keyword == "Tangents") return dim;
  const auto found = kSizes.find(keyword);
  return found == kSizes.end() ? std::nullopt : std::optional(found->second);
}

class MeditReader {
 public:
  MeditReader(const std::string& path, std::string content, const StopCheck& stop)
      : path_(path), content_(std::move(content)), in_(path_, content_, TextLines::Space, stop) {}

  VolumeMesh read() {
    if (in_.next_token() != "MeshVersionFormatted") in_.fail("not a mesh of Medit");
    in_.next_integer("the version");
    for (;;) {
      const std::string keyword(in_.next_token());
      if (keyword.empty() || keyword == "End") break;
      if (std::isalpha(static_cast<unsigned char>(keyword[0])) == 0)
        in_.fail(
            fmt::format("{} where the name of a section should be; the entries before it are "
                        "more than their number says, or of another degree",
                        in_quotes(keyword)));
      read_section(keyword);
    }
    if (points_.empty()) in_.fail("no vertices; not a mesh, or truncated");
    VolumeMesh mesh;
    mesh.file = path_;
    mesh.points =
        Eigen::Map<const Points3>(points_.data(), static_cast<Index>(points_.size() / 3), 3);
    NodeLists lists{.coding = NodeLists::Coding::Words, .blocks = cells_.lists()};
    mesh.blocks = cells_.take();
    for (const CellBlock& block : mesh.blocks)
      if (block.size() > 0 && block.nodes.maxCoeff() >= mesh.points.rows())
        throw Error(ErrorKind::Unreadable,
                    fmt::format("{}: {} have vertex {}, there are {}", path_, describe(block.type),
                                block.nodes.maxCoeff() + 1, mesh.points.rows()));
    if (mesh.blocks.empty()) in_.fail("no cells; not a mesh, or truncated");
    mesh.source = std::make_shared<const PlacedCoordinates>(path_, std::move(content_), mesh.points,
                                                            std::move(lists), std::move(places_),
                                                            PlacedCoordinates::Coding::Words);
    return mesh;
  }

 private:
  void read_section(const std::string& keyword) {
    if (keyword == "Dimension") {
      dim_ = static_cast<int>(in_.next_integer("the dimension"));
      if (dim_ != 2 && dim_ != 3) in_.fail(fmt::format("dimension {}", dim_));
    } else if (keyword == "Vertices") {
      read_vertices();
    } else if (const std::optional<CellType> type = medit_type(keyword)) {
      read_cells(*type);
    } else if (const std::optional<int> size = other_entries(keyword, dim_)) {
      const std::int64_t count = in_.next_count("the number of " + keyword);
      for (std::int64_t k = 0; k < count * *size; ++k) in_.next_number("an entry");
    } else {
      refuse_mesh(path_, fmt::format("a section {}; tetrahedra and triangles of degrees 1 and 2, "
                                     "hexahedra, prisms and quads of degree 1 are supported",
                                     in_quotes(keyword)));
    }
  }

  void read_vertices() {
    if (!points_.empty()) in_.fail("a second section Vertices");
    const std::int64_t count = in_.next_count("the number of vertices");
    for (std::int64_t v = 0; v < count; ++v) {
      for (int c = 0; c < 3; ++c) {
        points_.push_back(c < dim_ ? in_.next_number("a coordinate") : 0);
        places_.emplace_back();
        if (c < dim_)
          places_.back() = {in_.begin(), static_cast<std::uint32_t>(in_.place() - in_.begin())};
      }
      in_.next_integer("a reference");
    }
  }

  void read_cells(const CellType& type) {
    const std::int64_t count = in_.next_count("the number of cells");
    std::vector<int> order;
    for (int k = 0; k < type.node_count(); ++k) order.push_back(k);
    std::vector<Index> nodes(order.size());
    for (std::int64_t cell = 1; cell <= count; ++cell) {
      std::size_t place = 0;
      for (Index& node : nodes) {
        const std::int64_t vertex = in_.next_integer("a vertex");
        if (vertex < 1 || vertex > std::numeric_limits<Index>::max() / 4)
          in_.fail(fmt::format("vertex {} is out of range", vertex));
        node = static_cast<Index>(vertex - 1);
        if (&node == nodes.data()) place = in_.begin();
      }
      cells_.add(type, order, nodes, cell, static_cast<int>(in_.next_integer("a reference")),
                 place);
    }
  }

  const std::string& path_;
  std::string content_;
  TextCursor in_;
  int dim_ = 3;
  std::vector<double> points_;
  std::vector<PlacedCoordinates::Place> places_;
  CellCollector cells_;
};

}  // namespace

VolumeMesh read_medit_mesh(const std::string& path, std::string content, const StopCheck& stop) {
  return MeditReader(path, std::move(content), stop).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
