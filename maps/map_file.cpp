#include "majorant/maps/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "majorant/elements/bernstein.h"
#include "majorant/framework/error.h"
#include "majorant/framework/pair_order.h"
#include "majorant/mesh/exact_predicates.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/triangulate_polygon.h"

namespace majorant {

namespace {

bool is_positive(const PolygonMesh& mesh, std::span<const Index> texture,
                 const std::array<int, 3>& triangle) {
  const auto uv = [&](int k) { return mesh.texcoords[texture[triangle[k]]]; };
  return orientation(uv(0), uv(1), uv(2)) > 0;
}

// Returns corner numbers of the triangles of a textured polygon with more than three corners. They
// are those of its shape in space, unless these are not positive in the plane and others are.
// Programs that show the polygon may choose either.
std::vector<std::array<int, 3>> triangles_of(const PolygonMesh& mesh, std::size_t polygon) {
  const auto& corners = mesh.polygons[polygon];
  const auto& texture = mesh.polygon_texcoords[polygon];
  const auto all_positive = [&](const std::vector<std::array<int, 3>>& triangles) {
    return std::all_of(triangles.begin(), triangles.end(),
                       [&](const auto& t) { return is_positive(mesh, texture, t); });
  };
  std::vector<Vector3> in_space, in_plane;
  for (const Index v : corners) in_space.push_back(mesh.positions[v]);
  for (const Index t : texture) {
    const Vector2& uv = mesh.texcoords[t];
    in_plane.emplace_back(uv.x(), uv.y(), 0);
  }
  const auto of_shape = triangulate_polygon(in_space);
  if (all_positive(of_shape)) return of_shape;
  const auto of_image = triangulate_polygon(in_plane);
  return all_positive(of_image) ? of_image : of_shape;
}

void mark_seams(const BezierMap& map, MapFile& file) {
  const Seams& seams = map.seams();
  if (seams.trivial()) return;
  file.seam_edges = Cells::Zero(map.mesh().face_count(), 3);
  for (const SeamEdge& edge : seams.edges())
    for (const Index h : {edge.side, edge.opposite})
      file.seam_edges(face_of(h), corner_of(h)) = edge.chain + 1;
  file.cone = Eigen::VectorXi::Zero(file.points.rows());
  for (Index v = 0; v < map.mesh().vertex_count(); ++v) {
    const Index surface = seams.surface_vertex()[v];
    const int turns = seams.quarter_turns()[surface];
    if (turns != 4) file.cone[v] = turns;
  }
}

}  // namespace

MapFile to_map_file(const BezierMap& map) {
  const BezierTriangleSpace& space = map.space();
  const TriangleIndices& ix = TriangleIndices::of_degree(map.degree());
  MapFile file;
  file.degree = map.degree();
  file.cells = space.cells();
  file.points.resize(space.node_count(), 3);
  file.uv.resize(space.node_count(), 2);
  file.input_vertex = Eigen::VectorXi::Constant(space.node_count(), -1);
  file.input_face.resize(space.element_count());
  for (Index f = space.element_count() - 1; f >= 0; --f) {
    file.input_face[f] = map.mesh().input_face(f);
    for (int l = 3; l < ix.count(); ++l) {  // without the corners, which are vertices
      Vector3 point = Vector3::Zero();
      for (int k = 0; k < 3; ++k)
        point += ix.multi(l)[k] * map.mesh().input_position(map.mesh().faces()(f, k));
      file.points.row(space.cells()(f, l)) = point / map.degree();
    }
  }
  for (Index v = 0; v < space.vertex_count(); ++v) {
    file.points.row(v) = map.mesh().input_position(v);
    file.input_vertex[v] = map.mesh().input_vertex(v);
  }
  for (Index n = 0; n < space.node_count(); ++n)
    file.uv.row(n) = map.control_points().segment<2>(2 * n);
  mark_seams(map, file);
  return file;
}

MapFile to_map_file(const PolygonMesh& textured) {
  if (textured.polygon_texcoords.size() != textured.polygons.size())
    throw Refusal(ErrorKind::Unsupported, textured.file,
                  message_prefix(textured.file) + "has no texture coordinates; ", Hint::Unwrap);
  MapFile file;
  file.warnings = textured.warnings;
  file.points_rounding = textured.position_rounding;
  file.is_complete = !textured.has_partial_layout;
  std::vector<std::pair<Index, Index>> corners;  // of the cells: (vertex, texture coordinate)
  std::vector<Index> faces;
  corners.reserve(textured.polygons.indices().size());
  faces.reserve(textured.polygons.size());
  for (std::size_t p = 0; p < textured.polygons.size(); ++p) {
    const auto& polygon = textured.polygons[p];
    const auto& texture = textured.polygon_texcoords[p];
    if (texture.empty() && textured.has_partial_layout) {
      file.unmapped.push_back(polygon);
      continue;
    }
    if (texture.size() != polygon.size())
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: face {} has no texture coordinates", textured.file, p + 1));
    const auto add_cell = [&](const std::array<int, 3>& triangle) {
      for (const int k : triangle) corners.emplace_back(polygon[k], texture[k]);
      faces.push_back(static_cast<Index>(p));
    };
    if (polygon.size() == 3) {
      add_cell({0, 1, 2});
      continue;
    }
    for (const auto& triangle : triangles_of(textured, p)) add_cell(triangle);
    std::vector<Vector3> in_space;
    std::vector<Vector2> uv;
    for (const Index v : polygon) in_space.push_back(textured.positions[v]);
    for (const Index t : texture) uv.push_back(textured.texcoords[t]);
    if (!is_unfolded_cut_from(0, in_space, uv, PolygonUse::Read))
      file.folded.push_back(static_cast<Index>(p));
    else if (uv.size() == 4 && !is_unfolded_cut_from(1, in_space, uv, PolygonUse::Read))
      file.folded_otherwise.push_back(static_cast<Index>(p));
  }
  const auto [point, first] = numbered_in_order(static_cast<Index>(textured.positions.size()),
                                                static_cast<Index>(corners.size()),
                                                [&](Index corner) { return corners[corner]; });
  const auto count = static_cast<Index>(first.size());
  file.points.resize(count, 3);
  file.uv.resize(count, 2);
  if (!textured.texcoord_rounding.empty()) file.uv_rounding.resize(count, 2);
  file.input_vertex.resize(count);
  for (Index p = 0; p < count; ++p) {
    const auto& [vertex, texcoord] = corners[first[p]];
    if (file.uv_rounding.rows() > 0) file.uv_rounding.row(p) = textured.texcoord_rounding[texcoord];
    file.points.row(p) = textured.positions[vertex];
    file.uv.row(p) = textured.texcoords[texcoord];
    file.input_vertex[p] = vertex;
  }
  file.cells = Eigen::Map<const Cells>(point.data(), static_cast<Index>(faces.size()), 3);
  file.input_face = Eigen::Map<Eigen::VectorXi>(faces.data(), static_cast<Index>(faces.size()));
  return file;
}

Vec node_values(const MapFile& file, const BezierTriangleSpace& space, const std::string& name) {
  std::vector<Index> point_of(to_size(space.node_count()), -1);
  Vec x(2 * space.node_count());
  for (Index c = 0; c < file.cells.rows(); ++c)
    for (Index k = 0; k < file.cells.cols(); ++k) {
      const Index node = space.cells()(c, k), point = file.cells(c, k);
      Index& first = point_of[node];
      if (first >= 0 && file.uv.row(first) != file.uv.row(point))
        throw Error(ErrorKind::Invalid,
                    fmt::format("{}: cell {}: control point {} differs from the neighbouring "
                                "cell's: the map is not continuous there",
                                name, c, k));
      first = point;
      x.segment<2>(2 * node) = file.uv.row(point);
    }
  return x;
}

BezierMap to_bezier_map(const MapFile& file, const std::string& name) {
  PolygonMesh polygons;
  polygons.file = name;
  for (Index p = 0; p < file.points.rows(); ++p) polygons.positions.push_back(file.points.row(p));
  for (Index c = 0; c < file.cells.rows(); ++c)
    polygons.polygons.push_back({file.cells(c, 0), file.cells(c, 1), file.cells(c, 2)});
  auto mesh = std::make_shared<const SurfaceMesh>(
      SurfaceMesh::from_polygons(polygons, {}, Components::One, Shapes::Any));
  auto space =
      std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), file.degree);
  Vec x = node_values(file, *space, name);
  return BezierMap(std::move(mesh), std::move(space), std::move(x));
}

MapFile to_map_file(const BezierMesh& mesh) {
  std::map<Index, Index> number;  // vertices of the mesh -> 0, 1, ...
  for (const Index v : mesh.faces.reshaped()) number.emplace(v, 0);
  Index count = 0;
  for (auto& entry : number) entry.second = count++;
  Cells faces = mesh.faces;
  for (Index& v : faces.reshaped()) v = number.at(v);
  const LatticeNumbering nodes = number_lattice(faces, count, mesh.degree);
  MapFile file;
  file.degree = mesh.degree;
  file.cells = nodes.cells;
  file.points = Points3::Zero(nodes.node_count, 3);
  file.uv.resize(nodes.node_count, 2);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index l = 0; l < file.cells.cols(); ++l)
      file.uv.row(file.cells(f, l)) = mesh.point(f, static_cast<int>(l));
  // The surface consists of flat triangles between the corners, even where the map is curved.
  const TriangleIndices& ix = TriangleIndices::of_degree(mesh.degree);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (int l = 0; l < ix.count(); ++l) {
      Eigen::RowVector2d point = Eigen::RowVector2d::Zero();
      for (int k = 0; k < 3; ++k) point += ix.multi(l)[k] * file.uv.row(file.cells(f, k));
      file.points.row(file.cells(f, l)).head<2>() = point / mesh.degree;
    }
  return file;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
