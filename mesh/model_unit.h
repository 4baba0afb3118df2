// Scales surfaces whose areas and their squares exceed the range of doubles to a size near 1. The
// factor is a power of two, so that no digit changes.
//
//   const double unit = model_unit(*mesh);
//   const std::shared_ptr<const SurfaceMesh> near_one = in_units(*mesh, unit);
//   const double length = unit * near_one->edge_length(0);   // model units
#pragma once

#include <memory>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns a power of two: 1 if the extent of the surface is ordinary or 0, otherwise the unit in
// which the extent is between 1 and 2; 2^1023 if the extent overflows.
double model_unit(const SurfaceMesh& mesh);

// Returns the mesh with lengths divided by `unit`, a power of two.
std::shared_ptr<const SurfaceMesh> in_units(const SurfaceMesh& mesh, double unit);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
