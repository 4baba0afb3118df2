// The energy of many separate pairs of Bezier triangles, minimized over the control points inside
// each pair: Newton's method for all pairs at once, with a step length for each of them.
//
//   const PairEnergy pairs(space, rest, options.map.energy, rule);
//   pairs.minimize(x);                   // x is certified before and after
//   const Vec value = pairs.values(x);   // one a face
//
// What a pair shares with nothing else is few unknowns: dense systems, no sparse problem.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/elements/bezier_triangle_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/curvature.h"

namespace majorant {

class PairEnergy {
 public:
  // Faces 2p and 2p + 1 of the space share an edge and no node with other pairs; `rest` has a shape
  // per face. Throws InvalidArgument when there is no energy.
  PairEnergy(std::shared_ptr<const BezierTriangleSpace> space, const RestShapes& rest,
             const EnergySum& energy, const Quadrature& rule);

  // #F integrals of the energy; x: 2 numbers per node.
  Vec values(VecIn x) const;
  // Moves the points that both triangles share and those inside them, while that lowers the pair's
  // energy. Faces stay injective: a pair that cannot be certified at the end keeps its points, and
  // so does one of infinite energy.
  void minimize(Vec& x) const;

 private:
  struct Pair;
  void find_variables();
  void linearize(VecIn x, std::vector<Pair>& pairs) const;
  void add_local(VecIn x, const DensityTerm& term, double weight, std::vector<Pair>& pairs) const;
  void find_directions(std::vector<Pair>& pairs) const;
  void search(Vec& x, std::vector<Pair>& pairs) const;
  Index pair_count() const { return space_->element_count() / 2; }
  template <class Visit>
  void for_variables(Index pair, const Visit& visit) const;

  std::shared_ptr<const BezierTriangleSpace> space_;
  EnergySum energy_;
  std::vector<std::shared_ptr<const DensityTerm>> terms_;
  std::optional<Curvature> curvature_;     // none: nothing that all terms support
  std::vector<int> variable_;              // by node: which of its pair's inner points, -1: outer
  std::vector<std::vector<Index>> inner_;  // by pair: its inner nodes
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
