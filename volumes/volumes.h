// All public headers of volumes/: meshes of tetrahedra, hexahedra, wedges, triangles and quads,
// straight or curved; proofs that elements are valid, and their repair. Not for maps of solids that
// a program sets up itself: spaces (elements/elements.h) and energies need no mesh files.
// io/volume_files.h reads and writes files.
//
//   VolumeMesh cells = read_volume_mesh("part.msh");
//   RunRecord record;
//   cells.points = optimize_volume_mesh(cells, {}, record).points;
//   if (check_volume_mesh(cells).is_valid()) write_volume_mesh("better.msh", cells);
//
// * volume_mesh.h: the mesh
// * determinant_range.h: bounds of det J of one element
// * check_volume_mesh.h: the check of all elements and of the sides that they share
// * turned_cells.h: cells that are listed in reflected order, and their repair
// * optimize_volume_mesh.h: untangling and optimization, also by energies of your own
#pragma once

#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/determinant_range.h"
#include "majorant/volumes/optimize_volume_mesh.h"
#include "majorant/volumes/turned_cells.h"
#include "majorant/volumes/volume_mesh.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
