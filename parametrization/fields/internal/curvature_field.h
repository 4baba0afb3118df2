// Principal curvature directions of a triangle mesh, as data for a cross field.
#pragma once

#include <complex>
#include <vector>

#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {

// #F: the fourth power of a unit principal direction (an angle as in CrossField) times
// |k1 - k2| / (|k1| + |k2| + 1 / sqrt(area)): 0 where the surface is flat or umbilic. Curvature is
// that of the edges around the corners [CSM03].
std::vector<std::complex<double>> principal_directions(const SurfaceMesh& mesh,
                                                       const FieldGeometry& geometry);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
