// Makes surfaces and maps from a gmsh file: its triangles, with nodes in the order of their tags.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/gmsh_document.h"
#include "majorant/io/internal/gmsh_types.h"
#include "majorant/io/internal/mesh_readers.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/io/io.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/io/map_check.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

std::string lines_of(std::string_view name) { return fmt::format("lines of {}", name); }
std::string without_line(std::string_view name, std::int64_t tag) {
  return fmt::format("{} has no line for tag {}", name, tag);
}

// Returns 0 to size - 1 in the order of the tags.
std::vector<Index> order_of_tags(const std::vector<std::int64_t>& tags) {
  std::vector<Index> order(tags.size());
  std::iota(order.begin(), order.end(), 0);
  const auto is_before = [&](Index a, Index b) { return tags[to_size(a)] < tags[to_size(b)]; };
  if (!std::is_sorted(order.begin(), order.end(), is_before))
    std::stable_sort(order.begin(), order.end(), is_before);
  return order;
}

class GmshTriangles {
 public:
  GmshTriangles(const std::string& path, std::string content, const StopCheck& stop)
      : file_(read_gmsh_file(path, std::move(content), GmshParts::Surface, stop)),
        tags_(file_),
        nodes_(order_of_tags(document().node_tags)),
        place_(nodes_.size()) {
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      place_[to_size(nodes_[k])] = static_cast<Index>(k);
    find_triangles(stop);
    entries_[0] = entries_of(document().u, "view u");
    entries_[1] = entries_of(document().v, "view v");
  }

  int degree() const { return degree_; }
  const Cells& cells() const { return cells_; }  // #F by (n+1)(n+2)/2 nodes
  Index node_count() const { return static_cast<Index>(nodes_.size()); }
  Vector3 node(Index k) const {
    const auto at = document().node(to_size(nodes_[to_size(k)]));
    return {at[0], at[1], at[2]};
  }
  // Returns bounds of the distance between the first two decimals and these numbers.
  Vector2 rounding(Index k) const {
    const std::size_t row = to_size(nodes_[to_size(k)]);
    return {rounding_at(file_.coordinates[3 * row], document().coordinates[3 * row]),
            rounding_at(file_.coordinates[3 * row + 1], document().coordinates[3 * row + 1])};
  }

  bool has_views() const { return !document().u.tags.empty() && !document().v.tags.empty(); }
  // Reads the values of both views at the nodes, with bounds of their distance from the file's
  // decimals.
  void read_views(Points2& uv, Points2& rounding) const {
    uv.resize(node_count(), 2);
    rounding.resize(node_count(), 2);
    for (int axis = 0; axis < 2; ++axis) {
      const std::vector<double>& numbers = (axis == 0 ? document().u : document().v).numbers;
      const auto& places = axis == 0 ? file_.u : file_.v;
      for (Index k = 0; k < node_count(); ++k) {
        const std::size_t entry = to_size(entries_[to_size(axis)][to_size(k)]);
        uv(k, axis) = numbers[entry];
        rounding(k, axis) = rounding_at(places[entry], numbers[entry]);
      }
    }
  }

  // These return the input's vertex of each node and face of each cell; empty if the file lacks
  // them.
  Eigen::VectorXi input_vertices() const {
    const auto& [tags, numbers] = document().input_vertex;
    Eigen::VectorXi out(tags.empty() ? 0 : node_count());
    if (tags.empty()) return out;
    const std::vector<Index> lines =
        of_nodes(tags, lines_of(kGmshInputVertex),
                 [](std::int64_t tag) { return without_line(kGmshInputVertex, tag); });
    for (Index k = 0; k < node_count(); ++k) out[k] = numbers[to_size(lines[to_size(k)])];
    return out;
  }
  Eigen::VectorXi input_faces() const {
    const auto& [tags, numbers] = document().input_face;
    Eigen::VectorXi out(tags.empty() ? 0 : static_cast<Index>(cells_.rows()));
    if (tags.empty()) return out;
    const std::vector<Index> order = order_of_tags(tags);
    require_once(tags, order, lines_of(kGmshInputFace));
    for (Index c = 0; c < out.size(); ++c) {
      const std::int64_t tag = document().elements[triangles_[to_size(c)]].tag;
      const auto found = std::lower_bound(
          order.begin(), order.end(), tag,
          [&](Index line, std::int64_t value) { return tags[to_size(line)] < value; });
      if (found == order.end() || tags[to_size(*found)] != tag)
        refuse(without_line(kGmshInputFace, tag));
      out[c] = numbers[to_size(*found)];
    }
    return out;
  }

 private:
  const GmshDocument& document() const { return file_.document; }

  [[noreturn]] void refuse(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", file_.path, problem));
  }

  double rounding_at(const PlacedCoordinates::Place& place, double value) const {
    if (document().format.encoding == GmshEncoding::Binary) return 0;
    return decimal_rounding(std::string_view(file_.content).substr(place.begin, place.size), value);
  }

  void require_once(const std::vector<std::int64_t>& tags, const std::vector<Index>& order,
                    std::string_view what) const {
    for (std::size_t k = 1; k < order.size(); ++k)
      if (const std::int64_t tag = tags[to_size(order[k])]; tag == tags[to_size(order[k - 1])])
        refuse(fmt::format("two {} have the tag {}; correct the file", what, tag));
  }

  void find_triangles(const StopCheck& stop) {
    std::vector<std::int64_t> tags;
    CellType type;
    for (std::size_t k = 0; k < document().elements.size(); ++k) {
      const GmshDocument::Element& e = document().elements[k];
      if (k == 0 || e.type != document().elements[k - 1].type) type = *gmsh_type(e.type);
      if (type.shape != CellShape::Triangle) continue;
      degree_ = type.degree;
      triangles_.push_back(k);
      tags.push_back(e.tag);
    }
    if (triangles_.empty()) refuse("no triangles; a surface mesh is needed");
    const std::vector<Index> order = order_of_tags(tags);
    require_once(tags, order, "elements");
    const std::vector<std::size_t> found = triangles_;
    const Index size = bezier_cell_size(degree_);
    cells_.resize(static_cast<Index>(found.size()), size);
    for (std::size_t c = 0; c < found.size(); ++c) {
      stop.poll_at(c);
      const std::size_t element = triangles_[c] = found[to_size(order[c])];
      const std::size_t first = document().elements[element].first_node;
      for (Index k = 0; k < size; ++k)
        cells_(static_cast<Index>(c), k) =
            place_[to_size(tags_.row_in(element, document().element_nodes[first + to_size(k)]))];
    }
  }

  std::vector<Index> entries_of(const GmshDocument::Tagged<double>& view,
                                const std::string& name) const {
    if (view.tags.empty()) return {};
    return of_nodes(view.tags, "values of " + name, [&](std::int64_t tag) {
      return fmt::format("{} has no value for node {}", name, tag);
    });
  }

  // Returns the entries of the nodes in a list by tags, in the order of the nodes.
  template <class Missing>
  std::vector<Index> of_nodes(const std::vector<std::int64_t>& tags, const std::string& what,
                              const Missing& missing) const {
    std::vector<Index> entries(nodes_.size(), -1);
    for (std::size_t k = 0; k < tags.size(); ++k) {
      const Index row = tags_.row(tags[k]);
      if (row < 0) continue;
      Index& entry = entries[to_size(place_[to_size(row)])];
      if (entry >= 0)
        refuse(fmt::format("two {} have the tag {}; correct the file", what, tags[k]));
      entry = static_cast<Index>(k);
    }
    for (std::size_t k = 0; k < entries.size(); ++k)
      if (entries[k] < 0) refuse(missing(document().node_tags[to_size(nodes_[k])]));
    return entries;
  }

  GmshFile file_;
  GmshTags tags_;
  std::vector<Index> nodes_;                   // rows of the file, by ascending tags
  std::vector<Index> place_;                   // inverse of nodes_
  std::vector<std::size_t> triangles_;         // elements, by ascending tags
  std::array<std::vector<Index>, 2> entries_;  // entries of u and v, by node
  int degree_ = 1;
  Cells cells_;
};

// Sets the points of the surface for an image: those of the flat triangles between its corners.
void flatten(MapFile& map) {
  const auto indices = bezier_multi_indices(map.degree);
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (std::size_t k = 3; k < indices.size(); ++k) {
      Eigen::RowVector3d point = Eigen::RowVector3d::Zero();
      for (std::size_t i = 0; i < 3; ++i)
        point += indices[k][i] * map.points.row(map.cells(c, static_cast<Index>(i)));
      map.points.row(map.cells(c, static_cast<Index>(k))) = point / map.degree;
    }
}

}  // namespace

MapFile read_msh(const std::string& path, const StopCheck& stop) {
  const GmshTriangles file(path, read_whole_file(path, stop), stop);
  MapFile map;
  map.degree = file.degree();
  map.cells = file.cells();
  map.points.resize(file.node_count(), 3);
  for (Index k = 0; k < file.node_count(); ++k) map.points.row(k) = file.node(k);
  if (!file.has_views() && (map.points.col(2).array() != 0).any())
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: neither views u and v, nor nodes in the plane; no map", path));
  if (file.has_views()) {
    file.read_views(map.uv, map.uv_rounding);
    map.input_vertex = file.input_vertices();
    map.input_face = file.input_faces();
  } else {
    map.uv = map.points.leftCols<2>();
    map.uv_rounding.resize(file.node_count(), 2);
    for (Index k = 0; k < file.node_count(); ++k) map.uv_rounding.row(k) = file.rounding(k);
    flatten(map);
    map.input_vertex = Eigen::VectorXi::LinSpaced(file.node_count(), 0, file.node_count() - 1);
  }
  if (const std::string defect = map_defect(map); !defect.empty())
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path, defect));
  take_as_lagrange_nodes(map, path, stop);
  return map;
}

PolygonMesh read_gmsh_surface(const std::string& path, std::string content, const StopCheck& stop) {
  const GmshTriangles file(path, std::move(content), stop);
  Points2 uv, rounding;
  if (file.has_views()) file.read_views(uv, rounding);
  PolygonMesh mesh;
  mesh.file = path;
  std::vector<Index> vertices(to_size(file.node_count()), -1);
  for (const Index node : file.cells().leftCols<3>().reshaped()) vertices[to_size(node)] = 0;
  for (Index node = 0; node < file.node_count(); ++node) {
    if (vertices[to_size(node)] < 0) continue;
    vertices[to_size(node)] = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back(file.node(node));
    if (file.has_views()) mesh.texcoords.emplace_back(uv(node, 0), uv(node, 1));
  }
  for (Index c = 0; c < file.cells().rows(); ++c) {
    const auto corner = [&](Index k) { return vertices[to_size(file.cells()(c, k))]; };
    mesh.polygons.push_back({corner(0), corner(1), corner(2)});
  }
  if (file.has_views()) mesh.polygon_texcoords = mesh.polygons;
  require_complete(mesh);
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
