// How much of its surroundings a point of a surface is seen from: seams are wanted where that is
// little.
//
//   CutOptions cuts;
//   cuts.wanted.weight = hiding_weights(*mesh, ambient_visibility(*mesh));
//
// Plain sums and square roots alone: the same bits on every machine, and for any number of threads.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// #V in 0..1: the part of the light from everywhere above a vertex that the surface leaves through,
// weighted by the cosine of its angle with the normal (ambient occlusion is 1 minus that). 1 on
// what is convex. By rays in fixed directions from some thousand vertices; others have what the
// nearest of these has, along edges, smoothed. Stopped.
Vec ambient_visibility(const SurfaceMesh& mesh, const StopCheck& stop = {});

// #V in 0..1: the cosine of the angle between normal and direction, which is not zero; 0 where the
// vertex is turned away, or something lies between it and whoever looks from far away there.
// Stopped.
Vec visibility_from(const SurfaceMesh& mesh, const Vector3& direction, const StopCheck& stop = {});

// 3 #F: what a cut there costs for its length: the square of how visible it is, since what is seen
// is lit and looked at, from a fiftieth where nothing is visible to 1 in full view.
std::vector<double> hiding_weights(const SurfaceMesh& mesh, const Vec& visibility);

// The mean visibility of the cuts (3 #F flags) by their length; of the whole surface, by its area,
// where there are none.
double visibility_of_cuts(const SurfaceMesh& mesh, const Vec& visibility,
                          const std::vector<char>& is_cut);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
