// Where a file says that its surface is sharp, whatever the angle.
//
//   const RepairedSurface surface = repair(polygons);
//   CutOptions cuts;
//   cuts.preferences.creases = marked_creases(polygons, surface);
#pragma once

#include <vector>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/repair.h"

namespace majorant {

// 3 #F flags of the surface, both sides of an edge or none: polygons with different materials meet
// there; or with different smoothing groups, or none (OBJ `s`); or the normals of their corners
// differ. Groups and normals say nothing where they part most of all edges, as those of faces that
// are shaded flat do.
std::vector<char> marked_creases(const PolygonMesh& polygons, const RepairedSurface& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
