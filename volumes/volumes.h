// All public headers of volumes/: meshes of tetrahedra, hexahedra, wedges, triangles and quads,
// straight or curved; which elements are valid, proven, and how they are made so. Not for maps of
// solids that a program puts together: spaces (elements/elements.h) and energies do without meshes
// of files. Files are read and written by io/volume_files.h.
//
//   VolumeMesh cells = read_volume_mesh("part.msh");
//   RunRecord record;
//   cells.points = optimize_volume_mesh(cells, {}, record).points;
//   if (check_volume_mesh(cells).is_valid()) write_volume_mesh("better.msh", cells);
//
// * volume_mesh.h: the mesh
// * determinant_range.h: bounds of det J of one element
// * check_volume_mesh.h: the verdict on all of them, and on the sides that they share
// * turned_cells.h: cells that are listed the wrong way round, and how to turn them
// * optimize_volume_mesh.h: untangled and optimized, by energies of one's own too
#pragma once

#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/determinant_range.h"
#include "majorant/volumes/optimize_volume_mesh.h"
#include "majorant/volumes/turned_cells.h"
#include "majorant/volumes/volume_mesh.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
