// Measures of a finished map: energies from a rule fine enough to be trusted, extremes, proofs.
//
//   const MapMeasures measures = measure_map(map, {{symmetric_dirichlet()}});
//   if (measures.locally_injective) std::cout << measures.value << "\n";    // 4: an isometry
//
// Not for steps of a solver: Evaluator (problem.h) has its energies, on the solver's own rules. Nor
// for overlaps: check_boundary() (global_injectivity.h).
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
  // A stop ended measuring early: value and face_value are those of coarser rules, extremes of few
  // samples. Proofs are complete.
  bool cut_short = false;
  double max_density = 0;               // sampled
  double sigma_max = 0, sigma_min = 0;  // sampled extreme singular values
  MapDistortion distortion;             // of no faces where cut short
  Vec min_det;  // #F certified lower bound of det J (<= 0: not proven positive)
  // True where all min_det > 0 and interior angle sums are 2 pi, at cones their angle.
  bool locally_injective = false;
  double seam_residual = 0;           // constraints.h, model units
  double max_boundary_angle = 0;      // radians, largest sector sum at a boundary vertex
  Index boundary_over_full_turn = 0;  // boundary vertices whose sum exceeds 2 pi
};

// Mean density and #F mean densities, adaptively: elements are refined until two successive rules
// agree to 1e-6 of the total.
double mean_density(const BezierMap& map, const RestShapes& rest, const EnergySum& energy,
                    Vec& face_value);

// Measures a map; after a stop, or when it comes meanwhile, only what is needed to judge it. Throws
// InvalidArgument for energies of another number of faces.
MapMeasures measure_map(const BezierMap& map, const EnergySum& energy, const StopCheck& stop = {});
// Measures a map whose control points were divided by `scale` after it was made, in the units of
// before. Proofs (min_det, angles, local injectivity) are of the control points as they are.
MapMeasures measure_normalized(const BezierMap& map, double scale, const EnergySum& energy,
                               const StopCheck& stop = {});

// Measures of a map that was moved after it was measured, which rounds its control points: proofs
// are made anew for the points as they are; where these tell another map, everything is.
MapMeasures measures_once_moved(MapMeasures before, const BezierMap& moved,
                                const EnergySum& energy);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
