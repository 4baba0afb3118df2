// Principal curvature directions of a triangle mesh, as data for a cross field [CSM03].
//
// The curvature tensor around a vertex sums (dihedral angle) (length) t t^T over half of each of
// its edges, where t is the direction of the edge. A face takes the mean of its corners' tensors,
// each divided by the area around its vertex. Let k1, k2 be the principal curvatures and d the
// direction of k1, as an angle in the face. Then the datum of a face is
//     q = e^{4 i d} |k1 - k2| / (|k1| + |k2| + 1 / sqrt(area of the surface)),
// which is 0 where the surface is flat or umbilic.
#pragma once

#include <complex>
#include <vector>

#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {

// Returns q, #F.
std::vector<std::complex<double>> principal_directions(const SurfaceMesh& mesh,
                                                       const FieldGeometry& geometry);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
