// A cut surface with known transitions, on which a seamless map is computed.
//
//   CrossField field = smoothest_cross_field(*mesh);
//   comb(*mesh, is_cut, field);
//   const CutSurface cut = cut_open(*mesh, is_cut, field.turns, field.quarter_turns);
//   BezierMap map = BezierMap::linear(cut.mesh, project_to_seams(cut, x, nullptr), cut.seams);
#pragma once

#include <memory>
#include <vector>

#include "majorant/mesh/seams.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The cut surface and its transitions. turns: 3 #F, on both sides of every cut edge, on the
// opposite side the negative; uv of h = i^turns[h] uv of opposite(h) + t. quarter_turns: per vertex
// of `mesh`, 0 on its boundary.
struct CutSurface {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::shared_ptr<const Seams> seams;
};
CutSurface cut_open(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                    const std::vector<int>& turns, std::vector<int> quarter_turns);

// Returns u, v per vertex of the cut surface that satisfy the seams and are closest to `uv` in the
// free unknowns. *moved (may be null) receives the largest change.
Vec project_to_seams(const CutSurface& surface, VecIn uv, double* moved);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
