// Several methods on one problem of Python's.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/terms/manifold_problem.h"

namespace majorant::python {

// A problem and its start, as compare() takes them.
struct ComparisonInput {
  std::optional<ManifoldProblem> on_manifolds;  // else `problem`
  std::optional<Problem> problem;
  std::vector<HeldBound> bounds;
  Vec start;  // y, on manifolds x
};

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
