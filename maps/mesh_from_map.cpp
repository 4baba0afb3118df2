#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/maps/corner_mesh.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

// The largest plausible vertex number is the larger of this number and this many times the points
// of the file, since vertices without a cell may exist. It bounds the memory that a damaged file
// requests to 100 MB. Not tuned.
constexpr long long kPlausibleVertices = 1LL << 22;
constexpr long long kPlausibleVerticesPerPoint = 4;

// Returns whether the numbers of the input mesh are known for every corner of every cell.
bool knows_input_vertices(const MapFile& map) {
  if (map.input_vertex.size() != map.points.rows()) return false;
  for (const Index point : map.cells.leftCols<3>().reshaped()) {
    if (map.input_vertex[point] < 0) return false;
  }
  return true;
}

// Returns the mesh vertex of every map point that is a corner point; -1 for others.
std::vector<Index> number_vertices(const MapFile& map) {
  const auto points = static_cast<std::size_t>(map.points.rows());
  std::vector<Index> vertices(points, -1);
  const bool keep_numbers = knows_input_vertices(map);
  for (const Index point : map.cells.leftCols<3>().reshaped()) {
    vertices[point] = keep_numbers ? map.input_vertex[point] : 0;
  }
  if (!keep_numbers) {
    Index next = 0;
    for (Index& vertex : vertices) {
      if (vertex == 0) vertex = next++;
    }
  }
  return vertices;
}

// Returns the cells in the order of the input's faces, if that is known.
std::vector<Index> order_cells(const MapFile& map) {
  std::vector<Index> order(static_cast<std::size_t>(map.cells.rows()));
  std::iota(order.begin(), order.end(), 0);
  const Eigen::VectorXi& face = map.input_face;
  if (face.size() == map.cells.rows() && face.minCoeff() >= 0 &&
      !std::is_sorted(face.begin(), face.end()))
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return face[a] < face[b]; });
  return order;
}

// Joins corner points that are one point of the map: at the same end of an edge whose inner points
// two cells share.
UnionFind united_corners(const MapFile& map) {
  UnionFind united(map.points.rows());
  const int inner = map.degree - 1;  // points inside of an edge
  std::vector<Index> half_edge_at(static_cast<std::size_t>(map.points.rows()), -1);
  const auto end = [&](Index half_edge, Index k) {
    return map.cells(half_edge / 3, (half_edge % 3 + k) % 3);
  };
  const auto unite_if_equal = [&](Index a, Index b) {
    if (map.points.row(a) == map.points.row(b) && map.uv.row(a) == map.uv.row(b)) united.join(a, b);
  };
  for (Index h = 0; inner > 0 && h < 3 * map.cells.rows(); ++h) {
    const Index first = 3 + h % 3 * inner;
    const Index node = std::min(map.cells(h / 3, first), map.cells(h / 3, first + inner - 1));
    Index& other = half_edge_at[to_size(node)];
    if (other < 0) {
      other = h;
      continue;
    }
    for (const Index k : {0, 1}) {  // neighbours run the other way
      unite_if_equal(end(h, k), end(other, 1 - k));
      unite_if_equal(end(h, k), end(other, k));
    }
  }
  return united;
}

}  // namespace

Cells united_cells(const MapFile& map) {
  UnionFind united = united_corners(map);
  Cells cells = map.cells;
  for (Index& point : cells.leftCols<3>().reshaped()) point = united.find(point);
  return cells;
}

std::vector<Vector3> vertex_positions(const MapFile& file,
                                      const Eigen::Ref<const Eigen::VectorXi>& vertex,
                                      const std::string& name) {
  const auto corners = file.cells.leftCols<3>();
  const Index largest = vertex(corners.reshaped()).maxCoeff();
  if (largest >
      std::max<long long>(kPlausibleVertices, kPlausibleVerticesPerPoint * file.points.rows()))
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: input_vertex {} in a map of {} points; damaged file", name,
                            largest, file.points.rows()));
  std::vector<Vector3> positions(to_size(largest) + 1, file.points.row(corners(0, 0)));
  std::vector<char> is_placed(positions.size(), 0);
  for (const Index point : corners.reshaped<Eigen::RowMajor>()) {
    const Vector3 position = file.points.row(point);
    const auto v = to_size(vertex[point]);
    if (is_placed[v] && positions[v] != position)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: input_vertex {} is at two places; damaged file", name, v));
    positions[v] = position;
    is_placed[v] = 1;
  }
  return positions;
}

CornerMesh corner_mesh(const MapFile& map, const std::string& file) {
  CornerMesh mesh;
  const std::vector<Index> vertices = number_vertices(map);
  mesh.positions = vertex_positions(
      map, Eigen::Map<const Eigen::VectorXi>(vertices.data(), map.points.rows()), file);
  const Cells united = united_cells(map);
  std::vector<Index> texcoords(vertices.size(), -1);  // of a map point
  for (const Index point : united.leftCols<3>().reshaped()) texcoords[point] = 0;
  mesh.texcoords.reserve(vertices.size());
  for (std::size_t p = 0; p < texcoords.size(); ++p) {
    if (texcoords[p] < 0) continue;
    texcoords[p] = static_cast<Index>(mesh.texcoords.size());
    mesh.texcoords.emplace_back(map.uv.row(static_cast<Eigen::Index>(p)).transpose());
  }
  mesh.cell = order_cells(map);
  const auto count = static_cast<Index>(mesh.cell.size());
  mesh.vertices.resize(count, 3);
  mesh.texcoord_ids.resize(count, 3);
  for (Index t = 0; t < count; ++t)
    for (Index k = 0; k < 3; ++k) {
      mesh.vertices(t, k) = vertices[map.cells(mesh.cell[t], k)];
      mesh.texcoord_ids(t, k) = texcoords[united(mesh.cell[t], k)];
    }
  return mesh;
}

PolygonMesh mesh_from_map(const MapFile& map, const std::string& file) {
  CornerMesh corners = corner_mesh(map, file);
  PolygonMesh mesh;
  mesh.file = file;
  mesh.positions = std::move(corners.positions);
  mesh.texcoords = std::move(corners.texcoords);
  for (std::size_t t = 0; t < corners.cell.size(); ++t) {
    const auto row = static_cast<Index>(t);
    const auto add = [row](const Cells& cells, IndexLists& lists) {
      lists.push_back({cells(row, 0), cells(row, 1), cells(row, 2)});
    };
    add(corners.vertices, mesh.polygons);
    add(corners.texcoord_ids, mesh.polygon_texcoords);
    mesh.polygon_lines.push_back(long{corners.cell[t]} + 1);
  }
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
