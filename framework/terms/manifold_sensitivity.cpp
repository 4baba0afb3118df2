#include "majorant/framework/terms/manifold_sensitivity.h"

#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/terms/internal/manifold_chart.h"
#include "majorant/framework/terms/internal/manifold_points.h"

namespace majorant {

// The problem on the chart around a result, which stays, and the result there.
struct ManifoldSensitivity::OnChart {
  std::shared_ptr<const ManifoldPoints> points;
  ManifoldPoints::Chart chart;
  Problem problem;
  SolveResult result;
};

ManifoldSensitivity::ManifoldSensitivity(const ManifoldProblem& problem,
                                         const ManifoldResult& result, SensitivityOptions options)
    : ManifoldSensitivity(problem, result.x, result, {}, std::move(options)) {}

ManifoldSensitivity::ManifoldSensitivity(const ManifoldProblem& problem,
                                         const ManifoldBarrierResult& result,
                                         SensitivityOptions options)
    : ManifoldSensitivity(problem, result.x, result, result.states, std::move(options)) {}

ManifoldSensitivity::ManifoldSensitivity(const ManifoldProblem& problem, const Vec& x,
                                         const SolveResult& result, const TermChanges& states,
                                         SensitivityOptions options)
    : ManifoldSensitivity(
          [&] {
            Vec coordinates;
            ManifoldPoints::Chart chart = problem.points_->around(x, coordinates);
            Problem fixed = ManifoldChart(problem.points_, problem.checkers_, chart)
                                .fixed(problem.problem_.with(states));
            OnChart at{problem.points_, std::move(chart), std::move(fixed), result};
            at.result.y = at.problem.reduce(coordinates);
            return at;
          }(),
          std::move(options)) {}

ManifoldSensitivity::ManifoldSensitivity(const OnChart& at, SensitivityOptions options)
    : sensitivity_(at.problem, at.result, std::move(options)),
      slopes_(at.points->slopes(at.chart, sensitivity_.point())),
      point_(at.points->expand(at.chart, sensitivity_.point())) {}

Vec ManifoldSensitivity::forward(Sensitivity::Change change) const {
  if (change.gradient.size() > 0) {
    require_size("ManifoldSensitivity: gradient", change.gradient.size(), point_.size());
    change.gradient = slopes_.transpose() * change.gradient;
  }
  return slopes_ * sensitivity_.forward(change);
}

Sensitivity::Derivative ManifoldSensitivity::adjoint(const Vec& slope) const {
  require_size("ManifoldSensitivity::adjoint: the slope", slope.size(), point_.size());
  Sensitivity::Derivative d = sensitivity_.adjoint(Vec(slopes_.transpose() * slope));
  d.adjoint_state = slopes_ * d.adjoint_state;
  return d;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
