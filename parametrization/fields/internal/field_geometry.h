// The geometry of a triangle mesh that direction fields need: how directions of one face continue
// in the next. It is intrinsic: bending or moving the surface changes nothing.
//
// A direction in a face is an angle, counterclockwise from the edge corner 0 -> corner 1. Unfolding
// two neighbours into one plane takes angle a of the face of half-edge h to a + transport[h] in the
// face of its opposite; transport[opposite] = -transport. [CdGDS13] Ch. 8.
#pragma once

#include <numbers>
#include <vector>

#include "majorant/framework/sparse_spd.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

inline constexpr double kQuarter = std::numbers::pi / 2;  // a quarter turn, radians

struct FieldGeometry {
  explicit FieldGeometry(const SurfaceMesh& mesh);

  Vec edge_direction;  // 3 #F: of half-edge h in its face, radians
  Vec transport;       // 3 #F: see above, 0 at the boundary
  Vec weight;     // 3 #F: edge length / distance of the faces, within bounds; 0 at the boundary
  Vec face_area;  // #F
  Vec angle_sum;  // #V: of the corners at a vertex, radians
  std::vector<char> is_boundary;  // #V
  std::vector<int> valence;       // #V: faces at a vertex
};

// Returns the direction of half-edge h in space, unit length.
Vector3 edge_vector(const SurfaceMesh& mesh, Index half_edge);

// Returns the factorized system of a field's smoothness. Throws Error(Infeasible) if degenerate
// faces make it singular; Stopped.
SparseSpd field_system(Index size, Index block, const std::vector<SparseSpd::Entry>& entries,
                       Ordering ordering = Ordering::Amd, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
