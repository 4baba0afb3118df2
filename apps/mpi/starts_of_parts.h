// The starts of a map in parts: Tutte's map (parametrization/initialization/start.h), solved by all
// ranks together, and its way to pins that are elsewhere.
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
  // True where its faces would have no room in doubles: rank 0 makes the start alone, as one
  // process does: exact signs decide there, and other convex combinations may be needed.
  bool on_one_rank = false;
};

// whole: rank 0's surface, a disk with or without holes; these are filled for the while, so that
// the filled surface is divided, too. Collective. Throws Error(Infeasible) as tutte_map(), and
// where the system cannot be solved.
TutteOfParts tutte_of_parts(const MeshPart& part, const SurfaceMesh* whole,
                            const SolverFactory& solver);

// The start `uv` of this part moved to where the pins are met. That takes maps of degree 1 that are
// pulled there and proven valid, which rank 0 makes alone, as one process does (pin_homotopy.h):
// nothing is done where the start meets its pins. whole, options: rank 0's, of the whole surface;
// its pins and handles have targets afterwards. Whether the start has moved. Collective. Throws
// Error on rank 0 as pin_homotopy().
bool led_to_pins(const MeshPart& part, const std::shared_ptr<const SurfaceMesh>& whole, Vec& uv,
                 ParametrizationOptions& options, RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
