// A surface whose mesh resolves its features and borders: no face has two constrained edges, so
// that these may be straight in a map at every vertex.
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
  std::vector<char> is_feature;      // 3 #F, both sides; may be empty
  double border_turn = kCornerTurn;  // degrees; a border vertex with a larger turn is a corner
};

// Returns the same surface with added vertices, so that no face has two held edges and these may be
// straight in a map at every vertex. Each free edge between two held vertices gets a midpoint, and
// a face with three held edges gets its centroid. Edges of a vertex all of whose neighbours are on
// held edges, such as the middle of a fan, get midpoints, too; the vertex alone could not hold the
// cones that its neighbours need. Faces with a rest triangle stay the same. is_feature: see
// feature_lines() (features.h).
ResolvedSurface resolve_feature_edges(const SurfaceMesh& mesh,
                                      const std::vector<char>& is_feature = {});

// Returns the surface with every edge halved and every face divided into four, with its features.
ResolvedSurface subdivided(const ResolvedSurface& surface);

// Returns the surface with a smoother border: vertices that are not corners move so that the border
// turns little. Edge lengths hardly change. Only for the map: quads lie on the original border.
ResolvedSurface smooth_border(const ResolvedSurface& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
