// Measures of a finished map: energies by accurate rules, extremes, proofs.
//
//   const MapMeasures measures = measure_map(map, {{symmetric_dirichlet()}});
//   if (measures.locally_injective) std::cout << measures.value << "\n";    // 4: an isometry
//
// Steps of a solver use the energies of Evaluator (problem.h), on the solver's own rules. For
// overlaps, see check_boundary() (global_injectivity.h).
#pragma once

#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/distortion.h"

namespace majorant {

struct MapMeasures {
  double value = 0;  // mean of the energy's density, good to 1e-5 relative
  Vec face_value;    // #F mean density of each face
  // True if a stop ended measuring early: value and face_value then are those of coarser rules, and
  // extremes those of few samples. Proofs are complete.
  bool cut_short = false;
  double max_density = 0;               // sampled
  double sigma_max = 0, sigma_min = 0;  // sampled extreme singular values
  MapDistortion distortion;             // empty if cut short
  Vec min_det;  // #F certified lower bound of det J (<= 0: not proven positive)
  // True if all min_det > 0 and interior angle sums are 2 pi, at cones their angle.
  bool locally_injective = false;
  double seam_residual = 0;           // constraints.h, model units
  double max_boundary_angle = 0;      // radians, largest sector sum at a boundary vertex
  Index boundary_over_full_turn = 0;  // boundary vertices whose sum exceeds 2 pi
};

// Returns the mean density and sets #F mean densities, adaptively: elements are refined until two
// successive rules agree to 1e-6 of the total.
double mean_density(const BezierMap& map, const RestShapes& rest, const EnergySum& energy,
                    Vec& face_value);

// Measures a map. After a stop, before or during the call, measures only what is needed to judge
// it. Throws InvalidArgument for energies of another number of faces.
MapMeasures measure_map(const BezierMap& map, const EnergySum& energy, const StopCheck& stop = {});
// Measures a map whose control points were divided by `scale` after it was computed, in the
// original units. Proofs (min_det, angles, local injectivity) are of the control points as they
// are.
MapMeasures measure_normalized(const BezierMap& map, double scale, const EnergySum& energy,
                               const StopCheck& stop = {});

// Returns the measures of a map that was moved after it was measured. Moving rounds its control
// points, so proofs are computed anew, and if they differ for the rounded map, all measures are.
MapMeasures measures_once_moved(MapMeasures before, const BezierMap& moved,
                                const EnergySum& energy);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
