// The start of a map, with what its making has shown of maps to come.
//
//     const ChosenStart start = choose_start(*mesh, options.map, record);
//
// Internal to parametrize(); initial_map() has the control points alone.
#pragma once

#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

struct ChosenStart {
  Vec uv;  // u, v per vertex
  StartMethod method = StartMethod::Given;
  // A free map of the coarsest mesh overlaps itself, and so will those of finer ones. Of
  // MapInjectivity::Global.
  bool free_maps_overlap = false;
};

// Throws what initial_map() does.
ChosenStart choose_start(const SurfaceMesh& mesh, const MapOptions& asked, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
