// The pieces that a cut leaves, and the further cuts that make them planar.
#pragma once

#include <vector>

#include "majorant/mesh/connectivity.h"  // is_planar()
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// Returns the faces of every connected component, ascending; components in the order of their first
// faces.
std::vector<std::vector<Index>> component_faces(const std::vector<Index>& opposites);

// Cuts pieces that are closed or have handles until they are planar. is_cut: 3 #F flags, both sides
// of an edge or none; edge_cost: 3 #F.
void open_pieces(const SurfaceMesh& mesh, const Vec& edge_cost, std::vector<char>& is_cut,
                 const StopCheck& stop);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
