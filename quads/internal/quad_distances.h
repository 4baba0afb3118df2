// The distances between quads and a surface, and the quads that face its other side.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/check_quads.h"
#include "majorant/quads/internal/quad_surface.h"

namespace majorant {

struct QuadDistances {
  QuadDistance hausdorff;
  std::vector<Index> turned;  // quads, ascending; see check_quads.h
};

// stop: progress from 0.1 to 0.9 is reported to it. Throws Stopped.
QuadDistances quad_distances(const QuadSurface& quads, const SurfaceMesh& surface,
                             const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
