// Reads a surface mesh from a file, the format chosen by the extension (in either case).
//
//   PolygonMesh mesh = read_mesh("camel.obj");
//
//     .obj  v, vt and vn with their own indices, polygons, negative indices, line continuation,
//           colours of vertices; o g s usemtl mtllib and the like, points and lines are kept;
//           curves, free-form surfaces and unknown words are skipped, with a warning
//     .off  OFF and its variants with normals, colours or texture coordinates, which are ignored;
//           line ends are free
//     .ply  ascii, binary of both byte orders; vertex properties x y z, (texture_u, texture_v),
//           (s, t) or (u, v) as texture coordinates, and red green blue; face property
//           vertex_indices or vertex_index, texcoord as coordinates of the corners (MeshLab's);
//           element tristrips with the same, -1 begins a strip; int input_vertex (io.h)
//     .stl  ascii and binary. STL cannot share vertices: corners with exactly equal coordinates
//           become one vertex, numbered by first appearance
//     .vtu  written by majorant (io.h): the corner points, uv as texture coordinates
//     .msh  of gmsh, 2.2 and 4.1, text and binary: the corners of its triangles, of any degree;
//           views u and v as texture coordinates
//     .glb .gltf  glTF 2.0: triangles, strips and fans of all meshes, each once, with the transform
//           of the first node that shows it (skinned meshes without); TEXCOORD_0 as texture
//           coordinates, v upwards; vertices of a mesh at exactly one place are joined. Other
//           content is kept for write_gltf() (io.h). Files that it names are in its folder or below
//     .obj.gz .off.gz ...  the same, compressed by gzip
//
// Readers only check the syntax: finite coordinates, vertex indices in range, polygons with at
// least three corners, at least one vertex and one polygon. SurfaceMesh decides whether the mesh is
// a manifold, oriented or connected. Polygons are not triangulated here.
//
// Other broken parts of OBJ, OFF and PLY are left out, each kind with one of `warnings`, unless the
// Strictness forbids it. Left out are texture coordinates and normals that are not finite. So are
// those of a face with a corner whose index is out of range (the whole face then has none), and
// colours (the vertex then has none). Further parts are a slash after the last index of a corner;
// points and lines with missing vertices; one line more than the header announces. An OFF or a text
// PLY may also end after a complete line of a face, before all announced faces.
//
// Not for arrays in memory: see SurfaceMesh::from_arrays().
#pragma once

#include <string>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns whether a name has one of these extensions.
bool is_mesh_name(const std::string& path);

// Returns the name of a format that is known by its extension but not supported: "FBX" for
// model.fbx. Empty for others.
std::string foreign_format(const std::string& path);

bool has_draco();    // whether this build reads Draco-compressed glTF
bool has_meshopt();  // whether this build reads meshopt-compressed glTF

// The parts of a mesh file that must be intact.
enum class Strictness {
  Shape,       // coordinates and faces
  Texcoords,   // also texture coordinates; faces without any are allowed
  Everything,  // everything in the file
};

// Throws Error(Unreadable, "file:line: what is wrong; remedy") for an unknown extension, a missing
// file, or content that breaks the rules above; Error(Unsupported) for a foreign_format; Stopped. A
// glTF file is Unreadable if it announces more than it has, or if nodes are their own ancestors. It
// is Unsupported for KTX2 images, geometry that this build cannot decode, unknown required
// extensions, and names of files elsewhere.
PolygonMesh read_mesh(const std::string& path, const StopCheck& stop = {},
                      Strictness strictness = Strictness::Shape);

// Reads a map from a file: .vtu, .pvtu, .msh, or a mesh with texture coordinates (degree 1): .obj,
// .ply, .glb or .gltf. In a mesh, everything except texture coordinates may be broken as in
// read_mesh(), unless strictness is Everything. Throws Error(Unreadable) if it cannot be read or
// holds no map, the Error(Unsupported) of read_mesh(); Stopped.
MapFile read_map(const std::string& path, const StopCheck& stop = {},
                 Strictness strictness = Strictness::Texcoords);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
