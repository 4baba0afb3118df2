// A seamless map out of a file: files hold points and who shares them; seams, rotations and cones
// follow from that.
#pragma once

#include <string>

#include "majorant/io/map_file.h"

namespace majorant {

// The map of the cut surface that a file holds. The surface is put together from the points of
// equal input_vertex and cut along the edges whose cells do not share their points (at degree 1 the
// corners, else the inner points). Faces are in the order of the file's cells, input_vertex() and
// input_face() of the mesh are those of the file. Turns are the ones that fit best, cones have the
// nearest number of quarter turns to the sum of their angles: neither residual nor angles nor
// orientation are judged here, measure() and seam_residual() do that. `name` is for messages.
//
// Throws Error(Invalid) when the file does not say which points are copies of a vertex, when the
// sides of a seam do not fit to kSeamTolerance (seamless_start.h) after a quarter turn and a
// translation, or when neighbouring cells share some points of an edge and others not;
// Error(Unsupported) when the cells are no proper surface (mesh_validation.h); Error(Unreadable)
// when copies of a vertex are at different places.
BezierMap to_seamless_map(const MapFile& file, const std::string& name);

// Whether a vertex of the input has several points: whether the map is cut.
bool is_cut(const MapFile& file);

}  // namespace majorant
