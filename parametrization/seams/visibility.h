// Visibility of points of a surface from its surroundings. Seams should run where it is low.
//
//   CutOptions cuts;
//   cuts.preferences.weight = hiding_weights(*mesh, ambient_visibility(*mesh));
//
// Only sums, products and square roots are used, so results are the same to the bit on every
// machine and for any number of threads.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns for each vertex the fraction of light from its outer hemisphere that the surface lets
// through, weighted by the cosine of its angle with the normal: #V in 0..1. Ambient occlusion is 1
// minus that; convex surfaces have 1. Rays in fixed directions are sent from some thousand
// vertices; other vertices get the value of the nearest of these along edges, smoothed. Stopped.
Vec ambient_visibility(const SurfaceMesh& mesh, const StopCheck& stop = {});

// Returns the cosine of the angle between normal and direction: #V in 0..1. It is 0 if the vertex
// is turned away, or hidden from a distant viewer in that direction. direction: not zero. Stopped.
Vec visibility_from(const SurfaceMesh& mesh, const Vector3& direction, const StopCheck& stop = {});

// Returns the weight of a cut along each half-edge (3 #F): the square of its visibility, between a
// fiftieth where nothing is visible and 1 in full view.
std::vector<double> hiding_weights(const SurfaceMesh& mesh, const Vec& visibility);

// Returns the mean visibility of the cuts (3 #F flags), weighted by length; without cuts that of
// the whole surface, weighted by area.
double visibility_of_cuts(const SurfaceMesh& mesh, const Vec& visibility,
                          const std::vector<char>& is_cut);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
