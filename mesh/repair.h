// Makes a surface that the library can work with of any polygon mesh, and lists the changes.
//
//   const RepairedSurface out = repair(read_mesh("scan.obj"));
//   for (const Repair& r : out.repairs) std::cerr << describe(r) << "\n";   // "2 edges of more..."
//   for (const SurfacePiece& piece : out.mesh->split()) std::cout << piece.mesh->area() << "\n";
//
// Nothing is removed and nothing moves, unless an option says so: every polygon of the file is
// there, in order, its vertices where the file has them. Parts that cannot be one surface are
// separated along edges and in vertices. A mesh without defects becomes the same surface as by
// SurfaceMesh::from_polygons, bit for bit. To refuse a defective mesh instead, use that function.
// Not for filling holes or remeshing.
//
//     welded            vertices at one place become one, the first of them: of a file in which no
//                       face shares a vertex with another (STL, soups), else only on request; never
//                       two corners of one face. With Welding::EqualPlaces edges are joined one by
//                       one: two open sides that run against each other between the same places,
//                       where no third one could be meant, and neither face lies where the other
//                       does, corner on corner (cards with two sides)
//     collapsed_edge    with ShortEdges::Collapsed: the ends of an edge that are at one place, to
//                       kTenDigits of the diagonal, become one vertex; polygons that are left with
//                       fewer than three corners are left out
//     repeated_vertex   a face that has a vertex twice is a piece of its own; its corners are three
//                       vertices nevertheless
//     duplicate_face    of faces with the same vertices, turned over or not, the first stays in the
//                       surface; the second ones make a surface of their own, and so on
//     split_edge        an edge with more than two faces is open on all its sides, unless two of
//                       them hang together around both its ends: these stay together. With
//                       CrowdedEdges::Paired the sides of solids that share an edge are joined two
//                       by two, so that each solid stays closed
//     split_vertex      a vertex gets a copy for every further fan of faces; the first fan keeps
//                       it. Counted where sheets merely touch, not where they meet in a split or
//                       cut edge or a face named above
//     turned_face       within a component the fewer faces are turned (of equally many, those that
//                       disagree with its first face). Their corners run 0, 2, 1
//     cut_edge          a component that has only one side (Moebius strip, Klein bottle) is cut
//                       where faces disagree, along short edges; where orientation is AsGiven, all
//                       edges whose faces disagree
//     crossing_polygon  a plane polygon that crosses itself: its triangles, some of which face the
//                       other way, are all there is of it. A file may have them in its place
//     regularized_face  a face without area, or a needle (kNeedleHeight), is measured against a
//                       rest triangle of the same longest edge L and the height kNeedleHeight L.
//                       One whose corners are at one place: equilateral, of kNeedleHeight times the
//                       mean length of the edges of the faces around it
//     moved_to_origin   where coordinates are far from the origin for the size of the mesh
//                       (kFarAway), a point that all of them can be moved by exactly is subtracted
//
// Distortion of regularized faces is that of the map from their rest triangles. They hardly change
// means, since their area is some 1e-6 of their neighbours'. They do change extremes, which show
// how far the map of such a face is from the shape of its rest triangle.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// The height over the longest edge below which a triangle is a needle. The condition of the
// energy's second derivatives on such a face, L / height, times the relative error 1e-16 leaves the
// ten digits with which steps are computed.
inline constexpr double kNeedleHeight = 1e-6;
// The largest coordinate, relative to the extent of the mesh, from which on a mesh is moved to the
// origin: three of sixteen digits are lost there.
inline constexpr double kFarAway = 1e3;

// MadeConsistent: faces that disagree are joined, by turned_face and cut_edge above. AsGiven: the
// orientation has a meaning already, and edges between faces that disagree are open.
enum class Orientation { MadeConsistent, AsGiven };

// ForSolving: needles are regularized and far coordinates moved, as above. AsGiven: only faces
// without area get rest triangles, since without these a map cannot be judged.
enum class Numerics { ForSolving, AsGiven };

// The vertices that are merged if no distance is given. Nothing: none. Soups: those at equal
// positions, if no face shares a vertex with another. EqualPlaces: in all other meshes also those
// of edges between equal positions, as above.
enum class Welding { Nothing, Soups, EqualPlaces };

// The sides of an edge of more than two faces. Open: all are open. Paired: if their pieces have no
// other border, each side is joined with the other side of its piece if there are two; of more
// sides, those are joined that bound the same wedge of the solid's inside.
enum class CrowdedEdges { Open, Paired };

// Edges without a length. Kept: their faces are measured against rest triangles. Collapsed: as
// collapsed_edge above, for surfaces that need not keep every face of the file.
enum class ShortEdges { Kept, Collapsed };

struct RepairOptions {
  // The distance up to which vertices are merged; 0: equal positions; none: as `welding` says.
  std::optional<double> weld = std::nullopt;
  Welding welding = Welding::Soups;
  Orientation orientation = Orientation::MadeConsistent;
  Numerics numerics = Numerics::ForSolving;
  CrowdedEdges crowded_edges = CrowdedEdges::Open;
  ShortEdges short_edges = ShortEdges::Kept;
};

enum class RepairKind {
  Welded,
  RepeatedVertex,
  DuplicateFace,
  SplitEdge,
  SplitVertex,
  TurnedFace,
  CutEdge,
  CrossingPolygon,
  RegularizedFace,
  MovedToOrigin,
  CollapsedEdge
};

struct Repair {
  RepairKind kind;
  Index count;
  // The first kNamedPlaces places, in numbers of the file from 0: a vertex or a face (polygon), or
  // the two ends of an edge; -1 if there is no second number. Empty for MovedToOrigin.
  std::vector<std::array<Index, 2>> places;
  // Welded: the number of pieces (connected across edges) of the given mesh, and of the surface.
  std::optional<std::array<Index, 2>> pieces = std::nullopt;
};
// The maximum number of places in a message: the lines of a screen.
inline constexpr std::size_t kNamedPlaces = 24;

// Returns the name in the list above, for JSON and messages.
std::string_view name_of(RepairKind kind);
// Returns one line without a full stop, with numbers from 1 as in files: "3 faces turned (faces 2,
// 7, 9)".
std::string describe(const Repair& repair);

struct RepairedSurface {
  // May have any number of components. Copies of a vertex have the same input_vertex() and come
  // after all vertices of the file. A welded vertex is the first of its vertices.
  std::shared_ptr<const SurfaceMesh> mesh;
  // #F by 3: the corner of its polygon for every corner of a face.
  Cells polygon_corner;
  // For each vertex of the file the vertex to which it was welded, or itself.
  std::vector<Index> welded;
  std::vector<char> texture_seams;  // 3 #F, both sides: the file's texture coordinates differ
  std::vector<Repair> repairs;      // one per kind, in the order above; empty: no defects
  Index one_sided = 0;              // components that cut_edge opened
  Index cut_edges = 0;              // by cut_edge
  double cut_length = 0;            // of cut_edges, model units
  // The number of vertices exactly at a smaller vertex that were not welded to it.
  Index coincident_left = 0;
};

// Throws Error(Unsupported) for a mesh without faces, and for a RepairOptions::weld longer than the
// shortest edge of most faces, which would tear these apart; throws Stopped. Takes O(n log n).
RepairedSurface repair(const PolygonMesh& input, const RepairOptions& options = {},
                       const StopCheck& stop = {});

// Returns the polygons of the file, in the form for writers. Vertices welded from different
// positions are replaced by the first of them.
PolygonMesh with_welded_vertices(PolygonMesh input, const RepairedSurface& surface);

// The defects and unusual properties of a polygon mesh, with counts and places: for reports.
//
//   const MeshDefects found = find_defects(read_mesh("scan.obj"));
//   for (const Defect& d : found.defects) std::cerr << describe(d) << "\n";   // "2 edges have..."
//   for (const ComponentShape& c : found.components) std::cout << c.genus() << "\n";
//
// SurfaceMesh::from_polygons refuses a mesh with any of the kinds before Needle. repair() repairs
// these, needles and offsets, and has other texts for them. It leaves the last three kinds: the
// user decides on welding, and T-junctions are boundaries.

enum class DefectKind {
  Soup,                // no face shares a vertex with another: count 1
  RepeatedVertex,      // faces that have a vertex twice
  DuplicateFace,       // faces with the same vertices as one before them, turned over or not
  NonManifoldEdge,     // edges with more than two faces
  NonManifoldVertex,   // vertices where sheets touch, other than at such edges and faces
  InconsistentFace,    // faces against the majority of their component
  OneSided,            // Moebius strips and the like: components; places are edges to cut
  CrossingPolygon,     // plane polygons that cross themselves
  ZeroArea,            // faces with a height below 1e-12 of their longest edge
  Needle,              // below kNeedleHeight (repair.h); these are not refused
  FarFromOrigin,       // coordinates that leave few digits to the mesh: count 1
  CoincidentVertices,  // vertices exactly where a smaller one is, not welded
  TJunction,           // boundary vertices on the inside of a boundary edge
  IsolatedVertex       // vertices without a face
};

struct Defect {
  DefectKind kind;
  Index count;
  // The first places, as in Repair::places.
  std::vector<std::array<Index, 2>> places;
};

// Returns "non_manifold_edge" etc., for JSON and messages.
std::string_view name_of(DefectKind kind);
// Returns one line without a full stop, with numbers from 1: "2 edges have more than two faces
// (edge (3, 4), ...".
std::string describe(const Defect& defect);

// A component of the repaired surface. A surface with one side is cut, and has the loops of the
// cut, too.
struct ComponentShape {
  Index first_face;  // polygon of the file
  Index faces;       // triangles
  Index boundary_loops, euler_characteristic;
  Index genus() const { return (2 - boundary_loops - euler_characteristic) / 2; }
};

struct MeshDefects {
  std::vector<Defect> defects;  // one per kind, in the order above
  std::vector<ComponentShape> components;
};

// Throws Error(Unsupported) for a mesh without faces; throws Stopped. Takes O(n log n).
MeshDefects find_defects(const PolygonMesh& input, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
