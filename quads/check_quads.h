// Is a mesh of quads one of that surface, and is none of its faces folded or turned over? The judge
// behind `check` of quad meshes, and behind every quad mesh that is written.
//
//   const PolygonMesh quads = read_mesh("spot_quads.obj");
//   const SurfaceMesh surface = SurfaceMesh::from_polygons(read_mesh("spot.obj"));
//   const QuadCheck check = check_quads(quads, &surface);
//   std::cout << check.irregular << " irregular vertices\n";
//   for (const std::string& defect : check.defects) std::cerr << defect << "\n";
//
// With n = (c - a) x (d - b) for the quad a, b, c, d: folded are corners with
// (b - a) x (d - a) . n <= 0 and the like at b, c, d. A quad is turned if n . N < 0, N the normal
// of a face of the surface nearest to its centroid (of any of these, where that is nearest to an
// edge or a vertex), unless all of its corners lie on the surface, up to a hundredth of the quad,
// and at each there is a face with n . N > 0; and where n . N < 0 for all faces at three such
// corners. The centroid of a quad on a thin wall may be nearer to the wall's other side, or to
// another component; its corners are not. Signs are those of the doubles, however small: decided in
// integers where rounding leaves them open.
//
// Not for meshes with other polygons than quads: they are a defect.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/quads/features.h"

namespace majorant {

// A border vertex of a quad mesh lies on the surface's border up to this part of its diagonal.
inline constexpr double kBorderClose = kTenDigits;

// Distances between a quad mesh and a surface, the largest of samples, in model units.
struct QuadDistance {
  double to_surface = 0;    // of vertices, middles of edges and centroids of quads
  double from_surface = 0;  // of vertices and centroids of the surface's faces, to the quads, which
                            // are cut along their first diagonals
};

// A feature line by its ends: vertices of the surface.
struct LineEnds {
  Index from, to;
};

struct QuadCheck {
  // What is wrong, a sentence each, faces and vertices from 1: empty where nothing is.
  std::vector<std::string> defects;
  // Whether the faces are quads of an oriented manifold: what follows but `count` is measured then.
  bool is_surface = false;
  Topology topology;                // of the quads
  Index count = 0;                  // faces
  Index irregular = 0;              // inner vertices of other than 4 quads
  std::vector<Index> folded;        // quads with a folded corner, ascending
  std::vector<Index> turned;        // where there is a surface
  double min_scaled_jacobian = 0;   // the least sine of a corner, against n
  double mean_scaled_jacobian = 0;  // the mean over quads of the least one of each
  double angle_deviation = 0;       // mean over corners of |angle - 90|, degrees
  QuadDistance hausdorff;           // where there is a surface
  Index feature_lines = 0;          // of the surface, those asked about
  std::vector<LineEnds> uncovered;  // that no chain of edges of quads covers

  bool is_valid() const { return defects.empty(); }
};

// surface: may be null, then nothing is compared. It may have several components. Where the quads
// are no oriented manifold, or have other polygons among them, nothing but that is found out.
// Compared are the numbers of components and border loops and the Euler characteristics, also of
// the components by themselves, whichever is which; every border loop of the surface is followed by
// one of the quads, whose vertices lie on it, in order, once around, one at each of its corners.
// features: 3 #F flags of the surface (features.h), or empty: every line of them is covered by one
// chain of edges of quads, from corner to corner, whose vertices lie on it, in order.
// Throws InvalidArgument for vertices that do not exist or
// are not finite; Stopped.
// border_turn: degrees, from which on a turn of the surface's border is a corner.
QuadCheck check_quads(const PolygonMesh& quads, const SurfaceMesh* surface,
                      const std::vector<char>& features = {}, const StopCheck& stop = {},
                      double border_turn = kCornerTurn);

// A mesh of quads is near its surface up to this part of the surface's diagonal.
inline constexpr double kMaxQuadDistance = 0.02;
// check: of quads compared with the surface. Adds a defect if check.hausdorff has a distance above
// max_distance times the surface's diagonal.
void require_near(QuadCheck& check, const SurfaceMesh& surface,
                  double max_distance = kMaxQuadDistance);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
