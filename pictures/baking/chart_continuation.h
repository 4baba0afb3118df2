// The surface beyond the edges of a face, and beyond those along which it is cut: what a texture
// has around a chart so that both sides of a cut look alike.
//
//   const ChartContinuation continuation(map.mesh());
//   const SurfacePlace beyond = continuation.at({12, Barycentric(0.7, 0.5, -0.2)});
//
// A point of the plane of a face is carried on by unfolding one neighbour after the other into it:
// across edges that faces share, and across cuts to the face on their other side, which is found by
// the positions of the edge. Beyond the border of the surface, and across edges that more than two
// faces have, lies the nearest point of the last face.
//
// Not for distances of many faces: around a vertex that is not flat it matters which way is taken.
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

  // barycentric: sum 1, of any sign. The result has none below 0.
  SurfacePlace at(const SurfacePlace& place) const;
  // The half-edge on the other side of an edge or a cut; -1 at the border of the surface.
  Index across(Index half_edge) const { return across_[to_size(half_edge)]; }

 private:
  SurfacePlace nearest(Index face, const Vector3& point) const;
  Vector3 corner(Index face, int k) const;

  const SurfaceMesh& mesh_;
  std::vector<Index> across_;  // by half-edge: the one on the other side, of a cut too; or -1
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
