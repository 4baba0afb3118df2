// Cells that are turned around: the order of their nodes makes det J < 0 everywhere, as for
// clockwise triangles in the plane. Turning a cell lists its nodes in reflected order and moves
// none.
//
//   VolumeMesh mesh = read_volume_mesh("plate.msh");
//   mesh = with_cells_turned(mesh, turned_cells(mesh));
//
// Not for cells that moved nodes have turned inside out: these run around their sides as their
// neighbours do, which turned cells do not. optimize_volume_mesh() untangles them.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// Returns the cells of the largest dimension that must be turned. In each connected piece all cells
// then run around their sides alike, and the sum of the signed measures at their corners is
// positive. It returns none of a piece in which such a cell has det J > 0, or for which no such
// order exists, and none of surfaces in space.
std::vector<CellName> turned_cells(const VolumeMesh& mesh, const StopCheck& stop = {});

// Returns the mesh with these cells turned; numbers and order of cells, and the places of points,
// stay. In MFEM's files, nodes of H1 are numbered by the order of vertices, so rows of points
// change. Throws Error(Unsupported) if the file's lists of cells are compressed.
VolumeMesh with_cells_turned(const VolumeMesh& mesh, const std::vector<CellName>& cells,
                             const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
