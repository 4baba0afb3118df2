// A flat metric with cones that is conformally equivalent to a surface, and its layout in the
// plane, which is a start for seamless maps.
//
//   std::vector<int> quarter_turns(mesh->vertex_count(), 4);   // but at the cones
//   ConformalMetric metric = conformal_metric(*mesh, quarter_turns);
//   CornerPoints uv = lay_out(*mesh, metric, is_cut);
//
// Every vertex has a log factor u; the length of edge ab is multiplied by exp((u_a + u_b) / 2). The
// factors of given angle sums minimize a convex function (conformal_energy.h), found with Newton's
// method [SSP08]. Where a step would break triangles, edges are flipped and the minimization goes
// on. The result is transferred back to the surface's own triangles (intrinsic_triangulation.h),
// some of which may be inverted.
//
// On a sphere or a disk whose angle sums are multiples of 90 degrees, the two images of a cut edge
// are equal up to a rotation by a multiple of 90 degrees and a translation (mesh/seams.h). That
// holds even if triangles are inverted. On a surface with handles, the rotation around a
// handle is not prescribed.
#pragma once

#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct ConformalMetric {
  Vec log_factor;  // #V: u
  // 3 #F by 2: half-edges 3 f + k of the surface in the metric, each face in its own frame. Lengths
  // are exp((u_a + u_b) / 2) times the old ones unless edges were flipped; the total area is that
  // of the surface.
  Points2 edge_vectors;
  double angle_error = 0;  // largest error of an angle sum over interior vertices, radians
  Index broken_faces = 0;  // degenerate, inverted, or violating the triangle inequality
  Index open_faces = 0;    // broken faces whose edge vectors do not add up to 0
  Index newton_steps = 0, flips = 0;
};

// Computes the metric. quarter_turns: #V, the target angle sums at interior vertices in units of 90
// degrees, at least 1. Values at boundary vertices are ignored: these all get the same factor, the
// free boundary of least distortion. Throws Error(Usage) if the size is wrong, an interior vertex
// has no positive angle sum, or, on a closed surface, sum(4 - quarter_turns) is not 4 times the
// Euler characteristic (Gauss-Bonnet). If no such metric is found, angle_error says so; it is
// always finite. Polls before every Newton step: Stopped.
ConformalMetric conformal_metric(const SurfaceMesh& mesh, const std::vector<int>& quarter_turns,
                                 const StopCheck& stop = {});

// Lays the metric out over the surface cut along is_cut, and returns u, v of every corner in model
// units.
//
// is_cut: flags of half-edges 3 f + k (3 #F), for both sides of an edge or none. The areas of all
// faces, inverted or not, add up to the surface's. Corners agree exactly across edges that are not
// cut. The images of cut edges agree up to the rounding of coordinates: edges shrunk by e^-20 keep
// few digits.
//
// Without open faces and angle error the layout has the metric exactly; otherwise the error is
// spread over all edges by least squares, relative to their lengths. Throws Error(Usage) unless the
// flags have that form and leave one disk.
CornerPoints lay_out(const SurfaceMesh& mesh, const ConformalMetric& metric,
                     const std::vector<char>& is_cut);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
