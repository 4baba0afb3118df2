// The chart of points on manifolds that a run moves along with itself, and checkers on it.
//
//     ManifoldChart chart(points, checkers, points->around(x0, coordinates));
//     const Problem problem = chart.begun(unmoved);    // on the chart, with the checkers
//     BarrierMinimizer...                              // or ChartDescent, which move it
//     const Vec x = chart.expand(problem.expand(result.y));
#pragma once

#include <memory>

#include "majorant/framework/moving_chart.h"
#include "majorant/framework/terms/internal/manifold_points.h"

namespace majorant {

// The terms of its problems are ManifoldTerms, their checkers see the coordinates.
class ManifoldChart final : public MovingChart {
 public:
  // checkers: of x, which the problems hold.
  ManifoldChart(std::shared_ptr<const ManifoldPoints> points, Checkers checkers,
                ManifoldPoints::Chart chart);

  // Returns the problem, which has no checkers, with those of this chart.
  Problem begun(const Problem& problem) const;
  // Returns it with terms that stay on the chart: their parameters are those that they have by x.
  Problem fixed(const Problem& problem) const;

  Vec expand(VecIn coordinates) const override;
  Vec shown(const Problem& problem, const Vec& y) const override;
  Problem on(const Problem& problem) const override;
  Checkers checkers(const Problem& /*problem*/) const override { return checkers_; }
  Problem exchanged(const Problem& problem, const Terms& terms, Checkers checkers) const override;
  void move(Evaluator& evaluator, const Vec& y) override;
  void return_to(Evaluator& evaluator, const Vec& y, const Vec& x) override;

 private:
  Checkers of_coordinates(Checkers checkers) const;

  std::shared_ptr<const ManifoldPoints> points_;
  Checkers checkers_;
  // The checkers of the problems see it move.
  std::shared_ptr<ManifoldPoints::Chart> chart_;
};

// The states of all terms of a problem, which are ManifoldTerms, on a chart.
TermChanges on_chart(const Problem& problem, const ManifoldPoints::Chart& chart);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
