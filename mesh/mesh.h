// All public headers of mesh/: polygons as files have them, triangles as the library relies on
// them, and the way from one to the other. Not for reading files (io/read_mesh.h), nor where one of
// them is enough: that compiles faster.
//
//   auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(read_mesh(path)));
//
// * index_lists.h: lists of indices in one array, the corners of polygons
// * polygon_mesh.h: polygons, positions and texture coordinates, unchecked
// * surface_mesh.h: a validated triangle mesh, and half-edges as numbers
// * repair.h: what is wrong with polygons, a surface out of them, and a list of what was changed
// * refusal.h: errors that say why a mesh is refused, and what would help
// * seams.h: where a surface was cut, how the two sides fit, and cones
#pragma once

#include "majorant/mesh/index_lists.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/repair.h"
#include "majorant/mesh/seams.h"
#include "majorant/mesh/surface_mesh.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
