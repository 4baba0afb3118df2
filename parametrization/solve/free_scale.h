// Tests that the scale of a map is determined. Energies such as ASAP are smallest for a map shrunk
// to a point (FreeScale::Collapses), which a free boundary permits.
//
//   const bool bad = collapses(options.map, map.space(), map.seams());
//   require_scale(options.map, map);   // throws if so
//
// parametrize() and deform() call require_scale(); collapses() serves callers with messages of
// their own.
#pragma once

#include "majorant/maps/bezier_map.h"
#include "majorant/maps/map_options.h"

namespace majorant {

// Returns whether minimizing options.energy shrinks the map to a point. That is so if the sum of
// energies collapses, unless a fixed boundary or two points (pins, soft handles) of one piece of
// the surface at different places prevent it. The space is that of the (cut) surface, of any
// degree. Points refer to its vertices, which must exist. A surface without a boundary has none to
// fix.
bool collapses(const MapOptions& options, const BezierTriangleSpace& space, const Seams& seams);

// Throws Error(Usage) with file, energy and remedy if the map collapses.
void require_scale(const MapOptions& options, const BezierMap& start);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
