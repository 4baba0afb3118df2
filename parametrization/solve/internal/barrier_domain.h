// The domain of a map of degree 1 whose boundary is kept apart by a barrier (boundary_barrier.h):
// the map's own nodes. Triangles around the image, as in a scaffold, would be as many again.
//
// Pairs of the boundary that are near each other are elements of the problem, which is built anew
// when others come within reach. Internal to parametrize().
#pragma once

#include <memory>
#include <optional>

#include "majorant/parametrization/solve/internal/boundary_barrier.h"
#include "majorant/parametrization/solve/internal/map_domain.h"

namespace majorant {

class BarrierDomain final : public MapDomain {
 public:
  // start: a map of degree 1 without overlaps. scale: the factor from lengths of its mesh to those
  // of the map.
  BarrierDomain(const BezierMap& start, double scale, const SolverRules& rules);

  // Returns whether the boundary at x has so many pairs that a scaffold is faster.
  bool is_crowded(VecIn x) const;

  Vec unknowns(VecIn map) const override { return map; }
  MapProblem build(const MapSpecification& map,
                   const std::shared_ptr<const BezierTriangleSpace>& space, VecIn start,
                   const DensityTerms& terms,
                   const std::shared_ptr<const LocalInjectivity>& injectivity, VecIn x) override;
  TermChanges before_step(const MapProblem& built, VecIn x) override;
  DomainChange after_step(Vec& x, const StepResult& step, int depth) override;
  bool fits(VecIn x) const override;
  double foreign_energy(const Problem& problem, VecIn x) const override;
  // Returns Metis for large maps. Automatic analyses a large pattern anew whenever pairs are added.
  Ordering ordering() const override {
    return faces_ >= large_ ? Ordering::Metis : Ordering::Automatic;
  }
  StoppingRules final_rules(StoppingRules usual) override;
  LaggedFactorRules lagged(LaggedFactorRules usual) const override;
  double seconds() const override { return seconds_; }
  void charge(double seconds) override { seconds_ += seconds; }

 private:
  bool rests(const StepResult& step) const;

  BoundaryBarrierRules rules_;
  std::shared_ptr<const BoundaryEdges> edges_;
  std::shared_ptr<const SimpleBoundary> simple_;
  Index faces_, large_;  // of the map; the number from which on a map is large
  double rests_below_;   // the relative decrease below which the image rests
  bool rests_ = false;   // the image
  Cells pairs_;          // of the last problem
  std::optional<TermId> barrier_;
  std::optional<double> weight_;  // of the barrier; none: not set since the problem was built
  std::optional<Problem> built_;  // the last problem
  double usual_weight_ = 0;       // the sum of the energies' weights
  double strength_ = 0;           // the barrier's weight relative to theirs
  double seconds_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
