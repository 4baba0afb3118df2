// A finished map as a PLY file with texture coordinates s, t of vertices, for MeshLab, Blender and
// other tools of scanned meshes. As with write_obj, exact for degree 1; a map of higher degree is
// cut into straight pieces that are valid as they stand.
//
//   write_ply("bunny.ply", to_map_file(map), &polygons, {.refine = 2});
//
//     vertex  double x y z, double s t, int input_vertex; uchar red green blue, where all have one
//     face    list vertex_indices
//
// A vertex has one s, t: those on cuts are there several times, at the same place, under the number
// that they have in the OBJ of the same map as `input_vertex` (from 0). Otherwise vertices and
// faces are those of that OBJ, in its order; normals, groups, materials, names, points and lines
// are not kept. Vertices that no face uses have s = t = 0.
//
// Binary, little endian: what is read back is what was written. Cones of a map with seams stand in
// the header as comments: `comment cone vertex 12 quarter_turns 3`.
#pragma once

#include <string>

#include "majorant/io/write_obj.h"

namespace majorant {

// Throws as write_obj does.
void write_ply(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options = {}, const FileVerification& verify = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
