// Untangles folded quads that no move of a single vertex can repair. All vertices around them move
// in turn and lower the energy of [GKKPRS21],
//     sum_{corners k} |e|^2 / (A_k + sqrt(A_k^2 + d^2)),   A_k = (along_k x back_k) . N,
// with the normal N of the surface below, |e|^2 = |along_k|^2 + |back_k|^2, and d, a fraction eps
// of |e|^2 that grows as the least A_k becomes more negative. The smaller A_k, the larger the
// energy.
//
//   MovableQuads quads(polygons, *mesh, held);
//   untangle(quads, stop);
#pragma once

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/movable_quads.h"

namespace majorant {

// Keeps the result if fewer quads are folded or turned. Throws Stopped.
void untangle(MovableQuads& quads, const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
