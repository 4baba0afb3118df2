// Maps given by their values at the lattice points (i, j, k) / n of every cell, as most programs
// hold curved triangles ("Lagrange", "high order"), and by control points, as this library does.
//
//   const Points2 nodes = lagrange_nodes(file);   // #N by 2: what to write
//   file.uv = nodes;                              // what was read
//   take_as_lagrange_nodes(file, path);           // uv: control points; uv_rounding: how exact
//
// Values and control points of a cell have one order, VTK's, so that `cells` numbers both. The
// values along an edge depend on the control points along it alone, and are computed from them in
// an order that both cells see alike: what was continuous stays so, to the last bit.
#pragma once

#include <string>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/map_file.h"

namespace majorant {

// Lagrange cells beyond are not read nor written. It is the highest degree that gmsh and VTK
// have.
inline constexpr int kHighestLagrangeDegree = 10;

// For writers. Throws Error(Unsupported, "cannot write PATH: ...") for degrees beyond.
void require_lagrange_degree(const std::string& path, const MapFile& map);

// uv at the lattice points, correctly rounded but for some 1e-30 of the cell. Points that no cell
// has keep their uv. Degree at most kHighestLagrangeDegree; Stopped.
Points2 lagrange_nodes(const MapFile& map, const StopCheck& stop = {});

// The factor by which errors of values grow in control points, at most: 1 at degree 1, some hundred
// at 8.
double lagrange_amplification(int degree);

// Replaces uv, which are such values, exact to uv_rounding, by control points; uv_rounding says how
// far they may be from those of the map that the values make. At degree 1 nothing changes. `map` is
// sound (map_check.h). Throws Error(Unreadable) naming `file` when the degree is too high, or where
// a point is on two edges that are not the same; Stopped.
void take_as_lagrange_nodes(MapFile& map, const std::string& file, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
