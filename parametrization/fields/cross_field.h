// Cross fields: four directions at right angles in every face, as smooth as possible, and the cones
// around which they turn. What a seamless map is made from: its rotations across the cuts and the
// angles at its vertices.
//
//   CrossField field = smoothest_cross_field(*mesh);
//   comb(*mesh, is_cut, field);   // turns are 0 but across the cut, which leads through the cones
//
// The branches of a face are numbered 0..3 counterclockwise; `angle` is branch 0. All of this is
// intrinsic: rotating or scaling the mesh changes nothing but rounding.
//
// Not for fields of other symmetries than four directions.
#pragma once

#include <vector>

#include "majorant/mesh/seams.h"
#include "majorant/mesh/surface_mesh.h"

namespace majorant {

struct CrossField {
  // #F: direction of branch 0, radians, counterclockwise from the edge corner 0 -> corner 1.
  Vec angle;
  // 3 #F: k in 0..3 such that the branch of the face of half-edge h, transported across the edge
  // and turned by k quarter turns (counterclockwise, seen from outside), belongs to the branch of
  // the opposite face. The opposite half-edge has (4 - k) % 4, the boundary 0. It is the nearest
  // branch except where cones were moved or prescribed.
  std::vector<int> turns;
  // #V: 4 - 4 index, what the angles around the vertex add up to in a seamless map that follows the
  // field, in units of 90 degrees; 0 at boundary vertices. Modulo 4 it is the sum of the turns of
  // the half-edges that enter the vertex. On a closed surface sum (4 - quarter_turns) = 4 chi.
  std::vector<int> quarter_turns;
};

// What cones are weighed against; scale: of a conformal map with these cones. Rotation: the
// integral
//     1/2 int |grad log scale|^2 = 1/2 int |rotation of the branches|^2
// of the smoothest field, whatever the size of a map. Scale: int (log scale - its mean)^2 / area,
// of a map of equal lengths everywhere; for small distortions that is the least int |strain|^2 /
// area of any map with these cones, the energy of disclinations in an elastic sheet [SN88]. The
// mean is not taken away where there is a boundary.
enum class ConeEnergy { Rotation, Scale };

struct CrossFieldOptions {
  // 0: the smoothest field. t > 0: minimizes int |grad z|^2 + (t^2 / area) int |z - q|^2, where z
  // is the fourth power of the branch as a complex number and q that of the principal directions,
  // of length between 0 (flat, umbilic) and 1: curvature directions averaged over a distance of
  // about sqrt(area) / t. 5 to 50 are useful: 0, since what is
  // flat has no principal directions.
  double curvature_weight = 0;
  // 3 #F or empty: half-edges that the field follows, one branch along the edge, on both of its
  // sides (flagging one is enough). A face with several follows the longest.
  std::vector<char> aligned = {};
  // Where neither curvature nor edges are to be followed, cones are cancelled and moved as long as
  //     cone_energy + cone_cost * sum |quarter_turns - 4|
  // falls. A cost of 0 cancels only what lowers the energy; 0.1 is for Rotation; chosen, not tuned.
  ConeEnergy cone_energy = ConeEnergy::Rotation;
  double cone_cost = 0.1;
  // Of inner vertices, 1 to 4; with edges to follow 2 at least.
  int least_quarter_turns = 1;
  StopCheck stop = {};  // polled between steps: Stopped
};

// The field of least sum weight |z_f e^{4 i transport} - z_g|^2 over interior edges with
// sum area |z|^2 = 1 [KCPS13], or with the constraints of `options`; its cones then cleaned up as
// CrossFieldOptions::cone_cost says and the branches relaxed to them. Throws Error(Infeasible) when
// the mesh is too coarse to hold the cones, InvalidArgument for sizes or weights that are not
// valid.
CrossField smoothest_cross_field(const SurfaceMesh& mesh, const CrossFieldOptions& options = {});

// The cone_vertices() of that field, without its directions, which take about as long again.
std::vector<Index> smoothest_field_cones(const SurfaceMesh& mesh,
                                         const CrossFieldOptions& options = {});

// The smoothest field with exactly these cones, all other interior vertices regular [CDS10]; how
// it turns along loops that are not contractible is rounded to multiples of 90 degrees such that
// the field stays smooth. Throws Error(Usage) for cones on the boundary, repeated or out of range,
// with less than one quarter turn or at least two for every face, or (closed surfaces) when
// sum (4 - quarter_turns) is not 4 chi.
CrossField cross_field_with_cones(const SurfaceMesh& mesh, const std::vector<Cone>& cones);

// Interior vertices with other than 4 quarter turns.
std::vector<Index> cone_vertices(const CrossField& field);

// Renames branches so that turns[h] is 0 across every half-edge with is_cut[h] == 0 (3 #F). Throws
// Error(Usage) when that is impossible: the cut surface is not simply connected, or has a cone
// inside.
void comb(const SurfaceMesh& mesh, const std::vector<char>& is_cut, CrossField& field);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
