#include "majorant/maps/rest_shapes_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

RestShapes shape_of(const RestTriangle& triangle, double scale) {
  Points3 corners = Points3::Zero(3, 3);
  for (Index k = 0; k < 3; ++k) corners.row(k).head<2>() = scale * triangle.corners[k];
  Cells face(1, 3);
  face << 0, 1, 2;
  return flat_triangles(corners, face);
}

}  // namespace

RowMatrix in_frames(const SurfaceMesh& mesh, const Points3& vectors) {
  if (vectors.rows() != mesh.face_count())
    throw InvalidArgument(
        fmt::format("in_frames: {} vectors for {} faces", vectors.rows(), mesh.face_count()));
  std::vector<char> has_plane(to_size(mesh.face_count()), 1);
  for (const RestTriangle& triangle : mesh.rest_triangles()) has_plane[triangle.face] = 0;
  RowMatrix out(mesh.face_count(), 2);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    out.row(f) << 1, 0;
    if (!has_plane[f]) continue;
    if (!vectors.row(f).allFinite())
      throw InvalidArgument(fmt::format("in_frames: the vector of face {} is not finite", f));
    const auto part = tangent_part(mesh.positions(), mesh.faces(), f, vectors.row(f));
    if (!part)
      throw InvalidArgument(fmt::format("in_frames: the vector of face {} has no tangent part", f));
    out.row(f) = *part;
  }
  return out;
}

RestShapes rest_shapes(const SurfaceMesh& mesh, double scale) {
  RestShapes rest = flat_triangles(mesh.positions() * scale, mesh.faces());
  for (const RestTriangle& triangle : mesh.rest_triangles()) {
    const RestShapes one = shape_of(triangle, scale);
    rest.inverse.row(triangle.face) = one.inverse.row(0);
    rest.measure[triangle.face] = one.measure[0];
  }
  return rest;
}

RestShapes rest_shape(const SurfaceMesh& mesh, Index face) {
  const auto& all = mesh.rest_triangles();
  const auto found =
      std::lower_bound(all.begin(), all.end(), face,
                       [](const RestTriangle& triangle, Index f) { return triangle.face < f; });
  if (found != all.end() && found->face == face) return shape_of(*found, 1);
  return flat_triangles(mesh.positions(), mesh.faces().row(face));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
