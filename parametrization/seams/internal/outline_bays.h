// The shape of a chart's outline in the plane.
//
//   const std::vector<Index>& outline = mesh->boundary_loops()[0];
//   const std::vector<Index> starts = bay_bottoms(x, outline);
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns the signed enclosed area. uv: 2 #V, coordinates of the vertices. loop: vertices,
// counterclockwise.
double enclosed_area(const Vec& uv, const std::vector<Index>& loop);

// Returns the vertices of an outline at the bottoms of its bays, without small ones: corners of an
// L, ends of the bays between limbs. The largest bays come first.
std::vector<Index> bay_bottoms(const Vec& uv, const std::vector<Index>& outline);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
