// Points of a surface at the positions of its file.
#pragma once

#include "majorant/certify/inverse_map.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

inline Vector3 position_at(const SurfaceMesh& mesh, const SurfacePlace& place) {
  Vector3 p = Vector3::Zero();
  for (Index k = 0; k < 3; ++k)
    p += place.barycentric[k] * mesh.input_position(mesh.faces()(place.face, k));
  return p;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
