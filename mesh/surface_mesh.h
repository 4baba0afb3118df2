// A validated triangle mesh, on which the rest of the library relies.
//
//   SurfaceMesh mesh = SurfaceMesh::from_polygons(read_mesh("bunny.obj"));
//   mesh.require_disk();
//
//   RowMatrix V(4, 3);
//   V << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
//   SurfaceMesh square = SurfaceMesh::from_arrays(V, (Cells(2, 3) << 0, 1, 2, 0, 2, 3).finished());
//
// It is edge- and vertex-manifold, consistently oriented, connected unless the caller permits
// several components, and has no degenerate or duplicate faces. Polygons are triangulated, and
// unreferenced vertices left out; input_vertex() and input_face() return the numbers in the file.
// It is immutable, and one class, since its members read or copy the same lists of faces.
//
// from_polygons() refuses other meshes; repair() (repair.h) repairs them. A repaired mesh may have
// several components, faces without an area, which are measured by rest_triangles(), and an origin
// of its own.
//
// Half-edge 3 f + k runs from corner k of face f to its corner k + 1 (mod 3): see below.
//
// Not for editing: the mesh never changes; cut_along() and split() make new meshes.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Half-edges of oriented triangles, as numbers: the vocabulary of all code on triangles.
//
// Half-edge 3 f + k runs along face f from its corner k to its corner k + 1 (mod 3), the face on
// its left; face and corner are counted from 0.
//
//                c 2                   next(3 f) = 3 f + 1, previous(3 f) = 3 f + 2: around the
//                /\                    *face*, counterclockwise.
//     3 f + 2   /  \   3 f + 1         opposite[3 f] is the half-edge b -> a of the face below,
//              /  f \                  -1 where there is none.
//         a 0 -------- b 1
//               3 f
//
// Both lead around a *vertex*: from a half-edge h that leaves it, opposite[previous(h)] is the next
// one that leaves it counterclockwise, next(opposite[h]) the next one clockwise.
//
// These functions use no positions. A SurfaceMesh stores opposites and boundary loops.

constexpr Index face_of(Index half_edge) { return half_edge / 3; }
constexpr Index corner_of(Index half_edge) { return half_edge % 3; }  // its start

constexpr Index next(Index half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
constexpr Index previous(Index half_edge) {
  return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

// faces: #F by 3 vertices.
inline Index from_vertex(const Cells& faces, Index half_edge) {
  return faces(face_of(half_edge), corner_of(half_edge));
}
inline Index to_vertex(const Cells& faces, Index half_edge) {
  return from_vertex(faces, next(half_edge));
}

// Returns for every half-edge that of the neighbouring face along the same edge, -1 at the boundary
// (3 #F). faces: #F by 3, consistently oriented. Throws InvalidArgument for an edge with more than
// two faces or with two in the same direction, and for a negative vertex. Takes O(#F + largest
// vertex).
std::vector<Index> opposite_half_edges(const Cells& faces);

// Returns the boundary as loops of half-edges, each of which starts where the one before it ends,
// with the surface on the left. A loop starts at its smallest vertex, loops are ordered by that
// vertex. Every vertex must have one fan of faces: see find_touching_vertex.
std::vector<std::vector<Index>> boundary_half_edges(const Cells& faces,
                                                    const std::vector<Index>& opposite);

// Returns for every face the number of its connected component (across edges), numbered by their
// first faces.
std::vector<Index> face_components(const std::vector<Index>& opposite);

// Returns the smallest vertex where sheets of the surface merely touch, so that its faces form
// several fans; -1 if there is none.
Index find_touching_vertex(const Cells& faces, const std::vector<Index>& opposite);

// u, v of the three corners of every face.
using CornerPoints = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

struct Topology {
  Index vertices = 0, edges = 0, faces = 0, components = 0, boundary_loops = 0;
  Index euler_characteristic() const { return vertices - edges + faces; }
};

// Any: the mesh may have several components, such as the layout of an atlas for a proof. A mesh
// that is solved on must be connected.
enum class Components { One, Any };

// Any: faces may have no area, and coordinates too few digits for their edges, since the proof of a
// map reads the image alone. A mesh that is solved on must be Proper. Corners are always three
// different vertices.
enum class Shapes { Proper, Any };

// A rest triangle, which replaces the shape of a face with no area, or hardly any: a triangle in
// the plane, in model units, counterclockwise. Maps are measured against it
// (maps/rest_shapes_of.h).
struct RestTriangle {
  Index face;
  std::array<Vector2, 3> corners;
};

// The parts of a SurfaceMesh, for callers that guarantee its properties: see its members of these
// names.
struct SurfaceParts {
  std::string file;
  Vector3 origin = Vector3::Zero();
  Points3 positions;
  Cells faces;
  std::vector<Index> input_vertex, input_face;
  CornerPoints corner_texcoords;  // or no rows
  Cells texcoord_ids;             // or no rows
  std::vector<RestTriangle> rest_triangles;
};

struct SurfacePiece;

class SurfaceMesh {
 public:
  // Throws Refusal (refusal.h) for the first defect, with place and remedy; for a mesh from a file
  // it names the file and counts from 1. Throws InvalidArgument if the sizes of lists differ, an
  // index is out of range or a position is not finite, and Stopped.
  static SurfaceMesh from_polygons(const PolygonMesh& input, const StopCheck& stop = {},
                                   Components components = Components::One,
                                   Shapes shapes = Shapes::Proper);
  // Makes a mesh from arrays: positions #V by 3, faces #F by 3 (or k, polygons of k corners) with
  // vertices from 0. The arrays are copied once; Eigen::Map passes memory of the caller by rows.
  static SurfaceMesh from_arrays(const Eigen::Ref<const RowMatrix>& positions,
                                 const Eigen::Ref<const Cells>& faces, const StopCheck& stop = {});
  // Accepts any number of components; every vertex must be used. Throws InvalidArgument for an edge
  // with more than two faces or with two in the same direction, for sizes that do not fit and
  // vertices that do not exist. Throws Error(Unsupported) if sheets touch in a vertex.
  static SurfaceMesh from_parts(SurfaceParts parts, const StopCheck& stop = {});
  // Returns copies of the parts from which from_parts() makes this surface.
  SurfaceParts parts() const;

  // Throws Error(Unsupported) unless the surface is a disk (connected, one boundary loop, Euler
  // characteristic 1).
  void require_disk() const;
  // Throws Error(Unsupported) unless the surface is a disk with or without holes: genus 0, bounded.
  void require_planar() const;

  const std::string& file() const { return file_; }
  const Points3& positions() const { return positions_; }  // #V by 3, model units
  // Returns the position in the file. positions() are those of the file minus an origin, which is 0
  // unless repair() chose one that makes the difference exact.
  Vector3 input_position(Index v) const;
  const Vector3& origin() const { return origin_; }
  const Cells& faces() const { return faces_; }  // #F by 3, counterclockwise
  Index vertex_count() const { return static_cast<Index>(positions_.rows()); }
  Index face_count() const { return static_cast<Index>(faces_.rows()); }
  // The index in the file of a vertex, and of the polygon of a face.
  Index input_vertex(Index v) const { return input_vertex_[v]; }
  Index input_face(Index f) const { return input_face_[f]; }
  // Returns the vertex of this mesh for a vertex of the file (the first of several copies), -1 if
  // no face uses it. Takes O(log #V).
  Index find_input_vertex(Index input) const;

  Index half_edge_count() const { return 3 * face_count(); }
  Index from_vertex(Index half_edge) const { return majorant::from_vertex(faces_, half_edge); }
  Index to_vertex(Index half_edge) const { return majorant::to_vertex(faces_, half_edge); }
  // The half-edge of the neighbouring face along the same edge, -1 at the boundary.
  Index opposite(Index half_edge) const { return opposite_[half_edge]; }
  const std::vector<Index>& opposites() const { return opposite_; }  // 3 #F
  double edge_length(Index half_edge) const {
    return (positions_.row(to_vertex(half_edge)) - positions_.row(from_vertex(half_edge))).norm();
  }

  // The boundary loops: vertices in face orientation (surface on the left). A loop starts at its
  // smallest vertex, and loops are ordered by that vertex.
  const std::vector<std::vector<Index>>& boundary_loops() const { return boundary_loops_; }
  std::vector<char> boundary_flags() const;  // #V: 1 on the boundary
  const Topology& topology() const { return topology_; }
  double area() const { return area_; }  // a face with a rest triangle counts with its area
  // The rest triangles of faces that have one, ordered by face; empty unless repair() made some.
  const std::vector<RestTriangle>& rest_triangles() const { return rest_triangles_; }

  // The texture coordinates per face corner (#F by 6: u, v of each) and their numbers in the file
  // (#F by 3); NaN and -1 in faces without any; no rows if no face has any.
  const CornerPoints& corner_texcoords() const { return corner_texcoords_; }
  const Cells& texcoord_ids() const { return texcoord_ids_; }

  // Returns the surface cut open along the half-edges h with is_cut[h] (both sides of an edge, or
  // none). It has the same faces, and a vertex for every fan of faces between cuts. The first copy
  // of a vertex keeps its number. surface_vertex (may be null) receives the vertex of this mesh for
  // each vertex of the result, which may have several components.
  SurfaceMesh cut_along(const std::vector<char>& is_cut, std::vector<Index>* surface_vertex) const;

  // Returns the connected components (across edges), ordered by their first faces; faces and
  // vertices of each keep their order. A connected mesh is its own only piece.
  std::vector<SurfacePiece> split(const StopCheck& stop = {}) const;
  // Returns a mesh with other faces over the same vertices (#F by 3, counterclockwise) and the
  // polygon of the file for each. The caller guarantees that the faces are manifold, connected and
  // use every vertex. Texture coordinates are left out, since they belong to other corners.
  SurfaceMesh with_faces(const Cells& faces, std::vector<Index> input_face) const;

 private:
  SurfaceMesh() = default;
  void build_connectivity(const StopCheck& stop = {});

  std::string file_;
  Vector3 origin_ = Vector3::Zero();
  Points3 positions_;
  Cells faces_;
  std::vector<Index> input_vertex_, input_face_, opposite_;
  std::vector<std::pair<Index, Index>> vertex_of_input_;  // (input, vertex), sorted
  std::vector<std::vector<Index>> boundary_loops_;
  Topology topology_;
  double area_ = 0;
  CornerPoints corner_texcoords_;
  Cells texcoord_ids_;
  std::vector<RestTriangle> rest_triangles_;
};

// A connected component of a mesh.
struct SurfacePiece {
  std::shared_ptr<const SurfaceMesh> mesh;
  std::vector<Index> face, vertex;  // of the original mesh, by those of the piece
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
