// Decides whether the cells of a map file are the faces of the requested surface, or of a part of
// it.
#pragma once

#include "majorant/certify/map_proof.h"

namespace majorant {

struct ShownSurface {
  Finding finding;            // see MapProof::surface
  Index other_triangles = 0;  // faces of the surface in other triangulations
  Index unmapped = 0;         // polygons of the surface without cells
};

// cells: of the file, as a surface (CutMap::surface()). request.surface must not be null.
ShownSurface shown_surface(const MapFile& file, const SurfaceMesh& cells,
                           const ProofRequest& request);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
