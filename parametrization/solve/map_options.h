// *What* a map shall be: degree, energy, boundary, points that are held. In model units, vertices
// and half-edges of the mesh that is mapped (of the start's, where a start is given).
//
//   MapOptions map;
//   map.degree = 2;
//   map.pins = {{0, {}}};                          // stays where the initial map has it
//   map.handles = {{12, Vector2(0.5, 1)}};         // pulled there
//
// Not for how such a map is looked for: that is solve_options.h.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "majorant/parametrization/maps/map_objective.h"

namespace majorant {

// Local: det J > 0 and angle sums; Global: no overlaps either, held by a scaffold, a mesh of the
// space around the image.
enum class MapInjectivity { Local, Global };

// The start of a map. Automatic: Multiresolution for large surfaces, unless points are pulled or
// held where the initial map has them. Multiresolution: multiresolution_map(), but Tutte where that
// does not know what is asked. Tutte: tutte_map(). Given: MapOptions::initial, or the start that a
// caller brings.
enum class StartMethod { Automatic, Tutte, Multiresolution, Given };
std::string_view start_name(StartMethod method);  // "auto", "tutte", "multiresolution", "input"

struct Pin {
  Index vertex;                        // of the mesh
  std::optional<Vector2> target = {};  // model units; none: where the initial map has the vertex
};

struct MapOptions : MapObjective {
  int degree = 3;  // 1..8
  MapInjectivity injectivity = MapInjectivity::Local;
  std::vector<Pin> pins = {};       // hard
  std::vector<Pin> handles = {};    // soft, with handle_weight
  std::vector<Index> aligned = {};  // half-edges that stay parallel to an axis
  std::optional<Vec> initial = {};  // u, v per vertex; none: made by `start`
  StartMethod start = StartMethod::Automatic;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
