// *What* a map shall be: degree, energy, boundary, points that are held. In model units, vertices
// and half-edges of the mesh that is mapped (of the start's, where a start is given).
//
//   MapOptions map;
//   map.degree = 2;
//   map.pins = {{0, {}}};                          // stays where the initial map has it
//   map.handles = {{12, Vector2(0.5, 1)}};         // pulled there
//
// Not for how such a map is looked for: that is solve_options.h. What solvers make of it is the
// normalised problem: map_problem.h.
#pragma once

#include <optional>
#include <vector>

#include "majorant/energies/energy_factory.h"
#include "majorant/framework/types.h"

namespace majorant {

// Weights lie between 1 / kLargestFactor and kLargestFactor, targets no farther than that many
// model sizes away: the products of two weights and a squared distance, of two of which norms are
// made, stay finite in doubles.
inline constexpr double kLargestFactor = 1e30;
inline bool is_usable_weight(double weight) {
  return weight >= 1 / kLargestFactor && weight <= kLargestFactor;
}

enum class BoundaryCondition { Free, Fixed };        // Fixed: the start's boundary stays
enum class BoundaryAngles { Free, AtMostFullTurn };  // sector sums at boundary vertices

// Local: det J > 0 and angle sums; Global: no overlaps either, held by a scaffold, a mesh of the
// space around the image.
enum class MapInjectivity { Local, Global };

// The start of a map. Automatic: Multiresolution for large surfaces, unless points are pulled or
// held where the initial map has them. Multiresolution: multiresolution_map(), but Tutte where that
// does not know what is asked. Tutte: tutte_map(). Given: MapOptions::initial, or the start that a
// caller brings.
enum class StartMethod { Automatic, Tutte, Multiresolution, Given };

struct Pin {
  Index vertex;                        // of the mesh
  std::optional<Vector2> target = {};  // model units; none: where the initial map has the vertex
};

struct MapOptions {
  EnergySum energy{{symmetric_dirichlet(), 1.0}};  // minimized: its mean over the surface
  // #F positive factors of the whole energy, empty = all 1: where it matters. What is measured of a
  // map leaves them out, unlike those of single summands (WeightedEnergy::face_weight), which say
  // what the energy is.
  Vec face_weight = {};
  BoundaryCondition boundary = BoundaryCondition::Free;
  BoundaryAngles boundary_angles = BoundaryAngles::Free;
  // w of the soft handles: + w * sum |x - target|^2 / area; chosen, not tuned: handles are
  // asked for because they may give way.
  double handle_weight = 1e3;
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
