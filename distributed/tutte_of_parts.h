// Tutte's map (parametrization/starts/tutte.h), solved by all ranks together.
#pragma once

#include "distributed/mesh_part.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

struct TutteOfParts {
  Vec uv;  // 2 numbers per vertex of the part
  // Where its faces would have no room in doubles, rank 0 makes the start alone, as one process
  // does: exact signs decide there, and other convex combinations may be needed.
  bool on_one_rank = false;
};

// whole: rank 0's surface, a disk. Collective. Throws Error(Infeasible) as tutte_map(), and where
// the system cannot be solved.
TutteOfParts tutte_of_parts(const MeshPart& part, const SurfaceMesh* whole,
                            const SolverFactory& solver);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
