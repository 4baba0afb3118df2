// A finished map as stored in files: the result of readers, and the input of writers and of
// `check`.
//
//   const MapFile file = to_map_file(map);
//   write_vtu("bunny.vtu", file);
//   const BezierMap again = to_bezier_map(read_map("bunny.vtu"), "bunny.vtu");
//
// Cells are Bezier triangles of one degree n over shared points, local control points in VTK order
// (corners, edges 01, 12, 20, interior recursively). MapFile is deliberately weaker than BezierMap:
// files of other programs may be discontinuous, inverted or inconsistent, and `check` must be able
// to represent them in order to report it.
//
// For evaluation or optimization, to_bezier_map() converts it to a BezierMap, or throws the reason
// why it is none.
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
  double points_rounding = 0;  // largest error of each point (floats of a file)
  Points2 uv;                  // #N by 2, control points of the map
  // #N by 2, largest distance of uv from the file's digits (decimals, or values from which uv was
  // computed); empty: none.
  Points2 uv_rounding;
  Cells cells;                   // #F by (n+1)(n+2)/2, point numbers in VTK order
  Eigen::VectorXi input_vertex;  // #N, vertex of the input mesh, -1 for none
  Eigen::VectorXi input_face;    // #F, face (polygon) of the input mesh, 0-based
  Vec distortion;                // #F, mean density; may be empty
  Vec min_det;                   // #F, certified lower bound of det J; may be empty
  Eigen::VectorXi cone;          // #N, quarter turns at cones (every copy), else 0; may be empty
  Cells seam_edges;              // #F by 3, edges 01, 12, 20: chain + 1, 0 for none; may be empty
  Eigen::VectorXi chart;         // #F, piece of an atlas, 0-based; may be empty
  std::string claims;            // JSON object, the file's claims; may be empty
  // #F by 6, columns as kFaceDistortionNames, at layout_scale(); may be empty.
  FaceDistortion face_distortion;
  std::vector<std::string> warnings;  // data that a reader left out; never written
  // False if the map lacks cells, as in the layout of a run that was stopped before all charts had
  // a map. `unmapped` then has the polygons without cells by their vertices, in formats that store
  // them (OBJ).
  bool is_complete = true;
  IndexLists unmapped = {};
  // The polygons of a file, 0-based and ascending, that fold in programs that cut them from their
  // first corner (is_unfolded_cut_from), and the quads that fold only along the other diagonal.
  std::vector<Index> folded = {}, folded_otherwise = {};
};

// Converts a map. Measures (distortion, min_det, face_distortion) and claims are left empty, as are
// cone and seam_edges unless the map has seams or cones.
MapFile to_map_file(const BezierMap& map);
// Converts a mesh with texture coordinates to a map of degree 1 with one point per (v, vt) pair.
// input_vertex and input_face are those of the file. Polygons are triangulated, if possible so that
// the triangles are positive in the plane. Throws Refusal(Unsupported) for a mesh without any
// texture coordinates. Throws Error(Unreadable) if a face has none, unless the layout is marked as
// partial.
MapFile to_map_file(const PolygonMesh& textured);

// Returns u, v per node of a space over the file's cells. Points that belong to one node must
// agree, or Error(Invalid) names the cell.
Vec node_values(const MapFile& file, const BezierTriangleSpace& space, const std::string& name);

// Returns the map that a file holds, strictly. Throws Error(Unsupported) if the cells are no proper
// surface (as in SurfaceMesh), and Error(Invalid) if neighbouring cells disagree on a control
// point. Vertices are numbered in the order of the file's points. name: for messages.
BezierMap to_bezier_map(const MapFile& file, const std::string& name);

// Converts a mesh to the identity map of itself: points are (u, v, 0), with the same uv; points
// that faces share are shared. Vertices are renumbered; there are no input vertices and faces.
MapFile to_map_file(const BezierMesh& mesh);

// Returns the corner mesh of a map: one triangle per cell, with one texture coordinate per corner
// point, so that cuts stay cuts. If map.input_vertex is known for every corner, vertices have the
// numbers of the input mesh, and numbers that no cell uses get the first corner's position.
// Otherwise vertices are the corner points in order.
//
// If map.input_face is known, triangles are sorted by it; polygons of the input remain the
// triangles on which the map was computed. polygon_lines are cell numbers, 1-based. map: consistent
// and finite. file: for messages. Throws Error(Unreadable) if an input vertex is at two places or
// its number is implausibly large.
PolygonMesh mesh_from_map(const MapFile& map, const std::string& file);

// Returns the vertices of the mesh from which a map was made. vertex: the vertex of every point,
// read at corners of cells, where it must not be negative. Vertices without a cell get the position
// of some other vertex. Throws Error(Unreadable) that begins with `name` if copies of a vertex are
// at different places, or for implausibly large numbers.
std::vector<Vector3> vertex_positions(const MapFile& file,
                                      const Eigen::Ref<const Eigen::VectorXi>& vertex,
                                      const std::string& name);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
