// Moves a start to where it satisfies added constraints, by the displacements d that minimize
//     d^T (L + epsilon) d,  L the graph Laplacian of the edges between neighbouring control points,
// subject to the constraints. A translation costs nothing, and the displacement of one point is
// shared by its neighbours.
#pragma once

#include <memory>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/framework/problem.h"
#include "majorant/mesh/seams.h"

namespace majorant {

// Returns the moved start. x: full unknowns, the nodes of `space` first. Throws Error(Infeasible)
// if its map is no longer injective.
Vec start_on_constraints(const Problem& problem,
                         const std::shared_ptr<const BezierTriangleSpace>& space,
                         const LocalInjectivity& injectivity,
                         const std::shared_ptr<const Seams>& seams, VecIn x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
