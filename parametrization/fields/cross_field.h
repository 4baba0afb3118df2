// Cross fields, with four directions at right angles in every face, and their cones. Seamless maps
// are made from them: a field gives the rotations across the cuts and the angles at the vertices.
//
//   CrossField field = smoothest_cross_field(*mesh);
//   comb(*mesh, is_cut, field);   // turns are 0 but across the cut, which leads through the cones
//
// The branches of a face are numbered 0..3 counterclockwise; `angle` is that of branch 0. All
// results are intrinsic: rotating or scaling the mesh changes only rounding.
//
// Fields of other symmetries are not supported.
#pragma once

#include <vector>

#include "majorant/mesh/seams.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct CrossField {
  // #F: direction of branch 0, radians, counterclockwise from the edge corner 0 -> corner 1.
  Vec angle;
  // 3 #F: k in 0..3. The branch of the face of half-edge h, transported across the edge and rotated
  // by k quarter turns (counterclockwise, seen from outside), matches the branch of the opposite
  // face. The opposite half-edge has (4 - k) % 4, the boundary 0. The match is the nearest branch
  // except where cones were moved or prescribed.
  std::vector<int> turns;
  // #V: 4 - 4 index, the angle sum of the vertex in a seamless map that follows the field, in units
  // of 90 degrees; 0 at boundary vertices. Modulo 4 it is the sum of the turns of the half-edges
  // that enter the vertex. On a closed surface sum (4 - quarter_turns) = 4 chi.
  std::vector<int> quarter_turns;
};

// The energy that is minimized over cones, where `scale` is that of a conformal map with these
// cones. Rotation: the integral
//     1/2 int |grad log scale|^2 = 1/2 int |rotation of the branches|^2
// of the smoothest field, independent of the size of the map. Scale: int (log scale - its mean)^2 /
// area, which is 0 for an isometry. For small distortions it is the least int |strain|^2 / area of
// any map with these cones, the energy of disclinations in an elastic sheet [SN88]. On a surface
// with boundary the mean is not subtracted.
enum class ConeEnergy { Rotation, Scale };

struct CrossFieldOptions {
  // 0: the smoothest field. t > 0: minimizes int |grad z|^2 + (t^2 / area) int |z - q|^2. Here z is
  // the fourth power of the branch as a complex number, and q that of the principal directions, of
  // length between 0 (flat, umbilic) and 1. Curvature directions are averaged over a distance of
  // about sqrt(area) / t; 5 to 50 are useful. The default is 0, since flat regions have no
  // principal directions.
  double curvature_weight = 0;
  // 3 #F or empty: half-edges that the field follows, one branch along the edge, on both of its
  // sides (flagging one is enough). A face with several follows the longest.
  std::vector<char> aligned = {};
  // If the field follows neither curvature nor edges, cones are cancelled and moved as long as
  //     cone_energy + cone_cost * sum |quarter_turns - 4|
  // falls. A cost of 0 cancels cones only if that lowers the energy; the default is for Rotation.
  // Chosen, not tuned.
  ConeEnergy cone_energy = ConeEnergy::Rotation;
  double cone_cost = 0.1;
  // The minimum for inner vertices, 1 to 4; at least 2 if the field follows edges.
  int least_quarter_turns = 1;
  StopCheck stop = {};  // polled between steps: Stopped
};

// Returns the field that minimizes sum weight |z_f e^{4 i transport} - z_g|^2 over interior edges
// with sum area |z|^2 = 1 [KCPS13], or with the constraints of `options`. Its cones are then
// cleaned up by CrossFieldOptions::cone_cost, and the branches relaxed to them. Throws
// Error(Infeasible) if the mesh is too coarse for the cones, InvalidArgument for invalid sizes or
// weights.
CrossField smoothest_cross_field(const SurfaceMesh& mesh, const CrossFieldOptions& options = {});

// Returns the cone_vertices() of smoothest_cross_field() without computing its directions, which
// take about half of the time.
std::vector<Index> smoothest_field_cones(const SurfaceMesh& mesh,
                                         const CrossFieldOptions& options = {});

// Returns the smoothest field with exactly these cones; all other interior vertices are regular
// [CDS10]. Its turning along non-contractible loops is rounded to multiples of 90 degrees such that
// the field stays smooth. Throws Error(Usage) if a cone lies on the boundary, is repeated or out of
// range, or has less than one quarter turn or at least two for every face. Throws it also if sum (4
// - quarter_turns) is not 4 chi on a closed surface.
CrossField cross_field_with_cones(const SurfaceMesh& mesh, const std::vector<Cone>& cones);

// Returns the interior vertices with other than 4 quarter turns.
std::vector<Index> cone_vertices(const CrossField& field);

// Renames branches so that turns[h] is 0 across every half-edge with is_cut[h] == 0 (3 #F). Throws
// Error(Usage) if that is impossible, since the cut surface is not simply connected or has a cone
// inside.
void comb(const SurfaceMesh& mesh, const std::vector<char>& is_cut, CrossField& field);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
