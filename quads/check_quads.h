// Decides whether a quad mesh is one of a given surface, without folded or turned faces. It judges
// for `check` of quad meshes, and for every quad mesh that is written.
//
//   const PolygonMesh quads = read_mesh("spot_quads.obj");
//   const SurfaceMesh surface = SurfaceMesh::from_polygons(read_mesh("spot.obj"));
//   const QuadCheck check = check_quads(quads, &surface);
//   std::cout << check.irregular << " irregular vertices\n";
//   for (const std::string& defect : check.defects) std::cerr << defect << "\n";
//
// With n = (c - a) x (d - b) for the quad a, b, c, d, a corner is folded if (b - a) x (d - a) . n
// <= 0, and likewise at b, c, d. A quad is turned if n . N < 0 for the normal N of the surface's
// face nearest to its centroid, or of any of the nearest faces at an edge or a vertex. There are
// two exceptions, since the centroid of a quad on a thin wall may be nearer to the other side, or
// to another component, while its corners are not. A quad is not turned if all its corners lie on
// the surface, up to a hundredth of the quad, and there is a face with n . N > 0 at each. It is
// turned if n . N < 0 for all faces at three such corners. Signs are exact for the given doubles:
// they are decided in integers where rounding leaves them open.
//
// Not for meshes with other polygons than quads, which are a defect.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/features.h"

namespace majorant {

// The largest distance of a border vertex of a quad mesh from the surface's border, as a part of
// the surface's diagonal.
inline constexpr double kBorderClose = kTenDigits;

// Largest distances of samples between a quad mesh and a surface, in model units.
struct QuadDistance {
  double to_surface = 0;    // of vertices, middles of edges and centroids of quads
  double from_surface = 0;  // of vertices and centroids of the surface's faces from the quads,
                            // which are cut along their first diagonals
};

// The ends of a feature line: vertices of the surface.
struct LineEnds {
  Index from, to;
};

struct QuadCheck {
  // The defects, a sentence each, with faces and vertices from 1; empty if there are none.
  std::vector<std::string> defects;
  // True if the faces are quads of an oriented manifold. The members below, except `count`, are
  // measured only then.
  bool is_surface = false;
  Topology topology;                // of the quads
  Index count = 0;                  // faces
  Index irregular = 0;              // inner vertices of other than 4 quads
  std::vector<Index> folded;        // quads with a folded corner, ascending
  std::vector<Index> turned;        // turned quads, ascending; empty without a surface
  double min_scaled_jacobian = 0;   // least sine of a corner, relative to n
  double mean_scaled_jacobian = 0;  // mean over quads of the least sine of each
  double angle_deviation = 0;       // mean over corners of |angle - 90|, degrees
  QuadDistance hausdorff;           // set if there is a surface
  Index feature_lines = 0;          // number of requested lines of the surface
  std::vector<LineEnds> uncovered;  // not covered by any chain of edges of quads

  bool is_valid() const { return defects.empty(); }
};

// Checks the quads. surface: may be null, then nothing is compared; it may have several components.
// If the quads are no oriented manifold, or other polygons are among them, only that is reported.
// The numbers of components and border loops and the Euler characteristics are compared, also
// component by component in any order. Every border loop of the surface must be followed by one of
// the quads: its vertices lie on the loop, in order, once around, with one at each corner.
// features: 3 #F flags of the surface (features.h), or empty. Every feature line must be covered by
// a chain of edges of quads from corner to corner, whose vertices lie on it in order. border_turn:
// a turn of the surface's border of so many degrees is a corner. Throws InvalidArgument for missing
// vertices or vertices that are not finite; Stopped.
QuadCheck check_quads(const PolygonMesh& quads, const SurfaceMesh* surface,
                      const std::vector<char>& features = {}, const StopCheck& stop = {},
                      double border_turn = kCornerTurn);

// The largest distance of a quad mesh from its surface, as a part of the surface's diagonal.
inline constexpr double kMaxQuadDistance = 0.02;
// Adds a defect if check.hausdorff has a distance above max_distance times the surface's diagonal.
// check: of quads compared with the surface.
void require_near(QuadCheck& check, const SurfaceMesh& surface,
                  double max_distance = kMaxQuadDistance);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
