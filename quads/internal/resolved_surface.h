// A surface whose features and borders are resolved by its mesh: no face has two constrained edges,
// so that these may be straight in a map at every vertex.
//
//   const ResolvedSurface resolved =
//       resolve_feature_edges(*mesh, sharp_edges(*mesh, kCornerTurn));
//   const std::vector<char> is_corner = held_corners(resolved.mesh, resolved.is_feature);
//
// Vertices of `mesh` keep their numbers.
#pragma once

#include <vector>

#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/features.h"

namespace majorant {

struct ResolvedSurface {
  SurfaceMesh mesh;
  std::vector<char> is_feature;      // 3 #F, both sides; empty where there are none
  double border_turn = kCornerTurn;  // degrees, from which on a vertex of the border is a corner
};

// Returns the same surface, where every other edge that joins two held vertices has one more in its
// middle, and a face with three held edges one at its centroid: no face has two held edges, so that
// these may be straight in a map at every vertex. So do the edges of a vertex all of whose
// neighbours are on held edges, such as the middle of a fan: it alone could not hold the cones of
// what they surround. Faces with a rest triangle stay as they are.
// is_feature: as feature_lines() has it (features.h).
ResolvedSurface resolve_feature_edges(const SurfaceMesh& mesh,
                                      const std::vector<char>& is_feature = {});

// Returns the surface with every edge halved and every face cut into four; features, too.
ResolvedSurface subdivided(const ResolvedSurface& surface);

// Returns the surface with a smoother border: vertices that are no corners lie where the border
// turns little. Lengths of edges stay about as they are. Not for positions: quads lie on the border
// as it is.
ResolvedSurface smooth_border(const ResolvedSurface& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
