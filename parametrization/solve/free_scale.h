// Tests that something holds the scale of a map whose energy does not: energies such as ASAP are
// smallest for a map shrunk to a point (FreeScale::Collapses), and a free boundary lets them.
//
//   const bool bad = collapses(options.map, map.space(), map.seams());
//   require_scale(options.map, map);   // throws if so
//
// parametrize() and deform() ask by themselves; collapses() is for callers who want to refuse in
// their own words, or earlier.
#pragma once

#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_options.h"

namespace majorant {

// Returns whether minimizing asked.energy shrinks the map to a point: the sum collapses, and
// neither a fixed boundary nor two points (pins, soft handles) of one piece of the surface at
// different places withstand. space: the (cut) surface's, of any degree; its vertices are those of
// the points, which must exist. A surface without a boundary has none to fix.
bool collapses(const MapOptions& asked, const BezierTriangleSpace& space, const Seams& seams);

// Throws Error(Usage) with file, energy and remedy where it does.
void require_scale(const MapOptions& asked, const BezierMap& start);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
