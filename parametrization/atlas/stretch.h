// The stretch of a texture on a surface [SSGH01].
//
//   const Stretch stretch = measure_stretch(map);
//   std::cout << stretch.l2 << " in the mean, " << stretch.max << " at most\n";
//
//     L2^2(chart) = mean over the surface of (Gamma^2 + gamma^2) / 2,  Linf = max of Gamma,
//
// where Gamma >= gamma are the singular values of the map from the plane to the surface, in units
// in which image and surface have the same area. An isometry has stretch 1, any other map more.
//
// For energies that a solver minimizes, see energies/.
#pragma once

#include "majorant/maps/bezier_map.h"

namespace majorant {

struct Stretch {
  double l2 = 1, max = 1;
  // The parts of both measures, from which those of several charts are joined: areas of surface and
  // image, the integral of (Gamma^2 + gamma^2) / 2, the largest Gamma, in the units of the map.
  double surface_area = 0, image_area = 0, square = 0, largest = 0;

  // Returns the stretch of both charts together, at one scale.
  Stretch joined(const Stretch& other) const;
};

// Measures a locally injective map by the finest quadrature rule of a triangle, which is exact at
// degree 1. `max` is taken at the points of the rule, the corners and some points of the edges.
// Faces without an area (SurfaceMesh::rest_triangles()) are left out unless all faces are such.
Stretch measure_stretch(const BezierMap& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
