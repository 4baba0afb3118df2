// Turns a plane mesh such that its faces are counterclockwise.
//
//   if (const auto up = turned_counterclockwise(polygons)) ...   // its faces were all clockwise
#pragma once

#include <optional>

#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns the mesh with its faces turned if it lies in a plane z = const and none of its faces is
// counterclockwise, seen from above as in plots; nothing for other meshes.
std::optional<PolygonMesh> turned_counterclockwise(const PolygonMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
