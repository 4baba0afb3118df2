// Surfaces so large or small that areas and their squares leave the range of doubles, brought to a
// size near 1: by a power of two, so that no digit changes.
//
//   const double unit = model_unit(*mesh);
//   const std::shared_ptr<const SurfaceMesh> near_one = in_units(*mesh, unit);
//   const double length = unit * near_one->edge_length(0);   // model units
#pragma once

#include <memory>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// A power of two: 1 where the extent of the surface is ordinary (or none), else such that in these
// units it is between 1 and 2; 2^1023 where it overflows.
double model_unit(const SurfaceMesh& mesh);

// Returns the mesh with lengths divided by `unit`, a power of two.
std::shared_ptr<const SurfaceMesh> in_units(const SurfaceMesh& mesh, double unit);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
