// Several methods on one problem, from one start: which of them converges, to which minimum, in how
// many steps, factorizations and seconds.
//
//   const Comparison all = compare(problem, y0);
//   std::cout << comparison_table(all);                            // comparison_table.h
//   compare(problem, y0, named_methods({"newton", "lbfgs"}, comparison_methods()));
//
// A method that is not for the problem, or not in the program, has a row that says so. Energy and
// gradient of each point are measured by the same code, with the clock stopped. Notes say what to
// look into:
//
// * a gradient that disagrees with finite differences, at the start or where the best run ended;
// * an exact Hessian that is indefinite where a method converged: a saddle;
// * methods that converged at different minima;
// * a method that stopped with a gradient 1000 times as large as that of the others.
//
// Not for tuning one method: observers (run_record.h) see all of its steps.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "majorant/framework/comparison/comparison.h"
#include "majorant/framework/comparison/methods.h"

namespace majorant {

// A number of each point beside its energy; whether the point counts: elsewhere its energy is +inf.
struct PointValue {
  double value = 0;
  bool is_valid = true;
};

struct ComparisonOptions {
  // Bounds of the problem, to be held along barriers as BarrierMinimizer::of_bounds() does; the
  // start may violate them.
  std::vector<HeldBound> bounds = {};
  // The limit of each method, without the time that measuring takes. It ends a step between pieces.
  double time_limit_seconds = 60;
  std::optional<double> tolerance = {};    // of MethodLimits
  std::optional<int> max_iterations = {};  // of each method; none: its own
  StopCheck stop = {};                     // ends the comparison with the method that runs
  std::string title = {};
  // Told of each method before it runs.
  std::function<void(const ComparisonMethod&)> begin = {};
  // A measure of points, full unknowns, and its name.
  std::string measure = {};
  std::function<PointValue(const Vec& x)> value_of = {};
  // False where the energy does not see motions such as rotations: no distances are measured, and
  // minima of the same energy are the same one.
  bool compares_points = true;
  // False where derivatives are those of the library.
  bool checks_derivatives = true;
};

// Solves the problem with one method after the other. What terms throw leaves it, and so do Errors
// that no method is made for (out of memory is a failed row). Throws InvalidArgument for a y0 of
// another size.
Comparison compare(const Problem& problem, const Vec& y0,
                   const std::vector<ComparisonMethod>& methods = comparison_methods(),
                   const ComparisonOptions& options = {});
// Compares methods on a problem whose unknowns lie on manifolds; x0 are the full unknowns.
Comparison compare(const ManifoldProblem& problem, const Vec& x0,
                   const std::vector<ComparisonMethod>& methods = comparison_methods(),
                   const ComparisonOptions& options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
