#include "majorant/certify/internal/patch_match.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "majorant/mesh/triangle_list.h"
#include "majorant/mesh/triangulate_polygon.h"

namespace majorant {
namespace {

std::vector<Vector3> corners_of_face(const PatchContext& context, Index face) {
  std::vector<Vector3> corners;
  for (const Index v : context.surface.polygons[face])
    corners.push_back(context.surface.positions[v]);
  return corners;
}

std::vector<Vector3> corners_of_cell(const PatchContext& context, Index cell) {
  std::vector<Vector3> corners;
  for (const Index v : context.cells.mesh.faces().row(cell))
    corners.push_back(context.cells.mesh.input_position(v));
  return corners;
}

// Returns the vertices of the surface at the corners of a cell.
std::array<Index, 3> names_of(const PatchContext& context, Index cell) {
  const auto corners = context.cells.mesh.faces().row(cell);
  return {context.surface_vertex[corners[0]], context.surface_vertex[corners[1]],
          context.surface_vertex[corners[2]]};
}

bool is_triangulated_polygon(const PatchContext& context, const CellPatch& patch) {
  if (patch.faces.size() != 1) return false;
  const auto& polygon = context.surface.polygons[patch.faces.front()];
  if (patch.cells.size() + 2 != polygon.size()) return false;
  for (const Index c : patch.cells)
    for (const Index v : names_of(context, c))
      if (std::find(polygon.begin(), polygon.end(), v) == polygon.end()) return false;
  return true;
}

// Returns whether no cell is turned over in the polygon. Either the cells are the triangles that
// SurfaceMesh makes of its shape or its texture coordinates, or all face its side.
bool is_unfolded(const PatchContext& context, const CellPatch& patch) {
  const auto& polygon = context.surface.polygons[patch.faces.front()];
  if (polygon.size() == 3) return true;
  const std::vector<Vector3> corners = corners_of_face(context, patch.faces.front());
  const Vector3 side = area_vector(corners).stableNormalized();
  std::set<std::set<Index>> usual;
  for (const auto& triangles :
       {triangulate_polygon(corners),
        triangles_of(context.surface, patch.faces.front(), Crossing::Fanned, {})})
    for (const auto& t : triangles) usual.insert({polygon[t[0]], polygon[t[1]], polygon[t[2]]});
  return std::all_of(patch.cells.begin(), patch.cells.end(), [&](Index c) {
    const std::array<Index, 3> names = names_of(context, c);
    return usual.contains({names[0], names[1], names[2]}) ||
           area_vector(corners_of_cell(context, c)).dot(side) > 0;
  });
}

double size_of(const std::vector<std::vector<Vector3>>& faces) {
  Eigen::AlignedBox3d box;
  for (const auto& corners : faces)
    for (const Vector3& p : corners) box.extend(p);
  return box.sizes().maxCoeff();
}

// Returns the fault unless both lie in one plane and have the same area.
std::string other_plane(const PatchContext& context, const CellPatch& patch) {
  const Index face = patch.faces.front();
  const double close = context.close;
  std::vector<std::vector<Vector3>> of_faces, of_cells;
  for (const Index p : patch.faces) of_faces.push_back(corners_of_face(context, p));
  for (const Index c : patch.cells) of_cells.push_back(corners_of_cell(context, c));
  Vector3 total = Vector3::Zero();
  for (const auto& corners : of_faces) total += area_vector(corners);
  if (!(total.stableNorm() > close * close))
    return fmt::format(
        "cells have other edges than the surface around face {}, where it is not flat", face);
  const Vector3 normal = total.stableNormalized(), origin = of_faces.front().front();
  double areas[2] = {0, 0};
  for (const auto* list : {&of_faces, &of_cells})
    for (const auto& corners : *list) {
      for (const Vector3& p : corners)
        if (!(std::abs(normal.dot(p - origin)) <= close))
          return fmt::format("cells leave the plane of face {} of the surface", face);
      const double area = area_vector(corners).dot(normal);
      if (!(area >= -close * close))
        return fmt::format(
            "a cell is turned over around face {} of the surface, or that is not "
            "flat",
            face);
      areas[list == &of_cells] += area;
    }
  if (!(std::abs(areas[0] - areas[1]) <= kTenDigits * areas[0] + close * size_of(of_faces)))
    return fmt::format("cells cover {:.9g} of the area {:.9g} around face {} of the surface",
                       areas[1], areas[0], face);
  return {};
}

}  // namespace

std::string compare_patch(const PatchContext& context, const CellPatch& patch,
                          SurfaceMatch& match) {
  const std::vector<Index>& labels = context.cells.face;
  for (const Index c : patch.cells) {
    if (labels.empty()) break;
    if (std::find(patch.faces.begin(), patch.faces.end(), labels[c]) == patch.faces.end())
      return fmt::format("cell {} is said to belong to face {} of the surface and lies in face {}",
                         context.cells.mesh.input_face(c), labels[c], patch.faces.front());
  }
  if (is_triangulated_polygon(context, patch)) {
    if (!is_unfolded(context, patch))
      return fmt::format("a cell is turned over in face {} of the surface", patch.faces.front());
    ++match.same;
    return {};
  }
  match.changed += static_cast<Index>(patch.faces.size());
  return other_plane(context, patch);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
