// All that is wrong with a polygon mesh, or unusual, with counts and places: for reports.
//
//   const MeshDefects found = find_defects(read_mesh("scan.obj"));
//   for (const Defect& d : found.defects) std::cerr << describe(d) << "\n";   // "2 edges have..."
//   for (const ComponentShape& c : found.components) std::cout << c.genus() << "\n";
//
// SurfaceMesh::from_polygons refuses a mesh with any of the kinds before Needle; repair()
// (repair.h) makes it usable, as it does with needles and offsets, and says the same in other
// words. The last three stay as they are: welding is up to the user, and T-junctions are
// boundaries.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

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
  // As Repair::places.
  std::vector<std::array<Index, 2>> places;
};

// "non_manifold_edge": for JSON and messages.
std::string_view name_of(DefectKind kind);
// One line without a full stop, numbers from 1: "2 edges have more than two faces (edge (3, 4),
// ...".
std::string describe(const Defect& defect);

// A component of the repaired surface. What has one side is cut: it has the loops of the cut, too.
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

// Throws Error(Unsupported) for a mesh without faces; Stopped. O(n log n).
MeshDefects find_defects(const PolygonMesh& input, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
