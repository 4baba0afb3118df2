// What is asked of a map, apart from where its points are held: the part that does not depend on
// units, shared by what a user says (MapOptions) and what a solver gets (MapSpecification).
#pragma once

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

struct MapObjective {
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
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
