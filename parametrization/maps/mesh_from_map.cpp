#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "majorant/framework/error.h"
#include "majorant/parametrization/maps/map_file.h"

namespace majorant {
namespace {

// Vertices without a cell may exist, up to this number of a vertex, or this many times the points
// of the file. Memory that a damaged file may ask for, 100 MB; chosen, not tuned.
constexpr long long kUnsuspicious = 1LL << 22;
constexpr long long kUnsuspiciousTimes = 4;

// Returns whether the numbers of the input mesh are known for every corner of every cell.
bool knows_input_vertices(const MapFile& map) {
  if (map.input_vertex.size() != map.points.rows()) return false;
  for (const Index point : map.cells.leftCols<3>().reshaped()) {
    if (map.input_vertex[point] < 0) return false;
  }
  return true;
}

// For every map point the mesh vertex it is, for corner points; -1 for others.
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

// Cells in the order of the input's faces where that is known.
std::vector<Index> order_cells(const MapFile& map) {
  std::vector<Index> order(static_cast<std::size_t>(map.cells.rows()));
  std::iota(order.begin(), order.end(), 0);
  if (map.input_face.size() == map.cells.rows() && map.input_face.minCoeff() >= 0) {
    std::stable_sort(order.begin(), order.end(),
                     [&map](Index a, Index b) { return map.input_face[a] < map.input_face[b]; });
  }
  return order;
}

}  // namespace

std::vector<Vector3> vertex_positions(const MapFile& file,
                                      const Eigen::Ref<const Eigen::VectorXi>& vertex,
                                      const std::string& name) {
  const auto corners = file.cells.leftCols<3>();
  const Index largest = vertex(corners.reshaped()).maxCoeff();
  if (largest > std::max<long long>(kUnsuspicious, kUnsuspiciousTimes * file.points.rows()))
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

PolygonMesh mesh_from_map(const MapFile& map, const std::string& file) {
  PolygonMesh mesh;
  mesh.file = file;
  const std::vector<Index> vertices = number_vertices(map);
  mesh.positions = vertex_positions(
      map, Eigen::Map<const Eigen::VectorXi>(vertices.data(), map.points.rows()), file);
  std::vector<Index> texcoords(vertices.size(), -1);  // of a map point
  for (std::size_t p = 0; p < vertices.size(); ++p) {
    if (vertices[p] < 0) continue;
    texcoords[p] = static_cast<Index>(mesh.texcoords.size());
    mesh.texcoords.emplace_back(map.uv.row(static_cast<Eigen::Index>(p)).transpose());
  }
  for (const Index cell : order_cells(map)) {
    std::vector<Index> polygon(3);
    std::vector<Index> polygon_texcoords(3);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto point = to_size(map.cells(cell, static_cast<Index>(k)));
      polygon[k] = vertices[point];
      polygon_texcoords[k] = texcoords[point];
    }
    mesh.polygons.push_back(std::move(polygon));
    mesh.polygon_texcoords.push_back(std::move(polygon_texcoords));
    mesh.polygon_lines.push_back(long{cell} + 1);
  }
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
