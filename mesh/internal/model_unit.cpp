#include "majorant/mesh/internal/model_unit.h"

#include <cmath>
#include <utility>

namespace majorant {
namespace {

// Extents between 2^-100 and 2^100 are ordinary. Origin: products of eight lengths, squares of
// squared areas, stay in the range of doubles, 2^-1022 to 2^1024.
constexpr int kOrdinary = 100;

}  // namespace

double model_unit(const SurfaceMesh& mesh) {
  const Points3& p = mesh.positions();
  const double extent =
      p.rows() == 0 ? 0 : (p.colwise().maxCoeff() - p.colwise().minCoeff()).maxCoeff();
  if (!(extent > 0) || !std::isfinite(extent)) return 1;
  const int exponent = std::ilogb(extent);
  return std::abs(exponent) <= kOrdinary ? 1 : std::ldexp(1.0, exponent);
}

std::shared_ptr<const SurfaceMesh> in_units(const SurfaceMesh& mesh, double unit) {
  SurfaceParts parts;
  parts.file = mesh.file();
  parts.origin = mesh.origin() / unit;
  parts.positions = mesh.positions() / unit;
  parts.faces = mesh.faces();
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    parts.input_vertex.push_back(mesh.input_vertex(v));
  for (Index f = 0; f < mesh.face_count(); ++f) parts.input_face.push_back(mesh.input_face(f));
  parts.corner_texcoords = mesh.corner_texcoords();
  parts.texcoord_ids = mesh.texcoord_ids();
  parts.rest_triangles = mesh.rest_triangles();
  for (RestTriangle& rest : parts.rest_triangles)
    for (Vector2& corner : rest.corners) corner /= unit;
  return std::make_shared<const SurfaceMesh>(SurfaceMesh::from_parts(std::move(parts)));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
