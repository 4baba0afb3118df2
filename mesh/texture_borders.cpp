#include "majorant/mesh/texture_borders.h"

namespace majorant {

bool is_textured(const SurfaceMesh& mesh, Index face) {
  return mesh.texcoord_ids().rows() > 0 && mesh.texcoord_ids()(face, 0) >= 0;
}

Index untextured_polygons(const SurfaceMesh& mesh) {
  Index count = 0;
  for (Index f = 0; f < mesh.face_count(); ++f)  // triangles of a polygon follow each other
    count += !is_textured(mesh, f) && (f == 0 || mesh.input_face(f) != mesh.input_face(f - 1));
  return count;
}

std::vector<char> texture_borders(const SurfaceMesh& mesh) {
  const auto id = [&](Index corner) {
    return mesh.texcoord_ids()(face_of(corner), corner_of(corner));
  };
  const auto value = [&](Index corner) {
    return Vector2(mesh.corner_texcoords().row(face_of(corner)).segment<2>(2 * corner_of(corner)));
  };
  std::vector<char> by_id(to_size(mesh.half_edge_count()), 0), by_value = by_id;
  bool any_shared = false;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    if (o < 0) continue;
    const bool is_one = is_textured(mesh, face_of(h)), is_other = is_textured(mesh, face_of(o));
    if (!is_one || !is_other) {
      by_id[h] = by_value[h] = is_one != is_other;
      continue;
    }
    by_id[h] = id(h) != id(next(o)) || id(next(h)) != id(o);
    by_value[h] = value(h) != value(next(o)) || value(next(h)) != value(o);
    const bool is_inside = mesh.input_face(face_of(h)) == mesh.input_face(face_of(o));
    any_shared = any_shared || (!by_id[h] && !is_inside);
  }
  return any_shared ? by_id : by_value;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
