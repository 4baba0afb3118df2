// Reads and writes maps: VTU (lossless), Gmsh, OBJ, PLY and glTF; writes tables of distortion;
// makes the proof that precedes every output file. read_mesh.h reads meshes.
//
//   const PolygonMesh polygons = read_mesh("bunny.obj");
//   const MapFile map = read_map("bunny.vtu");
//   write_obj("bunny_uv.obj", map, &polygons);
//   write_vtu("copy.vtu", map, certification("copy.vtu", {.surface = &polygons}));
//
// A file appears whole or not at all. Not for pictures and pages, which make no claims
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

// Every data file is certified: it is read back through the public reader, and proven before it
// gets its name.
//
//   write_vtu("bunny.vtu", file, certification("bunny.vtu", {.surface = &polygons}));
//
// Not for pictures and pages, which make no claims.

// Judges the complete bytes of a file, which has a temporary name with the same extension. Throws
// if the file must not be written.
using FileVerification = std::function<void(const std::string& temporary_path)>;

// path: of the output, for messages; its extension selects the reader. required: the properties to
// prove. If it allows seams and the file claims none, its cones must not require any. image_of: for
// a .msh that holds an image, the map. Both the map with the image's digits and the image as a map
// of the plane are proven. Referents must outlive the verification. Throws Error(Invalid) naming
// the file, the question and the place.
FileVerification certification(std::string path, ProofRequest required,
                               const MapFile* image_of = nullptr);
// Returns the same for an OBJ, glTF or .vtu whose objects (`o`, meshes of glTF, claims) have
// separate layouts, which may overlap each other.
FileVerification certification_of_objects(std::string path, ProofRequest required);

// Writes the full result as a VTK XML UnstructuredGrid, without loss: read_vtu(write_vtu(map))
// gives the same doubles. Cells are VTK_BEZIER_TRIANGLE (type 76) for degree >= 2, VTK_TRIANGLE (5)
// for degree 1.
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
//     FieldData majorant_claims  UInt8      JSON, the claims of the file (if present)
//
// VTK derives the degree of a triangle from its number of points, so no HigherOrderDegrees are
// written. Arrays are inline base64, uncompressed, little endian, with 64-bit headers. Any XML
// parser reads them, and no bit is lost. Empty optional arrays of the map are left out. Maps of cut
// surfaces have cones and seams (mesh/seams.h). `seam` only repeats `seam_edges` for viewers, with
// the smallest number where chains meet, and is not read.

// Reads files of write_vtu and of other programs. Formats are ascii, binary and appended (raw or
// base64), uncompressed or compressed by zlib, in one piece. uv has 2 or 3 components (the third is
// dropped). RationalWeights must be equal, HigherOrderDegrees those of the cells; both are found by
// name, or by the attribute of PointData or CellData. Values of Lagrange cells (types 69 and 22)
// are converted to control points; uv_rounding says how exactly. Arrays that the file lacks stay
// empty; uv is required. Throws Error(Unreadable) for anything else: other compression, mixed cell
// types or sizes, inconsistent array sizes, point numbers out of range, values that are not finite;
// Stopped.
MapFile read_vtu(const std::string& path, const StopCheck& stop = {});

// The representation of curved triangles. Bezier: uv and Points are control points. Lagrange: they
// are values at (i, j, k) / n (VTK_LAGRANGE_TRIANGLE, type 69). More programs know the latter, but
// it rounds the map, which reads back with errors of some units in the last place.
enum class VtuCells { Bezier, Lagrange };

// Throws Error(Invalid) if the map is inconsistent or not finite, Error(Unsupported) for Lagrange
// cells of degrees beyond 10, Error(Usage) if the file cannot be written, and the errors of verify.
// The file appears whole or not at all.
void write_vtu(const std::string& path, const MapFile& map, VtuCells cells,
               const FileVerification& verify = {});
// Writes Bezier triangles, without loss.
void write_vtu(const std::string& path, const MapFile& map, const FileVerification& verify = {});

// Writes gmsh files (.msh, 4.1, text) for finite element programs. Curved triangles become gmsh's
// Lagrange triangles up to degree 10, with values at (i, j, k) / n instead of control points.
//
//   write_msh("bunny.msh", file, MshContent::Image);      // nodes (u, v, 0)
//   write_msh("bunny.msh", file, MshContent::Surface);    // nodes of the flat surface triangles,
//                                                         // views "u" and "v" over them
//   const MapFile image = read_msh("bunny.msh");
//
// Writing rounds the map (write_vtu() keeps it) and leaves out seams and claims; an image leaves
// out the surface. Nodes have the numbers of the map's points, elements those of its cells, from 1.
// Every chart is a surface entity, from 1, and the physical group "chart 0" and so on. Nodes are
// shared where the map is continuous. A surface has two sections of our own after the views, which
// gmsh skips:
//
//     $input_vertex      number of lines, then lines of a node tag and the vertex of the input,
//                        from 0; -1: none
//     $input_face        likewise, element tags and faces (polygons) of the input
//     $Endinput_face

enum class MshContent {
  Image,   // the mesh that the map makes of the plane
  Surface  // the surface's mesh, with the map as two scalar views
};

// Reads a file with views (NodeData) "u" and "v" as a map of its mesh. A file without them, whose
// nodes have z = 0, is an image: a map of the flat triangles between its corners, which are
// separate if they share no node. Triangles must have one degree; points and lines are skipped.
// input_vertex and input_face are those of the sections above, or empty; for an image input_vertex
// numbers its nodes by ascending tags. uv_rounding bounds the distance of the digits from uv.
// Throws Error(Unreadable) naming file and line for anything else: versions other than 2.2 and 4.1,
// other elements, views that lack nodes, numbers that are not finite; Stopped.
MapFile read_msh(const std::string& path, const StopCheck& stop = {});

// Throws Error(Invalid) if the map is inconsistent or not finite, Error(Unsupported) for degrees
// beyond 10, Error(Usage) if the file cannot be written, and the errors of verify. The file appears
// whole or not at all.
void write_msh(const std::string& path, const MapFile& map, MshContent content,
               const FileVerification& verify = {});

// Writes a finished map as a Wavefront OBJ with texture coordinates, which every other tool reads.
// Exact for degree 1. A map of higher degree is cut into valid straight pieces; use write_vtu to
// keep the curves.
//
//   write_obj("bunny.obj", to_map_file(map), &polygons, {.refine = 2});

// Cells whose corners span a positive triangle in the plane stay one triangle. Others are cut, and
// so are their neighbours along the same edges, until every triangle is positive and the triangles
// around every inner vertex turn once. With `input`, the mesh that the map was made from (may be
// null), its vertices and polygons come first. With refine = 1 all of them stay for degree 1,
// almost all for higher degrees.
//
// Materials, names, groups, vertex colours, points and lines of the input are kept. Names of
// material files are adapted to the folder of the output.
//
// Cones of a map with seams are comments at the top, one a line, numbered from 0 like vertices in
// pins and reports: `# cone vertex 12 quarter_turns 3`.
//
// Numbers have the digits that give the same double back. Throws Error(Usage) if refine < 1, if the
// result needs more than 2^31 vertices, or if the file cannot be written. Throws Error(Invalid) if
// the map is inconsistent or not finite, does not belong to `input`, or has cells (named in the
// message) without such triangles. Throws the errors of `verify`. Nothing is written then.
void write_obj(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options = {}, const FileVerification& verify = {});

// Returns the text of an OBJ file: v with colours, vt, vn, then directives and faces in order. If
// the directives require it, v of every block of the input precede its faces.
std::string obj_text(const PolygonMesh& mesh);

// Writes a finished map as a PLY file with texture coordinates s, t of vertices, for MeshLab,
// Blender and other tools for scanned meshes. Exact for degree 1; a map of higher degree is cut
// into straight pieces, see write_obj.
//
//   write_ply("bunny.ply", to_map_file(map), &polygons, {.refine = 2});
//
//     vertex  double x y z, double s t, int input_vertex; uchar red green blue, if all have one
//     face    list vertex_indices
//
// A vertex has one s, t. Vertices on cuts are repeated, at the same place, and `input_vertex` (from
// 0) is their number in the OBJ of the same map. Otherwise vertices and faces are those of that
// OBJ, in its order. Normals, groups, materials, names, points and lines are not kept. Vertices
// without faces have s = t = 0.
//
// The file is binary, little endian, and reads back unchanged. Cones of a map with seams are
// comments in the header: `comment cone vertex 12 quarter_turns 3`.

// Throws the errors of write_obj.
void write_ply(const std::string& path, const MapFile& map, const PolygonMesh* input,
               const TessellationOptions& options = {}, const FileVerification& verify = {});

// Writes a finished map as TEXCOORD_0 of a glTF 2.0 file, for engines and the web: .glb, or .gltf
// with embedded data. Exact for degree 1; a map of higher degree is cut into straight pieces, see
// write_obj.
//
//   const PolygonMesh cup = read_mesh("cup.glb");
//   write_gltf("cup_uv.glb", file, &cup, {}, certification("cup_uv.glb", {.surface = &cup}));
//
// If the input was glTF, everything in it is kept: nodes, instances, materials, skins, morph
// targets, animations, cameras, extras, points and lines. If a material shows textures by the old
// TEXCOORD_0, that becomes the next set, and texCoord follows (in a copy of the material, if its
// meshes have different numbers of sets). Vertices on cuts are repeated, with their tangents.
// Images beside the input are embedded if the output is in another folder. Attributes of new
// vertices, on straight pieces of curves, lie between those of the corners.
//
// Other inputs become one mesh, with a primitive for each material of an OBJ. It has normals if all
// corners have them, colours if all vertices have one, and _INPUT_VERTEX, the vertex of the input
// (from 0) as two 16-bit numbers, low and high. Files with new vertices have that, too. Materials
// get the colour, the opacity and the image of the library (Kd, d; map_Kd, embedded). Images are
// shown by the old coordinates, which are the second set if they differ from the new ones. Names,
// groups, points and lines are not kept.
//
// Coordinates are floats, and v points downwards: values are rounded first, and the file is proven
// as it reads back. Throws the errors of write_obj, and Error(Invalid) for numbers beyond the range
// of floats.
void write_gltf(const std::string& path, const MapFile& map, const PolygonMesh* input,
                const TessellationOptions& options = {}, const FileVerification& verify = {});

// Returns the bytes of that file. Throws the same errors, except those of writing.
std::string gltf_bytes(const std::string& path, const MapFile& map, const PolygonMesh* input,
                       const TessellationOptions& options = {});

// Joins the charts of an atlas to one map file.
//
//   std::vector<MapFile> charts;
//   const MapFile file = joined(charts);
//   write_vtu("bunny.vtu", file);

// charts: of one degree; an optional array must be in all of them or in none. Points are in the
// order of the charts, cells in the order of their input_face. `chart` is the chart of each cell;
// charts with several parts are numbered consecutively. There are no claims. Throws InvalidArgument
// for different degrees, or no charts.
MapFile joined(const std::vector<MapFile>& charts);
// Returns the map with these cells alone, in this order, and their points.
MapFile with_cells(const MapFile& map, const std::vector<Index>& cells);

// Measures the distortion of the map in a file, and writes it as a table.
//
//   MapFile file = read_map("bunny.vtu");
//   const MapDistortion measured = measure_distortion(file);
//   write_distortion("bunny_distortion.csv", file, measured.faces);
//
// Stored arrays of distortions are not used.

// Measures in units of the surface (layout_scale()), cell by cell on the flat triangles of the
// corners, whether the cells fit together or not. Throws the Error(Unreadable) of layout_scale().
MapDistortion measure_distortion(const MapFile& file);

// Returns the same if all numbers are finite, which arrays of a .vtu require, else none.
FaceDistortion finite_or_none(const FaceDistortion& faces);

// The table has a line for each cell, in the order of the file:
//     input_face,face,chart,sigma_1,sigma_2,area_distortion,angle_distortion,
//         stretch_l2,stretch_linf,area_share (of the area of the surface)
// Faces and charts are numbered from 0. input_face is the polygon of the mesh (the cell if
// unknown), face the cell; chart is 0 if there are none. Numbers have 17 digits, or are inf or nan.
// faces: #F by 6. Throws Error(Usage) if the file cannot be written.
void write_distortion(const std::string& path, const MapFile& file, const FaceDistortion& faces);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
