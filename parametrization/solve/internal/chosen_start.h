// The start of a map, with what its computation revealed about later maps.
//
//     const ChosenStart start = choose_start(*mesh, options.map, record);
//
// Internal to parametrize(); initial_map() returns the control points alone.
#pragma once

#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

struct ChosenStart {
  Vec uv;  // u, v per vertex
  StartMethod method = StartMethod::Given;
  // For MapInjectivity::Global: a free map of the coarsest mesh overlaps itself, so those of finer
  // ones will too.
  bool free_maps_overlap = false;
};

// Returns whether choose_start() tries a start in many resolutions.
bool tries_multiresolution(const SurfaceMesh& mesh, const MapOptions& options);
// Chooses and computes the start. Throws the errors of initial_map().
ChosenStart choose_start(const SurfaceMesh& mesh, const MapOptions& options, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
