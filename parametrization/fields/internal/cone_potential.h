// The smoothest field with given cones without solving for the field: its rotations are the
// differences of a potential on the vertices, and their energy follows from the quarter turns.
//
//     L u = angle sums - (pi / 2) quarter turns,  L the Laplacian with weights 1 / weight,
//     rotation[h] = (u[end of h] - u[start of h]) / weight[h],
//     energy = 1/2 sum over edges weight rotation^2 = 1/2 int |grad u|^2.
//
// u is also the logarithm of the scale of a conformal map with these cones, so the energy measures
// the distortion that the cones leave. u is 0 on the boundary, or at vertex 0 of a closed surface;
// turning along loops that are not contractible is left out. [CDS10], [MC20].
#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "majorant/parametrization/fields/internal/field_geometry.h"

namespace majorant {

class ConePotential {
 public:
  // quarter_turns: #V, 0 at the boundary; 4 - quarter_turns adds up to 4 chi on closed surfaces.
  ConePotential(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                const std::vector<int>& quarter_turns);

  const Vec& potential() const { return potential_; }  // #V
  double energy() const;
  // Change of energy() when one quarter turn passes from one vertex to another; the boundary gives
  // and takes any number. One solve for every vertex met for the first time.
  double change(Index from, Index to);
  // Nearly the same for `step` quarter turns (1 or -1) from v to its neighbour w, without a solve
  // for w: w is taken to respond to itself as v does.
  double estimated_change(Index v, Index w, int step);
  void move(Index from, Index to);
  // Frees what change() keeps for v.
  void forget(Index v) { responses_.erase(v); }
  Vec rotations() const;  // 3 #F

 private:
  Vec solve(const Vec& charge) const;  // L^-1, #V to #V
  const Vec& response(Index v);        // L^-1 of the unit vector of v

  const SurfaceMesh& mesh_;
  const FieldGeometry& geometry_;
  std::vector<Index> row_;  // per vertex, -1 where u is 0
  std::optional<SparseSpd> system_;
  Vec charge_, potential_;  // #V
  std::unordered_map<Index, Vec> responses_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
