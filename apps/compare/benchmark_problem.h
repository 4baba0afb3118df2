// The problem of `majorant compare`: a map at its start, the same for every method.
//
//   BenchmarkProblem benchmark;  // made by compare_command.cpp
//   const ComparisonOptions measured = options_of(benchmark);
#pragma once

#include <memory>

#include "majorant/framework/comparison/compare.h"
#include "majorant/maps/map_problem.h"

namespace majorant::app {

struct BenchmarkProblem {
  MapSpecification specification;
  std::shared_ptr<const BezierTriangleSpace> space;
  Quadrature rule;
  std::shared_ptr<const FeasibilityChecker> injectivity;
  Vec start;  // all unknowns, fixed ones included
  Problem problem;
};

// Returns options that rate points by the smallest det J. A map that is not certified counts as
// invalid.
ComparisonOptions options_of(const BenchmarkProblem& benchmark);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
