// Cells that are turned around: listed in an order of nodes that makes det J < 0 all over them, as
// clockwise triangles in the plane. Turning one lists its nodes the other way round; it moves none.
//
//   VolumeMesh mesh = read_volume_mesh("plate.msh");
//   mesh = with_cells_turned(mesh, turned_cells(mesh));
//
// Not for cells that moved nodes have turned inside out, which optimize_volume_mesh() untangles:
// these run round their sides as their neighbours do, while cells that are turned do not.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// Returns the cells of most dimensions that must be turned so that in each connected piece all
// cells run round their sides alike and the signed measures of their corners add to more than 0.
// None of pieces where one of these would be a cell with det J > 0, or which have no such order;
// none of surfaces in space.
std::vector<CellName> turned_cells(const VolumeMesh& mesh, const StopCheck& stop = {});

// Returns the mesh with these cells turned, in the numbers and order that it has, and with the
// points in the same places. MFEM's nodes of H1 are numbered by the order of vertices: rows of
// points change there. Throws Error(Unsupported) where the file lists its cells compressed.
VolumeMesh with_cells_turned(const VolumeMesh& mesh, const std::vector<CellName>& cells,
                             const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
