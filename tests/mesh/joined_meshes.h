// Meshes made of others: translated, or two as components of one mesh.
#pragma once

#include "majorant/mesh/polygon_mesh.h"
#include "mesh/list_edits.h"

namespace majorant {

inline PolygonMesh moved(PolygonMesh mesh, const Vector3& by) {
  for (Vector3& p : mesh.positions) p += by;
  return mesh;
}

inline PolygonMesh together(PolygonMesh a, const PolygonMesh& b) {
  const auto first = static_cast<Index>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  append_lists(a.polygons, b.polygons, first);
  a.polygon_lines.clear();
  return a;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
