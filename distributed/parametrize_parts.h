// parametrize() of several ranks: each solves its part, with the same Newton steps, remedies and
// rules as one process (parametrization/solve/degree_solver.h).
//
//     PartResult result = parametrize_parts(part, uv, options, record);
//     result.map->control_points();                 // of this rank's faces, model units
//
// What needs the whole surface in one process is refused: scaffolds, seams, aligned edges, angles
// at the boundary, flipped triangles, terms of a caller's own.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "distributed/mesh_part.h"
#include "majorant/framework/run_record.h"
#include "majorant/parametrization/maps/bezier_map.h"
#include "majorant/parametrization/maps/measure.h"
#include "majorant/parametrization/solve/degree_solver.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

// Of the whole map, the same on every rank; but face_value and min_det are of this rank's faces,
// and distortion is of none.
struct PartMeasures : MapMeasures {
  double area = 0, least_det = 0;
  Index faces_not_positive = 0, vertices_off = 0;  // vertices_off: angles do not add to full turns
};

// Where a run is, to go on from there later, on any number of ranks (checkpoint.h).
struct PartState {
  std::shared_ptr<const BezierTriangleSpace> space;  // over this rank's faces
  Vec x;                  // its control points, normalised as StartOfPart has them
  bool entering = false;  // on the way into the energy's domain
  DegreeSolver::State solver;
  double initial_value = 0;  // PartResult's
  int iterations = 0;        // of this run
};

// How a run is kept on its way.
struct Keeping {
  int every = 0;  // iterations; 0: never
  // Called on all ranks together, after so many iterations and where a limit ends the run. Where
  // there is no state to go on from, after the next one that has: the way around a stall has none.
  std::function<void(const PartState&)> keep;
};

struct PartResult {
  Status status = Status::Failed;
  std::string message;
  std::optional<BezierMap> map;  // this rank's
  double initial_value = 0, value_quadrature = 0, newton_decrement = 0;
  double handle_distance = 0;
  GlobalIndex variables = 0;
  std::vector<long> injectivity_tests;  // of all ranks
  RemedyUses remedies{};
  PartMeasures measures;
  double optimize_seconds = 0, measure_seconds = 0;
};

// uv: the start, 2 numbers per vertex here; options: of this rank (StartOfPart). Collective; the
// record of rank 0 decides when to stop. Throws Error(Infeasible) where the start is not injective,
// on all ranks; Error(Usage) for what is refused and for options out of range; as StartOfPart.
//
// from: where an earlier run of the same start and options was; none: at the start.
PartResult parametrize_parts(std::shared_ptr<const MeshPart> part, const Vec& uv,
                             const ParametrizationOptions& options, RunRecord& record,
                             const Keeping& keeping = {},
                             const std::optional<PartState>& from = {});

// Collective. map: of this rank's faces.
PartMeasures measure_parts(const MeshPart& part, const BezierMap& map, const EnergySum& energy);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
