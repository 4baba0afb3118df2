// The shape of the outline of a chart in the plane.
//
//   const std::vector<Index>& outline = mesh->boundary_loops()[0];
//   const std::vector<Index> starts = bay_bottoms(x, outline);
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// uv: 2 #V, where a map has the vertices; loop: vertices around it, counterclockwise. Signed.
double enclosed_area(const Vec& uv, const std::vector<Index>& loop);

// Vertices of an outline where it turns to the right, but for wiggles: corners of an L, ends of the
// bays between limbs. The largest bays come first.
std::vector<Index> bay_bottoms(const Vec& uv, const std::vector<Index>& outline);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
