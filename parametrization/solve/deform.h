// Deformation of a planar mesh by point handles: the map of the mesh onto itself, moved.
//
//   BezierMap rest = planar_map(mesh);                 // every point where it is
//   ParametrizationOptions options;
//   options.map.handles = {{12, Vector2(0.5, 1)}};          // soft; pins are hard
//   options.map.injectivity = MapInjectivity::Global;
//   ParametrizationResult bent = deform(rest, options, record);
//
// Targets are approached in steps at degree 1, so that the mesh bends on its way as it does at the
// end. Pins are pulled by springs until they can be held exactly, as parametrize() does without
// these steps; the degree is raised after that. Meanwhile soft handles are
// pulled as hard as pins.
#pragma once

#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

// The identity of a mesh in a plane z = const, seen from the side from which its faces are
// counterclockwise: (x, y), or (-x, y) where they are clockwise. Any number of boundary loops.
// Throws Error(Unsupported) naming a vertex that is off the plane, or a face that is turned over.
BezierMap planar_map(std::shared_ptr<const SurfaceMesh> mesh);

// start: of degree 1, locally (for MapInjectivity::Global also globally) injective. options: as for
// parametrize(). Throws as parametrize().
ParametrizationResult deform(const BezierMap& start, const ParametrizationOptions& options,
                             RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
