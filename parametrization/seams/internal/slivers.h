// Cuts around faces without an area, which no map can place beside their neighbours.
//
//   for (const SurfacePiece& part : mesh->split()) {
//     cut_apart_flat_piece(part, 1.015, is_cut, {});
//     cut_off_slivers(part, is_cut);
//   }
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Cuts faces without an area off their neighbours, which would be distorted otherwise. Faces that
// are part of a larger polygon stay in it. is_cut: 3 #F flags of the whole surface.
void cut_off_slivers(const SurfacePiece& part, std::vector<char>& is_cut);

// Cuts a piece whose faces all have no area along all its edges, since their shapes beside each
// other are unknown. A planar piece that stretches no more than max_stretch stays. Stopped.
void cut_apart_flat_piece(const SurfacePiece& part, double max_stretch, std::vector<char>& is_cut,
                          const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
