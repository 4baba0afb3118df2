// A flat metric with cones, conformally equivalent to a surface, and its layout in the plane: a
// start for seamless maps.
//
//   ConformalMetric metric = conformal_metric(mesh, quarter_turns);  // 4 but at the cones
//   CornerPoints uv = lay_out(mesh, metric, is_cut);
//
// Every vertex has a log factor u; the length of edge ab is multiplied by exp((u_a + u_b) / 2).
// The factors that give the wanted angle sums minimize a convex function (conformal_energy.h),
// found with Newton's method [SSP08]. When all angle sums are multiples of 90 degrees and the
// surface is a sphere or a disk, the two images of a cut edge are equal up to rotation by a
// multiple of 90 degrees and translation (constraints/seams.h). On handles the rotation around them
// is whatever it turns out to be.
#pragma once

#include <vector>

#include "majorant/framework/types.h"
#include "majorant/parametrization/surface_mesh.h"

namespace majorant {

struct ConformalMetric {
  Vec log_factor;          // #V: u; the metric has the area of the surface, broken faces apart
  double angle_error = 0;  // largest |angle sum - wanted| over interior vertices, radians
  Index broken_faces = 0;  // lengths violate the triangle inequality; angles count as 0, 0, pi
  Index newton_steps = 0;
};

// quarter_turns: #V, the angle sum wanted at interior vertices in units of 90 degrees, at least 1;
// not read at vertices of the boundary, which all get the same factor (the free boundary of least
// distortion). Throws Error(Usage) when the size is wrong, an interior vertex has no positive angle
// sum, or, on a closed surface, sum(4 - quarter_turns) is not 4 times the Euler characteristic
// (Gauss-Bonnet). A metric that could not be found shows in angle_error; it is always finite.
ConformalMetric conformal_metric(const SurfaceMesh& mesh, const std::vector<int>& quarter_turns);

// The metric laid out over the surface cut open along the half-edges 3 f + k with is_cut (3 #F,
// both sides of an edge or none): u, v of every corner, model units, total area that of the
// surface. Corners agree exactly across edges that are not cut. Without broken faces and angle
// error this is the metric; what does not fit is spread over all edges in the sense of least
// squares, relative to their lengths. Triangles may then be flipped; broken ones come out nearly
// collapsed. Throws Error(Usage) unless the flags have that form and leave one disk.
CornerPoints lay_out(const SurfaceMesh& mesh, const ConformalMetric& metric,
                     const std::vector<char>& is_cut);

}  // namespace majorant
