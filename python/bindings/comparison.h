// Comparison of several methods on one problem made in Python.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/terms/manifold_problem.h"

namespace majorant::python {

// A problem and its start, the arguments of compare().
struct ComparisonInput {
  std::optional<ManifoldProblem> on_manifolds;  // if empty, `problem` is used
  std::optional<Problem> problem;
  std::vector<HeldBound> bounds;
  Vec start;  // y; x of a problem on manifolds
};

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
