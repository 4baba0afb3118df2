// A flat metric with cones, conformally equivalent to a surface, and its layout in the plane: a
// start for seamless maps.
//
//   std::vector<int> quarter_turns(mesh->vertex_count(), 4);   // but at the cones
//   ConformalMetric metric = conformal_metric(*mesh, quarter_turns);
//   CornerPoints uv = lay_out(*mesh, metric, is_cut);
//
// Every vertex has a log factor u; the length of edge ab is multiplied by exp((u_a + u_b) / 2).
// The factors that give the wanted angle sums minimize a convex function (conformal_energy.h),
// found with Newton's method [SSP08]. Where that breaks triangles, edges are flipped and the
// minimization goes on; the result is read off on the surface's own triangles again
// (intrinsic_triangulation.h), some of which it turns over.
//
// When all angle sums are multiples of 90 degrees and the surface is a sphere or a disk, the two
// images of a cut edge are equal up to rotation by a multiple of 90 degrees and translation
// (mesh/seams.h), whether triangles are turned over or not. On handles the rotation around
// them is whatever it turns out to be.
#pragma once

#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct ConformalMetric {
  Vec log_factor;  // #V: u
  // 3 #F by 2: half-edges 3 f + k of the surface in the metric, each face's in a frame of its own;
  // lengths exp((u_a + u_b) / 2) times the old ones unless edges were flipped, total area that of
  // the surface.
  Points2 edge_vectors;
  double angle_error = 0;  // largest |angle sum - wanted| over interior vertices, radians
  Index broken_faces = 0;  // collapsed, turned over, or violating the triangle inequality
  Index open_faces = 0;    // those among them whose edge vectors do not add up to 0
  Index newton_steps = 0, flips = 0;
};

// quarter_turns: #V, the angle sum wanted at interior vertices in units of 90 degrees, at least 1;
// not read at vertices of the boundary, which all get the same factor (the free boundary of least
// distortion). Throws Error(Usage) when the size is wrong, an interior vertex has no positive angle
// sum, or, on a closed surface, sum(4 - quarter_turns) is not 4 times the Euler characteristic
// (Gauss-Bonnet). A metric that could not be found shows in angle_error; it is always finite.
// Polls before every Newton step: Stopped.
ConformalMetric conformal_metric(const SurfaceMesh& mesh, const std::vector<int>& quarter_turns,
                                 const StopCheck& stop = {});

// The metric laid out over the surface cut open along the half-edges 3 f + k with is_cut (3 #F,
// both sides of an edge or none): u, v of every corner, model units; the areas of all faces, turned
// over or not, add up to the surface's. Corners agree exactly across edges that are not cut, and
// images of cut edges to the rounding of coordinates: edges shrunk by e^-20 keep few digits.
// Without open faces and angle error this is the metric; otherwise what does not fit is spread over
// all edges in the sense of least squares, relative to their lengths. Throws Error(Usage) unless
// the flags have that form and leave one disk.
CornerPoints lay_out(const SurfaceMesh& mesh, const ConformalMetric& metric,
                     const std::vector<char>& is_cut);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
