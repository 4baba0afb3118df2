// Vertices of quads moved on a surface towards the middle of their neighbours, which neither folds
// nor turns: no step makes the worst corner around it worse than before, unless it stays good, or
// more of its quads face away from the surface.
//
//   HeldVertices held;
//   held.points.resize(polygons.positions.size());   // no vertex on the border or on a feature
//   smooth_quads(polygons, *mesh, held, stop);
//
// Vertices of the border and of features slide along them, between their neighbours, but for their
// corners.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/internal/border.h"

namespace majorant {

struct HeldVertices {
  std::vector<BorderPoint> points;  // of every vertex of the quads
  std::vector<char> is_feature;     // as BorderLengths has it
  // Edges of quads along features: vertices, in the direction of feature_lines().
  std::vector<std::array<Index, 2>> feature_edges;
  double border_turn = kCornerTurn;  // of its corners
};

// mesh: of quads, a manifold, in the units and places of the file that the surface came from.
// Vertices that move end on the surface. Throws Stopped.
void smooth_quads(PolygonMesh& mesh, const SurfaceMesh& surface, const HeldVertices& held,
                  const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
