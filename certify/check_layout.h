// The proof of global_injectivity.h for boundaries of any source: that of a map in memory, or of
// what a file holds.
//
//   GlobalInjectivity atlas = check_layout(boundary_loops(map), {});
//
// half_edge_a and half_edge_b of its contacts are BoundaryLoops::half_edge.
#pragma once

#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/global_injectivity.h"

namespace majorant {

GlobalInjectivity check_layout(const BoundaryLoops& boundary,
                               const InjectivityOptions& options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
