// Compares cells with a surface along the edges of the surface.
//
//   const SurfaceMatch match = match_along_edges({*mesh}, read_mesh("bunny.obj"));
//
// Edges of the surface that the cells have too, as one edge or as a chain along the straight line,
// cut both into patches. Patches with the same edges around them are compared (patch_match.h): both
// must cover what these edges enclose, once.
#pragma once

#include "majorant/certify/internal/surface_match.h"

namespace majorant {

// Requires that the polygons of the surface are edge-manifold and oriented alike.
SurfaceMatch match_along_edges(const ShownCells& cells, const PolygonMesh& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
