// A finished map as a Wavefront OBJ with texture coordinates: the format that every other tool
// reads. Exact for degree 1; a map of higher degree is cut into straight pieces that are valid as
// they stand, use write_vtu to keep it.
//
//   write_obj("bunny.obj", to_map_file(map), &polygons, {.refine = 2});
#pragma once

#include <string>

#include "majorant/io/certification.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {

// Cells whose corners span a positive triangle in the plane stay one triangle; others are cut, and
// their neighbours along the edges concerned, until every triangle is positive and the triangles
// around every inner vertex turn once. With `input`, the mesh that the map was made from (or null),
// its vertices and polygons come first and stay where they can: with refine = 1 all of them for
// degree 1, almost all for higher degrees.
//
// What the input says of materials, names, groups, colours of vertices, points and lines comes
// back; files of materials, which names relative to the input's folder lead to, are named relative
// to the folder of the output.
//
// Cones of a map with seams stand at the top as comments, one a line, numbered from 0 like vertices
// in pins and reports: `# cone vertex 12 quarter_turns 3`.
//
// Numbers are printed with the digits that give the same double back.
// Throws Error(Usage) if refine < 1, the result needs more than 2^31 vertices or the file cannot be
// written; Error(Invalid) if the map is inconsistent or not finite, does not belong to `input`, or
// naming cells for which no such triangles are found; and what `verify` throws. Nothing is written
// then.
void write_obj(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options = {}, const FileVerification& verify = {});

// The text of an OBJ file: v with colours, vt, vn, then directives and faces in order.
std::string obj_text(const PolygonMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
