// Do edges of quads follow the curves of a surface: its border loops and feature lines?
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

// Compares the border loops of both, of which there are equally many: check_quads.h says how. Adds
// what is wrong to `defects`. border_turn: degrees, from which on a turn is a corner.
void match_borders(const QuadSurface& quads, const SurfaceMesh& surface, double border_turn,
                   const StopCheck& stop, std::vector<std::string>& defects);

struct FeatureMatch {
  Index lines = 0;                  // of the surface
  std::vector<LineEnds> uncovered;  // that no chain of edges of quads covers
};

// Compares feature lines with edges. is_feature: 3 #F flags of the surface.
FeatureMatch match_features(const QuadSurface& quads, const SurfaceMesh& surface,
                            const std::vector<char>& is_feature, const StopCheck& stop,
                            std::vector<std::string>& defects);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
