// parametrize() of several ranks: each solves its part, in the same loop as one process
// (parametrization/solve/parametrize_by.h).
//
//     ParametrizationResult result = parametrize_parts(part, uv, options, record);
//     result.map->control_points();                 // of this rank's faces, model units
//
// What needs the whole surface in one process is refused: scaffolds, seams, aligned edges, angles
// at the boundary, flipped triangles, terms of a caller's own.
#pragma once

#include <memory>
#include <optional>

#include "distributed/mesh_part.h"
#include "majorant/parametrization/solve/parametrize_by.h"

namespace majorant {

// uv: the start, 2 numbers per vertex here; options: of this rank (NormalizedStart). Collective.
// Throws Error(Infeasible) where the start is not injective, on all ranks; Error(Usage) for what is
// refused and for options out of range; as parametrize_part().
ParametrizationResult parametrize_parts(std::shared_ptr<const MeshPart> part, const Vec& uv,
                                        const ParametrizationOptions& options, RunRecord& record,
                                        const Keeping& keeping = {},
                                        const std::optional<RunState>& from = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
