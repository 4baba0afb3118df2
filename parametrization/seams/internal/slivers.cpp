#include "majorant/parametrization/seams/internal/slivers.h"

#include <algorithm>
#include <optional>

#include "majorant/mesh/mesh_validation.h"
#include "majorant/parametrization/seams/internal/cut_costs.h"
#include "majorant/parametrization/seams/internal/flattening_strain.h"
#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

bool face_has_area(const SurfaceMesh& mesh, Index face) {
  const auto corner = [&](Index k) -> Vector3 {
    return mesh.positions().row(mesh.faces()(face, k));
  };
  return has_area(corner(0), corner(1), corner(2));
}

// Returns twice the largest area of a face if all areas are rounding errors, else none.
std::optional<double> area_of_slivers(const SurfaceMesh& mesh) {
  double largest = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (face_has_area(mesh, f)) return {};
    largest = std::max(largest, area_vector(mesh, f).norm());
  }
  return largest;
}

}  // namespace

void cut_off_slivers(const SurfacePiece& part, std::vector<char>& is_cut) {
  const SurfaceMesh& mesh = *part.mesh;
  if (mesh.rest_triangles().empty() || area_of_slivers(mesh)) return;
  for (const RestTriangle& t : mesh.rest_triangles()) {
    const Index first = 3 * t.face;
    const auto is_polygon = [&](Index h) { return mesh.opposite(h) >= 0 && is_inner(mesh, h); };
    if (face_has_area(mesh, t.face) || is_polygon(first) || is_polygon(first + 1) ||
        is_polygon(first + 2))
      continue;
    for (Index h = first; h < first + 3; ++h) {
      const Index o = mesh.opposite(h);
      if (o < 0) continue;
      is_cut[3 * part.face[t.face] + corner_of(h)] = 1;
      is_cut[3 * part.face[face_of(o)] + corner_of(o)] = 1;
    }
  }
}

void cut_apart_flat_piece(const SurfacePiece& part, double max_stretch, std::vector<char>& is_cut,
                          const StopCheck& stop) {
  const SurfaceMesh& mesh = *part.mesh;
  const std::optional<double> largest = area_of_slivers(mesh);
  if (!largest) return;
  if (*largest > 0 && is_planar(mesh) &&
      FlatteningStrain(mesh, stop).strain() <= strain_of_stretch(max_stretch))
    return;
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) >= 0) is_cut[3 * part.face[face_of(h)] + corner_of(h)] = 1;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
