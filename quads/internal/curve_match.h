// Decides whether edges of quads follow the border loops and feature lines of a surface.
//
//   std::vector<std::string> defects;
//   const std::optional<QuadSurface> quads = quad_surface(polygons, defects);
//   match_borders(*quads, *mesh, kCornerTurn, {}, defects);
//   const FeatureMatch match = match_features(*quads, *mesh, sharp_edges(*mesh, 35), {}, defects);
//   std::cout << match.uncovered.size() << " of " << match.lines << " lines are not covered\n";
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/check_quads.h"
#include "majorant/quads/internal/quad_surface.h"

namespace majorant {

// Compares the border loops of both, which have equal numbers, as check_quads.h describes. Adds
// defects to `defects`. border_turn: a turn of so many degrees is a corner.
void match_borders(const QuadSurface& quads, const SurfaceMesh& surface, double border_turn,
                   const StopCheck& stop, std::vector<std::string>& defects);

struct FeatureMatch {
  Index lines = 0;                  // of the surface
  std::vector<LineEnds> uncovered;  // not covered by any chain of edges of quads
};

// Compares feature lines with edges. is_feature: 3 #F flags of the surface.
FeatureMatch match_features(const QuadSurface& quads, const SurfaceMesh& surface,
                            const std::vector<char>& is_feature, const StopCheck& stop,
                            std::vector<std::string>& defects);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
