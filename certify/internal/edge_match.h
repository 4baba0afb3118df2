// Cells compared with a surface along its edges.
//
//   const SurfaceMatch match = match_along_edges({*mesh}, read_mesh("bunny.obj"));
//
// Edges of the surface that the mesh of the cells has too, whole or as a chain of edges on the
// straight line, cut both into patches. Patches with the same edges around them are compared
// (patch_match.h): both cover what their common edges enclose, once.
#pragma once

#include "majorant/certify/internal/surface_match.h"

namespace majorant {

// The polygons of the surface are edge-manifold and oriented alike.
SurfaceMatch match_along_edges(const ShownCells& cells, const PolygonMesh& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
