#include "apps/compare/benchmark_problem.h"

#include <memory>

#include "majorant/certify/certify.h"

namespace majorant::app {

ComparisonOptions options_of(const BenchmarkProblem& benchmark) {
  const auto injectivity = std::make_shared<const LocalInjectivity>(
      benchmark.space, 2 * benchmark.specification.rest->measure);
  // Methods without path certificates might wind twice around a vertex.
  const auto vertices =
      std::make_shared<const AngleSums>(benchmark.space, AngleSums::Vertices::Interior);
  ComparisonOptions options;
  options.measure = "min det";
  options.value_of = [=](const Vec& x) -> PointValue {
    const double min_det = injectivity->lower_bounds(x).minCoeff();
    return {min_det, min_det > 0 && vertices->check(x).feasible};
  };
  options.compares_points = false;     // maps that differ by a rotation are the same
  options.checks_derivatives = false;  // the tests check them
  return options;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
