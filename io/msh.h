// gmsh's mesh files (.msh, version 4.1, ascii), for finite element programs: curved triangles as
// Lagrange triangles of gmsh's own types, values at the points (i, j, k) / n in place of control
// points, to degree 10.
//
//   write_msh("bunny.msh", file, MshContent::Image);      // nodes (u, v, 0)
//   write_msh("bunny.msh", file, MshContent::Surface);    // nodes of the flat surface triangles,
//                                                         // views "u" and "v" over them
//   const MapFile image = read_msh("bunny.msh");
//
// What is written rounds the map (use write_vtu to keep it) and says nothing of seams and claims;
// an image says nothing of the surface. Nodes are numbered as the map's points, elements as its
// cells, from 1; every chart is a surface entity of its own, from 1. Nodes are shared where the map
// is continuous. A surface has two sections of our own behind the views, which gmsh passes over:
//
//     $input_vertex      number of lines, then lines of a node tag and the vertex of the input,
//                        from 0; -1: none
//     $input_face        the same of elements and faces (polygons) of the input
//     $Endinput_face
#pragma once

#include <string>

#include "majorant/framework/stop_check.h"
#include "majorant/io/certification.h"

namespace majorant {

enum class MshContent {
  Image,   // the mesh that the map makes of the plane
  Surface  // the surface's mesh, with the map as two scalar views
};

// A file with views (NodeData) "u" and "v" is a map of the mesh; one without them, whose nodes have
// z = 0, is an image: a map of the flat triangles between its corners, points that share no node
// being apart. Triangles of one degree are read, points and lines passed over. input_vertex and
// input_face are those of the sections above, empty without them; of an image input_vertex numbers
// its nodes, in the order of their tags. uv_rounding says how far the digits may be from uv. Throws
// Error(Unreadable) naming file and line for anything else: other versions, binary files, other
// elements, views that lack nodes, numbers that are not finite; Stopped.
MapFile read_msh(const std::string& path, const StopCheck& stop = {});

// Throws Error(Invalid) if the map is inconsistent or not finite, Error(Unsupported) for degrees
// beyond 10, Error(Usage) if the file cannot be written, and what verify throws. The file appears
// whole or not at all.
void write_msh(const std::string& path, const MapFile& map, MshContent content,
               const FileVerification& verify = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
