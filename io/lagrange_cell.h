// Converts between values at the lattice points (i, j, k) / n of cells, as most programs hold
// curved triangles ("Lagrange", "high order"), and control points, as in this library.
//
//   const Points2 nodes = lagrange_nodes(file);   // #N by 2: values to write
//   file.uv = nodes;                              // values that were read
//   take_as_lagrange_nodes(file, path);           // uv: control points; uv_rounding: their errors
//
// Values and control points of a cell have the same order, VTK's, so that `cells` numbers both.
// Values along an edge depend only on control points along it, and are computed in an order that
// both cells share. So continuity is preserved to the last bit.
#pragma once

#include <string>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/map_file.h"

namespace majorant {

// The highest degree of Lagrange cells in gmsh and VTK. Higher degrees are neither read nor
// written.
inline constexpr int kHighestLagrangeDegree = 10;

// For writers. Throws Error(Unsupported, "cannot write PATH: ...") for higher degrees.
void require_lagrange_degree(const std::string& path, const MapFile& map);

// Returns uv at the lattice points, correctly rounded up to about 1e-30 of the cell. Points without
// a cell keep their uv. The degree is at most kHighestLagrangeDegree; Stopped.
Points2 lagrange_nodes(const MapFile& map, const StopCheck& stop = {});

// Returns a bound of the factor by which errors of values grow in control points: 1 at degree 1,
// about a hundred at degree 8.
double lagrange_amplification(int degree);

// Replaces uv, which are such values with errors up to uv_rounding, by control points, and updates
// uv_rounding. At degree 1 nothing changes. `map` is sound (map_check.h). Throws Error(Unreadable)
// naming `file` if the degree is too high, or if a point is on two different edges; Stopped.
void take_as_lagrange_nodes(MapFile& map, const std::string& file, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
