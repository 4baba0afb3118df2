// How much a texture is stretched on the surface: the measure that people who texture use.
//
//     L2^2(chart) = mean over the surface of (Gamma^2 + gamma^2) / 2,  Linf = max of Gamma,
//
// Gamma >= gamma the singular values of the map from the plane to the surface, in units in which
// image and surface have the same area: an isometry has 1, everything else more. [SSGH01]
#pragma once

#include "majorant/parametrization/maps/bezier_map.h"

namespace majorant {

struct Stretch {
  double l2 = 1, max = 1;
  // What they are made of, so that those of several charts can be joined: areas of surface and
  // image, integral of (Gamma^2 + gamma^2) / 2, largest Gamma, without units taken out.
  double surface_area = 0, image_area = 0, square = 0, largest = 0;

  // Of both together, at one scale.
  Stretch joined(const Stretch& other) const;
};

// Sampled at the points (i, j, k) / 6 inside the faces, one point at degree 1, which is exact. The
// map is locally injective.
Stretch measure_stretch(const BezierMap& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
