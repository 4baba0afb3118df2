// Triangles that are a surface as they are.
#pragma once

#include <optional>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// What repair() (mesh/repair.h) makes of these triangles, with Orientation::AsGiven and
// Numerics::AsGiven, where it has nothing to do, in a fraction of its time. Nothing where it may
// have: edges of more than two faces, or of two that run the same way; sheets that touch; faces
// that have a vertex twice, the vertices of another one or hardly an area; a soup. parts: as
// SurfaceMesh::from_parts() takes them, without rest triangles.
std::optional<SurfaceMesh> sound_surface(SurfaceParts parts);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
