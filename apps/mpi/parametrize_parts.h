// parametrize() on several ranks: each solves its part, in the same loop as one process
// (parametrization/solve/run_sharing.h).
//
//     ParametrizationResult result = parametrize_parts(part, uv, options, record);
//     result.map->control_points();                 // of this rank's faces, model units
//
// Everything that needs the whole surface in one process is refused: scaffolds, seams, aligned
// edges, angles at the boundary, flipped triangles, terms of a caller's own.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "apps/mpi/mesh_part.h"
#include "majorant/parametrization/solve/run_sharing.h"

namespace majorant {

// The interval and the receiver of states for checkpoints.
struct CheckpointPolicy {
  int every = 0;  // iterations; 0: never
  // Called every `every` iterations and when a limit ends the run, on all ranks together. The
  // remedy for a stall has no state; then the call follows at the next iteration that has one.
  std::function<void(const RunState&)> keep;
};

// uv: the start, 2 numbers for each vertex of this rank, which meets its pins; options: of this
// rank (NormalizedStart). Collective. The result has this rank's map and the measures of
// MapPart::measure(); all other values are those of the whole map. The record of rank 0 decides
// when to stop. from: the state of an earlier run with the same start and options; none: begin at
// the start. Throws Error(Infeasible) on all ranks if the start is not injective, Error(Unreadable)
// if `from` is not; Error(Usage) for refused options and options out of range.
ParametrizationResult parametrize_parts(std::shared_ptr<const MeshPart> part, const Vec& uv,
                                        const ParametrizationOptions& options, RunRecord& record,
                                        const CheckpointPolicy& keeping = {},
                                        const std::optional<RunState>& from = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
