// A finished map as a Wavefront OBJ with texture coordinates: the format that every other tool
// reads. Exact for degree 1; a map of higher degree is cut into straight pieces that are valid as
// they stand (tessellate_map.h), use write_vtu to keep it.
#pragma once

#include <string>

#include "majorant/io/atomic_file.h"
#include "majorant/io/map_file.h"
#include "majorant/io/tessellate_map.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// The mesh of tessellate_map: with refine = 1, the faces of the input for degree 1, and almost all
// of them for higher degrees.
//
// What the input says of materials, names, groups, colours of vertices, points and lines comes
// back; files of materials, which names relative to the input's folder lead to, are named relative
// to the folder of the output.
//
// Cones of a map with seams stand at the top as comments, one a line, numbered from 0 like vertices
// in pins and reports: `# cone vertex 12 quarter_turns 3`.
//
// Numbers are printed with the digits that give the same double back.
// Throws as tessellate_map, Error(Usage) if the file cannot be written, Error(Invalid) if the map
// is unsound (map_check.h), and what `verify` throws; nothing is written then.
void write_obj(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options = {}, const FileVerification& verify = {});

// The text of an OBJ file: v with colours, vt, vn, then directives and faces in order.
std::string obj_text(const PolygonMesh& mesh);

}  // namespace majorant
