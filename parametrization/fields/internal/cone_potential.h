// What given cones leave to be distorted, without a field or a map: a potential u on the vertices,
//
//     L u = angle sums - (pi / 2) quarter turns,  L the Laplacian with weights 1 / weight,
//     rotation[h] = (u[end of h] - u[start of h]) / weight[h].
//
// u is the logarithm of the scale of a conformal map with these cones, and its differences are the
// rotations of the smoothest field that has them. It is 0 on the boundary, or known up to a
// constant on a closed surface; turning along loops that are not contractible is left out. [CDS10],
// [MC20].
//
// A ConeEnergy (cross_field.h) is 1/2 charge . G charge, charge the right-hand side: Rotation has
// G = L^-1; Scale, with M the parts of the area at vertices and P taking away the mean (of closed
// surfaces), G = 2 L^-1 P^T M P L^-1.
#pragma once

#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {

class ConePotential {
 public:
  // quarter_turns: #V, 0 at the boundary; 4 - quarter_turns adds up to 4 chi on closed surfaces.
  ConePotential(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                const std::vector<int>& quarter_turns, ConeEnergy kind);

  double energy() const { return 0.5 * charge_.dot(derivative_); }
  // Vertices that change() and estimated_change() are going to be asked about: what they need of a
  // vertex met for the first time is found for all of these at once.
  void watch(std::vector<Index> vertices) { watched_ = std::move(vertices); }
  // Change of energy() when one quarter turn passes from one vertex to another; the boundary gives
  // and takes any number. Of Rotation, a few entries of a solve for every vertex met for the first
  // time; of Scale, two solves.
  double change(Index from, Index to);
  // Nearly the same for `step` quarter turns (1 or -1) from v to its neighbour w, without a solve
  // for w: w is taken to respond to itself as v does.
  double estimated_change(Index v, Index w, int step);
  // A solve, of Scale none.
  void move(Index from, Index to);
  // Frees what change() keeps for v.
  void forget(Index v) {
    responses_.erase(v);
    entries_.erase(v);
  }
  Vec rotations() const;  // 3 #F

 private:
  Vec solve(const Vec& charge) const;   // L^-1, #V to #V
  Vec derive(const Vec& charge) const;  // G, #V to #V
  const Vec& response(Index v);         // G of the unit vector of v
  double response(Index v, Index at);   // its entry
  void find_entries(Index v, Index at);

  const SurfaceMesh& mesh_;
  const FieldGeometry& geometry_;
  const ConeEnergy kind_;
  std::vector<Index> row_;  // per vertex, -1 where u is 0
  std::optional<SparseSpd> system_;
  Vec mass_;                 // #V: M, adds up to 1
  Vec charge_, derivative_;  // #V: derivative_ = G charge_, of the energy
  std::vector<Index> watched_;
  std::unordered_map<Index, Vec> responses_;                              // Scale
  std::unordered_map<Index, std::unordered_map<Index, double>> entries_;  // Rotation
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
