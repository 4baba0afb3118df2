// Reads a surface mesh from a file, the format chosen by the extension (in either case).
//
//   PolygonMesh mesh = read_mesh("camel.obj");
//
//     .obj  v, vt and vn with their own indices, polygons, negative indices, line continuation,
//           colours of vertices; o g s usemtl mtllib and the like, points and lines are kept;
//           curves, free-form surfaces and unknown words are skipped, which a warning says
//     .off  OFF and its variants with normals, colours or texture coordinates, which are ignored;
//           lines are as the writer liked them
//     .ply  ascii, binary of both byte orders; vertex properties x y z, (texture_u, texture_v),
//           (s, t) or (u, v) as texture coordinates, and red green blue; face property
//           vertex_indices or vertex_index, texcoord as coordinates of the corners (MeshLab's);
//           element tristrips with the same, -1 begins a strip; int input_vertex (io.h)
//     .stl  ascii and binary. STL cannot share vertices: corners with exactly equal coordinates
//           become one vertex, numbered by first appearance
//     .vtu  written by majorant (io.h): the corner points, uv as texture coordinates
//     .msh  of gmsh, 2.2 and 4.1, text and binary: the corners of its triangles, of any degree;
//           views u and v as texture coordinates
//     .glb .gltf  glTF 2.0: triangles, strips and fans of all meshes, each once, where the first
//           node that shows it puts it (a skinned one where it is itself); TEXCOORD_0 as texture
//           coordinates, v upwards; vertices of a mesh at exactly one place are one. All else is
//           kept for write_gltf() (io.h). Files that it names are beside it or below
//     .obj.gz .off.gz ...  the same, compressed by gzip
//
// Readers believe nothing but the syntax: finite coordinates, vertex indices in range, polygons of
// at least three corners, at least one vertex and one polygon. Whether the mesh is a manifold,
// oriented or connected is for SurfaceMesh to say. Polygons are not triangulated here.
//
// Other broken parts of OBJ, OFF and PLY are left out, each kind with one of `warnings`, unless a
// Strictness refuses: texture coordinates and normals that are no finite numbers, and those of a
// face of which a corner has an index of none (the whole face is then without); colours (the vertex
// is then without); a slash behind the last index of a corner; points and lines of vertices that
// are not there; one line more than the header announces. An OFF or a text PLY that ends behind a
// whole line of a face before all faces that its header announces is read with these.
//
// Not for arrays in memory: SurfaceMesh::from_arrays().
#pragma once

#include <string>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns whether the extension of a name is one of these.
bool is_mesh_name(const std::string& path);

// "FBX" for model.fbx: what a format is called that is known by its extension and not read. Empty
// for others.
std::string foreign_format(const std::string& path);

bool has_draco();    // whether this build reads glTF that Draco compressed
bool has_meshopt();  // whether this build reads glTF that meshoptimizer compressed

// The parts of a mesh file that must not be broken.
enum class Strictness {
  Shape,       // coordinates and faces
  Texcoords,   // and texture coordinates: for those who need them; faces may be without
  Everything,  // what is there
};

// Throws Error(Unreadable, "file:line: what is wrong; remedy") for an unknown extension, a missing
// file, or content that breaks the rules above; Error(Unsupported) for a foreign_format; Stopped.
// A glTF file is damaged (Unreadable) where it announces more than it has or nodes are their own
// ancestors; images as KTX2, geometry that this build cannot decode, unknown extensions that it
// requires, and files that it names elsewhere are Unsupported.
PolygonMesh read_mesh(const std::string& path, const StopCheck& stop = {},
                      Strictness strictness = Strictness::Shape);

// A map from a file: .vtu, .pvtu, .msh, or a mesh with texture coordinates (degree 1), .obj, .ply,
// .glb or .gltf. Of a mesh everything but the texture coordinates may be broken, as read_mesh() has
// it, unless strictness is Everything. Throws Error(Unreadable) when it cannot be read or holds no
// map, Error(Unsupported) as read_mesh(); Stopped.
MapFile read_map(const std::string& path, const StopCheck& stop = {},
                 Strictness strictness = Strictness::Texcoords);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
