// The starts of a distributed map: Tutte's map (parametrization/initialization/start.h), solved by
// all ranks together, and its path to pins that are elsewhere.
//
//     TutteOfParts tutte = tutte_of_parts(part, whole_mesh, linear_solver);
//     led_to_pins(part, whole_mesh, tutte.uv, whole_options, record);
#pragma once

#include "apps/mpi/mesh_part.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/parametrization/solve/parametrize.h"

namespace majorant {

struct TutteOfParts {
  Vec uv;  // 2 numbers per vertex of the part
  // True if faces would be too small for doubles. Then rank 0 makes the start alone, as one process
  // does, since exact signs and other convex combinations may be needed.
  bool on_one_rank = false;
};

// whole: on rank 0, a disk with or without holes. Holes are filled for this purpose, and the filled
// surface is partitioned, too. Collective. Throws Error(Infeasible) where tutte_map() does, and if
// the system cannot be solved.
TutteOfParts tutte_of_parts(const MeshPart& part, const SurfaceMesh* whole,
                            const SolverFactory& solver);

// Moves the start `uv` of this part until its pins are met, if necessary; returns whether it has
// moved. Rank 0 does this alone, as one process does, by maps of degree 1 that are proven valid
// (pin_homotopy.h). whole, options: on rank 0, for the whole surface; pins and handles have targets
// afterwards. Collective. Throws the errors of pin_homotopy() on rank 0.
bool led_to_pins(const MeshPart& part, const std::shared_ptr<const SurfaceMesh>& whole, Vec& uv,
                 ParametrizationOptions& options, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
