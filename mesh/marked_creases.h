// Finds the edges that a file marks as sharp, whatever their angle.
//
//   const RepairedSurface surface = repair(polygons);
//   CutOptions cuts;
//   cuts.preferences.creases = marked_creases(polygons, surface);
#pragma once

#include <vector>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/repair.h"

namespace majorant {

// Returns 3 #F flags of the surface, on both sides of an edge or on none. An edge is marked if its
// polygons have different materials, different smoothing groups or none (OBJ `s`), or different
// normals at their corners. Groups and normals are ignored if they separate more than half of all
// edges, as in flat-shaded files.
std::vector<char> marked_creases(const PolygonMesh& polygons, const RepairedSurface& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
