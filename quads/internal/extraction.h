// Places the vertices of quads on the surface, by the rectangles of a seamless map.
//
// Vertices on an arc are evenly spaced: vertex k of n lies at the part k / n of its length. Vertex
// (i, j) inside of a patch is the crossing of two lines: between points i of the lower and upper
// sides, and between points j of the left and right sides,
//     x = x0 + dx y / height,   y = y0 + dy x / width.
// Two lines of different families cross once and lines of one family never, so that all quads of a
// patch are convex in the map.
//
//   SeamlessLattice lattice(*mesh, map);
//   const TMesh t_mesh = trace_t_mesh(lattice);
//   const std::vector<Index> edges(t_mesh.arcs.size(), 1);   // by arc, as Quantization has them
//   ExtractedQuads extracted(lattice, t_mesh, edges);
//   const PolygonMesh polygons = extracted.polygons();
#pragma once

#include <vector>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/quad_connectivity.h"
#include "majorant/quads/internal/smoothing.h"
#include "majorant/quads/internal/t_mesh.h"

namespace majorant {

class ExtractedQuads {
 public:
  // The arguments must outlive this. edges: by arc, see Quantization.
  ExtractedQuads(const SeamlessLattice& lattice, const TMesh& mesh, const std::vector<Index>& edges)
      : lattice_(lattice), mesh_(mesh), edges_(edges), connectivity_(mesh, edges) {}

  // Returns the quads without texture, with positions in the file that the surface came from.
  // Throws Error(Infeasible) if a vertex cannot be placed.
  PolygonMesh polygons();
  // Returns the held vertices of polygons(). Call polygons() first.
  HeldVertices held_vertices();
  const std::vector<Index>& patches() const { return patch_of_; }  // by quad

 private:
  // A point of the surface, and a direction in the chart of its face.
  struct Place {
    Index face;
    LatticePoint at;
    int direction;
  };
  void place_arcs();
  void place_inside(const TPatch& patch, Index first);
  // Moves `place` by a vector whose first axis is the direction of `place`.
  void walk(Place& place, LatticePoint by) const;
  Vector3 position(const Place& place) const;
  BorderPoint held_point(const Place& place) const;

  const SeamlessLattice& lattice_;
  const TMesh& mesh_;
  const std::vector<Index>& edges_;
  QuadConnectivity connectivity_;
  std::vector<std::vector<Place>> places_;  // by arc: points of its edges, one more than edges
  std::vector<Vector3> positions_;
  std::vector<BorderPoint> on_held_;      // before vertices are joined
  std::vector<BorderPoint> held_points_;  // vertices of polygons()
  std::vector<Index> number_;             // in polygons(), by joined vertex
  std::vector<Index> patch_of_;           // by quad
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
