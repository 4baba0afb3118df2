// All public headers of mesh/: polygons of files, triangles that the library relies on, and the
// repair from one to the other. Not for reading files (io/read_mesh.h). Including a
// single header compiles faster.
//
//   auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
//
// * index_lists.h: lists of indices in one array, such as the corners of polygons
// * polygon_mesh.h: polygons, positions and texture coordinates, unchecked
// * surface_mesh.h: a validated triangle mesh, and half-edges as numbers
// * repair.h: the defects of polygons, a repaired surface, and a list of changes
// * refusal.h: errors with the reason why a mesh is refused, and the remedy
// * seams.h: the cuts of a surface, how their sides fit, and cones
#pragma once

#include "majorant/mesh/index_lists.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/seams.h"
#include "majorant/mesh/surface_mesh.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
