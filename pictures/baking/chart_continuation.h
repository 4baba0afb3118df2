// Continues a surface beyond the edges of a face and beyond its cuts, for the values of a texture
// around a chart.
//
//   const ChartContinuation continuation(map.mesh());
//   const SurfacePlace beyond = continuation.at({12, Barycentric(0.7, 0.5, -0.2)});
//
// A point of the plane of a face is moved on by unfolding one neighbour after the other into that
// plane. The path goes across shared edges, and across cuts to the face on their other side, found
// by the positions of the edge. Beyond the border of the surface, and across edges with more than
// two faces, the result is the nearest point of the last face.
//
// Not for distances of many faces: around a vertex that is not flat, the result depends on the
// path.
#pragma once

#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

// A point of a surface.
struct SurfacePlace {
  Index face = -1;
  Barycentric barycentric = Barycentric::Zero();
};

class ChartContinuation {
 public:
  // Keeps a reference to the mesh. O(#F log #F).
  explicit ChartContinuation(const SurfaceMesh& mesh);

  // barycentric: sum 1, of any sign. Those of the result are not negative.
  SurfacePlace at(const SurfacePlace& place) const;
  // Returns the half-edge on the other side of an edge or a cut; -1 at the border of the surface.
  Index across(Index half_edge) const { return across_[to_size(half_edge)]; }

 private:
  SurfacePlace nearest(Index face, const Vector3& point) const;
  Vector3 corner(Index face, int k) const;

  const SurfaceMesh& mesh_;
  std::vector<Index> across_;  // by half-edge: the other side, also across a cut; or -1
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
