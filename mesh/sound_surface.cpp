#include "majorant/mesh/sound_surface.h"

#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_validation.h"
#include "majorant/mesh/refusal.h"

namespace majorant {
namespace {

bool has_proper_faces(const SurfaceMesh& mesh) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.faces().row(f);
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) return false;
    // On an edge-manifold surface, faces with the same vertices are neighbours across all their
    // edges.
    const Index h = 3 * f, o = mesh.opposite(h);
    if (o >= 0 && mesh.opposite(h + 1) >= 0 && mesh.opposite(h + 2) >= 0 &&
        face_of(o) == face_of(mesh.opposite(h + 1)) && face_of(o) == face_of(mesh.opposite(h + 2)))
      return false;
    if (!has_clear_area(mesh.positions().row(face[0]), mesh.positions().row(face[1]),
                        mesh.positions().row(face[2])))
      return false;
  }
  return true;
}

}  // namespace

std::optional<SurfaceMesh> sound_surface(SurfaceParts parts) {
  try {
    SurfaceMesh mesh = SurfaceMesh::from_parts(std::move(parts));
    const bool is_soup = mesh.vertex_count() == mesh.half_edge_count() && mesh.face_count() > 1;
    if (!is_soup && has_proper_faces(mesh)) return mesh;
  } catch (const InvalidArgument&) {  // an edge is not manifold
  } catch (const Refusal&) {          // sheets touch
  }
  return std::nullopt;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
