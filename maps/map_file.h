// A finished map as files hold it: what readers give, writers take and `check` judges.
//
//   const MapFile file = to_map_file(map);
//   write_vtu("bunny.vtu", file);
//   const BezierMap again = to_bezier_map(read_map("bunny.vtu"), "bunny.vtu");
//
// Cells are Bezier triangles of one degree n over shared points, local control points in VTK order
// (corners, edges 01, 12, 20, interior recursively). It is deliberately weaker than BezierMap: a
// file written by somebody else may be discontinuous, inverted or inconsistent, and `check` must be
// able to hold it in order to say so.
//
// Not for evaluating or optimizing: to_bezier_map() makes a BezierMap of it, or says why it is
// none.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/maps/bezier_map.h"
#include "majorant/maps/distortion.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

struct MapFile {
  int degree = 1;
  Points3 points;              // #N by 3, control points of the flat surface triangles
  double points_rounding = 0;  // how far each may be from what it was made of (floats of a file)
  Points2 uv;                  // #N by 2, control points of the map
  Points2 uv_rounding;         // #N by 2, how far the digits of the file (decimals; values that uv
                               // was computed from) may be from uv; empty: not at all
  Cells cells;                 // #F by (n+1)(n+2)/2, point numbers in VTK order
  Eigen::VectorXi input_vertex;  // #N, vertex of the input mesh, -1 where there is none
  Eigen::VectorXi input_face;    // #F, face (polygon) of the input mesh, 0-based
  Vec distortion;                // #F, mean density; may be empty
  Vec min_det;                   // #F, certified lower bound of det J; may be empty
  Eigen::VectorXi cone;          // #N, quarter turns at cones (every copy), else 0; may be empty
  Cells seam_edges;              // #F by 3, edges 01, 12, 20: chain + 1, 0 for none; may be empty
  Eigen::VectorXi chart;         // #F, piece of an atlas, 0-based; may be empty
  std::string claims;            // JSON object, what the file promises; may be empty
  // #F by 6, columns as kFaceDistortionNames, at layout_scale(); may be empty.
  FaceDistortion face_distortion;
  std::vector<std::string> warnings;  // what a reader left out, as in PolygonMesh; never written
  // Whether cells are all that the map is to have: false for the layout of a run that was stopped
  // before all charts had a map. Then, of files that have them (OBJ), the polygons without cells,
  // by their vertices.
  bool is_complete = true;
  IndexLists unmapped = {};
  // The polygons of a file, 0-based and rising, that fold for programs that cut them from their
  // first corner (is_unfolded_cut_from), and the quads that fold along the other diagonal alone.
  std::vector<Index> folded = {}, folded_otherwise = {};
};

// Measures (distortion, min_det, face_distortion) and claims are left empty, cone and seam_edges
// too unless the map has seams or cones.
MapFile to_map_file(const BezierMap& map);
// A mesh with texture coordinates as a map of degree 1: one point per (v, vt) pair; input_vertex
// and input_face are the file's own. Polygons are triangulated, so that the triangles are positive
// in the plane if the polygon has such a triangulation. Throws Refusal(Unsupported) for a mesh
// without any texture coordinates, Error(Unreadable) where a face has none, unless the layout is
// said to be partial.
MapFile to_map_file(const PolygonMesh& textured);

// u, v per node of a space over the file's cells, out of its points: points that are one node must
// agree, or Error(Invalid) names the cell.
Vec node_values(const MapFile& file, const BezierTriangleSpace& space, const std::string& name);

// The map a file holds, strictly: throws Error(Unsupported) when the cells are no proper surface
// (as SurfaceMesh has it) and Error(Invalid) where neighbouring cells disagree on a control point.
// Vertices are numbered in the order of the file's points. `name` is for messages.
BezierMap to_bezier_map(const MapFile& file, const std::string& name);

// The mesh as the identity map of itself: points are (u, v, 0), uv the same; points that faces
// share are shared. Vertices are numbered anew; there are no input vertices and faces.
MapFile to_map_file(const BezierMesh& mesh);

// The corner mesh of a map: one triangle per cell, texcoords = the uv of the corner points (one per
// point, so that cuts stay cuts). Where map.input_vertex is known for every corner, vertices have
// the ids of the input mesh, and ids that no cell uses sit at the first corner's position;
// otherwise vertices are the corner points in order. Where map.input_face is known, triangles are
// sorted by it; polygons of the input stay the triangles the map was computed on.
// polygon_lines are cell numbers, 1-based. `map` must be consistent and finite, `file` is for
// messages.
// Throws Error(Unreadable) if an input vertex is at two places or its number is beyond reason.
PolygonMesh mesh_from_map(const MapFile& map, const std::string& file);

// The vertices of the mesh that a map was made from. vertex: for every point its vertex, looked at
// where it is a corner of a cell, not negative there. Vertices without a cell are where some other
// one is. Throws Error(Unreadable) that begins with `name` when copies of a vertex are at different
// places, and for numbers beyond belief.
std::vector<Vector3> vertex_positions(const MapFile& file,
                                      const Eigen::Ref<const Eigen::VectorXi>& vertex,
                                      const std::string& name);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
