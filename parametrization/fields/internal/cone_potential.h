// The distortion caused by given cones, without a field or a map: a potential u on the vertices,
//
//     L u = angle sums - (pi / 2) quarter turns,  L the Laplacian with weights 1 / weight,
//     rotation[h] = (u[end of h] - u[start of h]) / weight[h].
//
// u is the logarithm of the scale of a conformal map with these cones, and its differences are the
// rotations of the smoothest field with these cones. It is 0 on the boundary, or determined up to a
// constant on a closed surface. Turning along non-contractible loops is ignored. [CDS10], [MC20].
//
// A ConeEnergy (cross_field.h) is 1/2 charge . G charge, where charge is the right-hand side above.
// Rotation has G = L^-1. Scale has G = 2 L^-1 P^T M P L^-1, where M holds the fractions of the area
// at vertices and P subtracts the mean on closed surfaces.
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
  // Announces vertices of later calls of change() and estimated_change(). Their entries are
  // computed at once when a vertex is first needed.
  void watch(std::vector<Index> vertices) { watched_ = std::move(vertices); }
  // Returns the change of energy() when one quarter turn passes from one vertex to another; the
  // boundary holds any number. Costs, for a vertex that is new: some entries of a solve for
  // Rotation, two solves for Scale.
  double change(Index from, Index to);
  // Returns an estimate of the same for `step` quarter turns (1 or -1) from v to its neighbour w.
  // It needs no solve for w, whose response to itself is taken to be that of v.
  double estimated_change(Index v, Index w, int step);
  // Passes one quarter turn. Costs one solve for Rotation, none for Scale.
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
  const Vec& response(Index v);         // G times the unit vector of v
  double response(Index v, Index at);   // one entry of it
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
