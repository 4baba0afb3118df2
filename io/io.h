// All public headers of io/: readers and writers of meshes and maps. A file takes its name after
// it was certified, where that was asked for. Where one of them is enough, include that.
//
//   const PolygonMesh polygons = read_mesh("bunny.obj");
//   const MapFile map = read_map("bunny.vtu");
//   write_obj("bunny_uv.obj", map, &polygons);
//
// * read_mesh.h: OBJ, OFF, PLY and STL; maps of any format
// * vtu.h: maps as VTU: Bezier or Lagrange cells
// * msh.h: maps as Gmsh files
// * write_obj.h: textured triangles or polygons as OBJ
// * write_ply.h: the same as PLY
// * atlas_file.h: charts of an atlas as one file
// * certification.h: a proof that a writer runs before a file takes its name
// * map_distortion.h: distortion of the faces of a file, measured and written
#pragma once

#include "majorant/io/atlas_file.h"
#include "majorant/io/certification.h"
#include "majorant/io/map_distortion.h"
#include "majorant/io/msh.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/vtu.h"
#include "majorant/io/write_obj.h"
#include "majorant/io/write_ply.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
