// Maps as files: VTU (lossless), Gmsh, OBJ, PLY and glTF, tables of distortion, and the proof that
// a writer runs before a file takes its name. Meshes are read by read_mesh.h.
//
//   const PolygonMesh polygons = read_mesh("bunny.obj");
//   const MapFile map = read_map("bunny.vtu");
//   write_obj("bunny_uv.obj", map, &polygons);
//   write_vtu("copy.vtu", map, certification("copy.vtu", {.surface = &polygons}));
//
// A file appears whole or not at all. Not for pictures and pages, which promise nothing
// (pictures/pictures.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "majorant/certify/map_proof.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/read_mesh.h"
#include "majorant/maps/map_file.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {

// Written means certified: a data file is read back through the public reader and proven before it
// takes its name.
//
//   write_vtu("bunny.vtu", file, certification("bunny.vtu", {.surface = &polygons}));
//
// Not for pictures and pages, which promise nothing.

// Judges the complete bytes of a file before they take its name. The path given is that of another
// file with the same extension. Throws when the file must not be written.
using FileVerification = std::function<void(const std::string& temporary_path)>;

// path: of the file to be, for messages; its extension says how to read. wanted: what must be
// proven; where seams are allowed and the file does not claim any, its cones must not need them
// either. image_of: of a .msh that is an image, the map that it shows: as the image has no surface,
// the map with the image's digits is proven, and the image as a map of the plane. What these refer
// to must outlive the verification. Throws Error(Invalid) naming the file, the question and the
// place when it is not.
FileVerification certification(std::string path, ProofRequest wanted,
                               const MapFile* image_of = nullptr);
// The same of an OBJ, glTF or .vtu whose objects (`o`, meshes of glTF, claims) have layouts of
// their own, which may lie on each other.
FileVerification certification_of_objects(std::string path, ProofRequest wanted);

// The full result as a VTK XML UnstructuredGrid, lossless: read_vtu(write_vtu(map)) gives the same
// doubles. One VTK_BEZIER_TRIANGLE (type 76) per cell for degree >= 2, VTK_TRIANGLE (5) for 1.
//
//     Points               #N by 3 Float64  control points of the flat surface triangles
//     PointData uv         #N by 2 Float64  control points of the map; marked as TCoords
//     PointData input_vertex   #N Int32     vertex of the input mesh, -1 for none
//     PointData cone           #N Int32     quarter turns at cones, every copy; 0 (if present)
//     PointData seam           #N Int32     chain + 1 on seams, else 0 (with seam_edges)
//     CellData  input_face     #F Int32     face of the input mesh
//     CellData  distortion     #F Float64   mean density (if present)
//     CellData  min_det        #F Float64   certified lower bound of det J (if present)
//     CellData  sigma_1, sigma_2, area_distortion, angle_distortion, stretch_l2, stretch_linf
//                              #F Float64   distortion.h (if present, all or none)
//     CellData  chart          #F Int32     piece of an atlas, from 0 (if present)
//     CellData  seam_edges  #F by 3 Int32   edges 01, 12, 20: chain + 1, 0 for none (if present)
//     FieldData majorant_claims  UInt8      JSON, what the file promises (if present)
//
// VTK derives the degree of a triangle from its number of points, so no HigherOrderDegrees are
// written. Arrays are inline base64, uncompressed, little endian, 64-bit headers: any XML parser
// reads them and no bit is lost. Empty optional arrays of the map are left out. Cones and seams
// are there for maps of cut surfaces (mesh/seams.h); `seam` only repeats `seam_edges` for
// viewers, where chains meet the one with the smallest number, and is not read.

// Reads files of write_vtu and of other programs: formats ascii, binary and appended (raw or
// base64), uncompressed or compressed by zlib, one piece, uv with 2 or 3 components (the third is
// dropped), RationalWeights (the array of that name, or the one that PointData's attribute names)
// all equal, HigherOrderDegrees (likewise, of CellData) those of the cells. Values of Lagrange
// cells (types 69 and 22) become control points, uv_rounding says how exactly. Arrays that the file
// lacks stay empty; uv is required. Throws Error(Unreadable) with the reason for anything else:
// other compression, mixed cell types or sizes, inconsistent array sizes, point numbers out of
// range, values that are not finite; Stopped.
MapFile read_vtu(const std::string& path, const StopCheck& stop = {});

// The representation of a curved triangle: uv and Points are its control points, or its values at
// the points (i, j, k) / n (VTK_LAGRANGE_TRIANGLE, type 69). Most programs know the latter, which
// rounds the map: it reads back as another one, some units in the last place away.
enum class VtuCells { Bezier, Lagrange };

// Throws Error(Invalid) if the map is inconsistent or not finite, Error(Unsupported) for Lagrange
// cells of degrees beyond 10, Error(Usage) if the file cannot be written, and what verify throws.
// The file appears whole or not at all.
void write_vtu(const std::string& path, const MapFile& map, VtuCells cells,
               const FileVerification& verify = {});
// Bezier triangles: lossless.
void write_vtu(const std::string& path, const MapFile& map, const FileVerification& verify = {});

// gmsh's mesh files (.msh; 4.1, text is written), for finite element programs: curved triangles as
// Lagrange triangles of gmsh's own types, values at the points (i, j, k) / n in place of control
// points, to degree 10.
//
//   write_msh("bunny.msh", file, MshContent::Image);      // nodes (u, v, 0)
//   write_msh("bunny.msh", file, MshContent::Surface);    // nodes of the flat surface triangles,
//                                                         // views "u" and "v" over them
//   const MapFile image = read_msh("bunny.msh");
//
// Writing rounds the map (write_vtu() keeps it) and leaves out seams and claims; an image leaves
// out the surface. Nodes are numbered as the map's points, elements as its cells, from 1; every
// chart is a surface entity of its own, from 1, and the physical group "chart 0" of that number.
// Nodes are shared where the map is continuous. A surface has two sections of our own behind the
// views, which gmsh passes over:
//
//     $input_vertex      number of lines, then lines of a node tag and the vertex of the input,
//                        from 0; -1: none
//     $input_face        the same of elements and faces (polygons) of the input
//     $Endinput_face

enum class MshContent {
  Image,   // the mesh that the map makes of the plane
  Surface  // the surface's mesh, with the map as two scalar views
};

// A file with views (NodeData) "u" and "v" is a map of the mesh; one without them, whose nodes have
// z = 0, is an image: a map of the flat triangles between its corners, points that share no node
// being apart. Triangles of one degree are read, points and lines passed over. input_vertex and
// input_face are those of the sections above, empty without them; of an image input_vertex numbers
// its nodes, in the order of their tags. uv_rounding says how far the digits may be from uv. Throws
// Error(Unreadable) naming file and line for anything else: versions that are neither 2.2 nor 4.1,
// other elements, views that lack nodes, numbers that are not finite; Stopped.
MapFile read_msh(const std::string& path, const StopCheck& stop = {});

// Throws Error(Invalid) if the map is inconsistent or not finite, Error(Unsupported) for degrees
// beyond 10, Error(Usage) if the file cannot be written, and what verify throws. The file appears
// whole or not at all.
void write_msh(const std::string& path, const MapFile& map, MshContent content,
               const FileVerification& verify = {});

// A finished map as a Wavefront OBJ with texture coordinates: the format that every other tool
// reads. Exact for degree 1; a map of higher degree is cut into straight pieces that are valid as
// they stand, use write_vtu to keep it.
//
//   write_obj("bunny.obj", to_map_file(map), &polygons, {.refine = 2});

// Cells whose corners span a positive triangle in the plane stay one triangle; others are cut, and
// their neighbours along the edges concerned, until every triangle is positive and the triangles
// around every inner vertex turn once. With `input`, the mesh that the map was made from (or null),
// its vertices and polygons come first and stay where they can: with refine = 1 all of them for
// degree 1, almost all for higher degrees.
//
// Materials, names, groups, colours of vertices, points and lines of the input come back; files of
// materials, named relative to the folder of the input, are named relative to the folder of the
// output.
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

// The text of an OBJ file: v with colours, vt, vn, then directives and faces in order; where the
// directives say so, v of every block of the input in front of its faces.
std::string obj_text(const PolygonMesh& mesh);

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

// Throws as write_obj does.
void write_ply(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options = {}, const FileVerification& verify = {});

// A finished map as TEXCOORD_0 of a glTF 2.0 file, for engines and the web: .glb, or .gltf with its
// data in it. As with write_obj, exact for degree 1; a map of higher degree is cut into straight
// pieces.
//
//   const PolygonMesh cup = read_mesh("cup.glb");
//   write_gltf("cup_uv.glb", file, &cup, {}, certification("cup_uv.glb", {.surface = &cup}));
//
// Where the input was glTF, its file comes back with all that it had: nodes, instances, materials,
// skins, morph targets, animations, cameras, extras, points and lines, as they are. Where a
// material shows textures by the old TEXCOORD_0, that becomes the next set, and texCoord of the
// material follows (of a copy of the material where its meshes have other numbers of sets).
// Vertices on cuts are there several times, with their tangents. Images that were beside the input
// are in an output that is in another folder. Of new vertices, on straight pieces of curves, all
// attributes lie between those of the corners.
//
// Other inputs become one mesh, of a primitive for each material of an OBJ, with normals where all
// corners have them, colours where all vertices have one, and _INPUT_VERTEX, the vertex of the
// input (from 0) as two 16-bit numbers, low and high; files with new vertices have that, too.
// Materials have the colour, the opacity and the image of the library (Kd, d; map_Kd, embedded),
// shown by the old coordinates, the second set where they are not the new ones. No names, groups,
// points and lines.
//
// Coordinates are floats, v points downwards: they are rounded first, what is read back is proven.
// Throws as write_obj does, and Error(Invalid) for numbers beyond the range of floats.
void write_gltf(const std::string& path, const MapFile& map, const PolygonMesh* input,
                const TessellationOptions& options = {}, const FileVerification& verify = {});

// The bytes of that file. Throws the same but for what writing does.
std::string gltf_bytes(const std::string& path, const MapFile& map, const PolygonMesh* input,
                       const TessellationOptions& options = {});

// The charts of an atlas as one map file.
//
//   std::vector<MapFile> charts;
//   const MapFile file = joined(charts);
//   write_vtu("bunny.vtu", file);

// charts: of one degree; each with all of the optional arrays or none, as every other. Points in
// the order of the charts; cells in the order of their input_face, as a mesh of the input's faces
// has them; `chart` says which cell belongs to which, numbered on where one has several. No claims.
// Throws InvalidArgument for different degrees, or none.
MapFile joined(const std::vector<MapFile>& charts);
// The map with these cells alone, in this order, and their points.
MapFile with_cells(const MapFile& map, const std::vector<Index>& cells);

// Distortion of the map that a file holds, and as a table.
//
//   MapFile file = read_map("bunny.vtu");
//   const MapDistortion measured = measure_distortion(file);
//   write_distortion("bunny_distortion.csv", file, measured.faces);
//
// Arrays of the file that say so are not looked at.

// In units of the surface (layout_scale()): of its cells on the flat triangles of their corners,
// whether they fit together or not. Throws Error(Unreadable) as layout_scale() does.
MapDistortion measure_distortion(const MapFile& file);

// The same where all numbers are finite, else none: what arrays of a .vtu can hold.
FaceDistortion finite_or_none(const FaceDistortion& faces);

// A line a cell, in the order of the file:
//     input_face,face,chart,sigma_1,sigma_2,area_distortion,angle_distortion,
//         stretch_l2,stretch_linf,area_share (of the area of the surface)
// Numbers of faces and charts from 0; input_face is the polygon of the mesh (the cell itself where
// the file does not say), face the cell; chart is 0 where there are none. 17 digits, inf and nan
// where there is no number. faces: #F by 6. Throws Error(Usage) where it cannot be written.
void write_distortion(const std::string& path, const MapFile& file, const FaceDistortion& faces);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
