// parametrize() of several ranks: each solves its part, in the same loop as one process
// (parametrization/solve/run_sharing.h).
//
//     ParametrizationResult result = parametrize_parts(part, uv, options, record);
//     result.map->control_points();                 // of this rank's faces, model units
//
// What needs the whole surface in one process is refused: scaffolds, seams, aligned edges, angles
// at the boundary, flipped triangles, terms of a caller's own.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "apps/mpi/mesh_part.h"
#include "majorant/parametrization/solve/run_sharing.h"

namespace majorant {

// Tells how often a run keeps its state, and who takes it.
struct Keeping {
  int every = 0;  // iterations; 0: never
  // Called after so many iterations and where a limit ends the run, on all ranks together. Where
  // there is no state to go on from, after the next one that has: the way around a stall has none.
  std::function<void(const RunState&)> keep;
};

// uv: the start, 2 numbers per vertex here, which meets its pins; options: of this rank
// (NormalizedStart). Collective. The result's map is this rank's, its measures are
// MapPart::measure()'s, the rest is of the whole map; the record of rank 0 decides when to stop.
// from: where an earlier run of the same start and options was, none: at the start. Throws
// Error(Infeasible) where the start is not injective, on all ranks, Error(Unreadable) where `from`
// is not; Error(Usage) for what is refused and for options out of range.
ParametrizationResult parametrize_parts(std::shared_ptr<const MeshPart> part, const Vec& uv,
                                        const ParametrizationOptions& options, RunRecord& record,
                                        const Keeping& keeping = {},
                                        const std::optional<RunState>& from = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
