// The smoothest cross field as complex numbers z, #F: the fourth powers of its branches [KCPS13].
//
// They minimize
//     sum weight |z_f e^{4 i transport} - z_g|^2 + s sum mass |z - q|^2
// over interior edges (f, g) and faces. Here q are data, masses are fractions of the area, and the
// directions of fixed faces are given. Without data and fixed faces, z is the eigenvector of the
// smallest eigenvalue, found by inverse iteration.
#pragma once

#include <complex>
#include <vector>

#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {

// Returns z. fixed: #F, angles or kNotAligned (aligned_edges.h). data: q, #F. pull: s >= 0; if it
// is 0 and no face is fixed, the iteration starts at q, plus noise. Throws as field_system() does;
// Stopped.
std::vector<std::complex<double>> smoothest_directions(
    const SurfaceMesh& mesh, const FieldGeometry& geometry, const Vec& fixed,
    const std::vector<std::complex<double>>& data, double pull, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
