// A map to start from, and what it took to get it.
//
//   const Start start{BezierMap::linear(mesh, tutte_map(*mesh))};
//   ParametrizationResult result = parametrize(start.map, options, record);
//
// Others come from texture coordinates (texture_seams.h) or are made (make_seamless.h).
#pragma once

#include <string_view>

#include "majorant/parametrization/maps/bezier_map.h"

namespace majorant {

// Where a seamless map comes from. Field: a cross field, integrated. ScaledField: likewise, with
// the lengths of the conformal metric that has the field's cones. Conformal: that metric, laid out;
// for spheres and disks only, where the cones determine all transitions. Automatic: the first of
// these that can be untangled.
enum class SeamlessMethod { Automatic, Field, ScaledField, Conformal };
// "automatic", "field", "scaled-field", "conformal".
std::string_view method_name(SeamlessMethod method);

struct Start {
  BezierMap map;  // of degree 1, of the surface cut open where it has seams, which hold to rounding
  // Of maps put together from corner coordinates, uv units: the largest mismatch found along a seam
  // edge, and the largest distance by which projecting it out moved a corner.
  double residual = 0, moved = 0;
  // Of maps that were made: triangles inverted at first, Newton steps to repair them, and the
  // method that gave the map (Automatic: none).
  Index inverted = 0;
  int untangling_steps = 0;
  SeamlessMethod method = SeamlessMethod::Automatic;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
