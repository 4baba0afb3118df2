// A start moved to where it satisfies added constraints, which may hold nowhere yet: the least
//     d^T (L + epsilon) d,  L the graph Laplacian of the edges between neighbouring control points,
// among the displacements d that meet them. A translation costs nothing, and what one point must
// move its neighbours share.
#pragma once

#include <memory>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/framework/problem.h"
#include "majorant/mesh/seams.h"

namespace majorant {

// x: full unknowns, the nodes of `space` first. Returns the moved start. Throws Error(Infeasible)
// where its map is not injective any more.
Vec start_on_constraints(const Problem& problem,
                         const std::shared_ptr<const BezierTriangleSpace>& space,
                         const LocalInjectivity& injectivity,
                         const std::shared_ptr<const Seams>& seams, VecIn x);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
