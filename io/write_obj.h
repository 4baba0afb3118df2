// A finished map as a Wavefront OBJ with texture coordinates: the format that every other tool
// reads. Exact for degree 1; a map of higher degree is sampled, use write_vtu to keep it.
#pragma once

#include <string>

#include "majorant/io/atomic_file.h"
#include "majorant/io/map_file.h"
#include "majorant/parametrization/polygon_mesh.h"

namespace majorant {

// Degree 1 with refine = 1: the input mesh as it was (vertices, also unreferenced ones; polygons
// and their order; groups, materials, normals) with one vt per map point, so that a vertex on a cut
// has several. A polygon that a cut crosses is written as its triangles. Without `input` (null) the
// triangles of mesh_from_map.
//
// Otherwise every cell becomes refine x refine triangles: positions on the flat triangle, vt from
// the map. Samples on an edge are shared by the cells that share it: v by the vertices of the
// surface, vt by the control points of the map, so that the surface stays closed along cuts.
// Vertices of the input keep their numbers; groups and materials are kept, normals are not.
//
// Cones of a map with seams stand at the top as comments, one a line, numbered from 0 like vertices
// in pins and reports: `# cone vertex 12 quarter_turns 3`.
//
// Numbers are printed with the digits that give the same double back.
// Throws Error(Usage) if refine < 1, the result needs more than 2^31 vertices or the file cannot be
// written, Error(Invalid) if the map is unsound (map_check.h) or does not belong to `input`.
void write_obj(const std::string& path, const MapFile& map, const PolygonMesh* input, int refine,
               const FileVerification& verify = {});

// The text of an OBJ file: v, vt, vn, then directives and faces in order.
std::string obj_text(const PolygonMesh& mesh);

}  // namespace majorant
