// Makes a surface of triangles that need no repair.
#pragma once

#include <optional>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns the surface of triangles that need no repair, in a fraction of the time of repair()
// (mesh/repair.h) with Orientation::AsGiven and Numerics::AsGiven. Returns nothing if a repair may
// be needed: for edges of more than two faces or of inconsistent orientation, touching sheets,
// faces with a repeated vertex, duplicate faces, faces with almost no area, and soups. `parts` are
// those of SurfaceMesh::from_parts(), without rest triangles.
std::optional<SurfaceMesh> sound_surface(SurfaceParts parts);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
