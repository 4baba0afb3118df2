// Extensions of the problem that parametrize() builds for each degree: custom terms, constraints,
// checkers, bounds and observers.
//
//   ParametrizationOptions options;
//   options.extend = [](MapExtension& map) {
//     const std::vector<LinearExpression> level{{{{1, 0.6}, {3, -0.6}}, 0}};   // v_0 = v_1, softly
//     map.add(std::make_shared<const QuadraticPenalty>(level), 10);
//     map.add(FixedUnknowns({{2 * 5, map.start()[2 * 5]}}));                   // u of vertex 5
//   };
//
// The extender is called once for every degree that is optimized, in increasing order. Additions
// take part in the whole solve of this degree: steps, remedies for stalls, auxiliary energies, the
// scaffold of MapInjectivity::Global. The certificates of the result do not change.
// ParametrizationResult::terms and checks report the additions.
//
// Unknowns are x = scale() * (u, v), without translation: node k has 2 k and 2 k + 1. Vertex v of
// mesh() is node v; the nodes of face f are row f of space().cells(), those of a half-edge
// edge_nodes(). The objective is the mean of the density over the surface plus the sum of weight *
// term. For pins, handles and weights of faces, MapOptions suffices.
#pragma once

#include <concepts>
#include <memory>
#include <utility>
#include <vector>

#include "majorant/elements/rest_shapes.h"
#include "majorant/framework/constraint.h"
#include "majorant/framework/feasibility.h"
#include "majorant/maps/map_options.h"

namespace majorant {

class MapExtension {
 public:
  // start: the start of this degree, normalized. rest: shapes of its faces. Throws InvalidArgument
  // if rest is null.
  MapExtension(BezierMap start, std::shared_ptr<const RestShapes> rest, double scale);

  int degree() const { return start_.degree(); }
  const SurfaceMesh& mesh() const { return start_.mesh(); }
  const BezierTriangleSpace& space() const { return start_.space(); }
  std::shared_ptr<const BezierTriangleSpace> shared_space() const { return start_.shared_space(); }
  const RestShapes& rest() const { return *rest_; }             // of the scaled faces
  double scale() const { return scale_; }                       // a power of two
  const Vec& start() const { return start_.control_points(); }  // 2 numbers per node

  // Add a part to the problem. Throw Error(Usage) for null pointers, weights that are not positive
  // and finite, and element_dofs outside the unknowns.
  MapExtension& add(std::shared_ptr<const EnergyTerm> term, double weight);
  // Adds a constraint. The start of a degree is moved to where it satisfies all constraints, as
  // smoothly as they allow; if it is not injective then, parametrize() throws Error(Infeasible).
  MapExtension& add(std::shared_ptr<const Constraint> constraint);
  template <std::derived_from<Constraint> C>
  MapExtension& add(C constraint) {
    return add(std::make_shared<const C>(std::move(constraint)));
  }
  // Adds a checker that must hold at the start of the first degree, and then holds at every step.
  // It sees the map's unknowns alone, and its blocking elements are not interpreted. A
  // BarrierChecker may be violated at the start and on the way: the run first goes to the free
  // minimum. At the last degree it goes inside the bound, and then follows the barrier to the
  // constrained minimum.
  MapExtension& add(std::shared_ptr<const FeasibilityChecker> checker);
  MapExtension& observe(MapObserver observer);
  // Returns the same extension with these checkers alone.
  MapExtension with(std::vector<std::shared_ptr<const FeasibilityChecker>> checkers) const;

  // The additions, in their order.
  struct Term {
    std::shared_ptr<const EnergyTerm> term;
    double weight;
  };
  const std::vector<Term>& terms() const { return terms_; }
  const std::vector<std::shared_ptr<const Constraint>>& constraints() const { return constraints_; }
  const std::vector<std::shared_ptr<const FeasibilityChecker>>& checkers() const {
    return checkers_;
  }
  const std::vector<MapObserver>& observers() const { return observers_; }

 private:
  BezierMap start_;
  std::shared_ptr<const RestShapes> rest_;
  double scale_;
  std::vector<Term> terms_;
  std::vector<std::shared_ptr<const Constraint>> constraints_;
  std::vector<std::shared_ptr<const FeasibilityChecker>> checkers_;
  std::vector<MapObserver> observers_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
