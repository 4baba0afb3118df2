// The problem of `majorant compare`: a map at its start, the same for every method.
//
//   Contest contest;                                        // made by compare_command.cpp
//   const ComparisonOptions measured = options_of(contest);
#pragma once

#include <memory>

#include "majorant/framework/comparison/compare.h"
#include "majorant/maps/map_problem.h"

namespace majorant::app {

struct Contest {
  MapSpecification specification;
  std::shared_ptr<const BezierTriangleSpace> space;
  Quadrature rule;
  std::shared_ptr<const FeasibilityChecker> injectivity;
  Vec start;  // all unknowns, fixed ones included
  Problem problem;
};

// Makes options that rate points by the smallest det J. Maps that are not certified count as
// invalid.
ComparisonOptions options_of(const Contest& contest);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
