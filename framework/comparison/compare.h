// Several methods on one problem, from one start: which of them converges, to which minimum, in how
// many steps, factorizations and seconds.
//
//   const Comparison all = compare(problem, y0);
//   std::cout << comparison_table(all);                            // comparison_table.h
//   compare(problem, y0, named_methods({"newton", "lbfgs"}, comparison_methods()));
//
// A method that is not for the problem, or not in the program, has a row that says so. Energy and
// gradient of each point are measured by the same code, with the clock stopped. Notes point out
// problems to look into:
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

// A measured number of a point beside its energy, and whether the point is feasible; the energy of
// an infeasible point counts as +inf.
struct PointValue {
  double value = 0;
  bool is_valid = true;
};

struct ComparisonOptions {
  // Bounds of the problem, which BarrierMinimizer::of_bounds() holds by barriers; the start may
  // violate them.
  std::vector<HeldBound> bounds = {};
  // The time limit of each method, without the time of measuring. It can end a run within a step.
  double time_limit_seconds = 60;
  std::optional<double> tolerance = {};    // MethodLimits::tolerance
  std::optional<int> max_iterations = {};  // of each method; none: the method's own
  StopCheck stop = {};                     // ends the running method, and with it the comparison
  std::string title = {};
  // Called with each method before it runs.
  std::function<void(const ComparisonMethod&)> begin = {};
  // The name of a measure of points (in full unknowns), and the measure.
  std::string measure = {};
  std::function<PointValue(const Vec& x)> value_of = {};
  // False if motions such as rotations do not change the energy: no distances are measured then,
  // and minima with the same energy count as one.
  bool compares_points = true;
  // False if all derivatives are those of the library.
  bool checks_derivatives = true;
};

// Solves the problem with one method after the other. A method that throws Error(Unsupported) or
// runs out of memory is a failed row; all other exceptions pass through. Throws InvalidArgument for
// a y0 of another size.
Comparison compare(const Problem& problem, const Vec& y0,
                   const std::vector<ComparisonMethod>& methods = comparison_methods(),
                   const ComparisonOptions& options = {});
// Compares methods on a problem whose unknowns lie on manifolds. x0: the full unknowns.
Comparison compare(const ManifoldProblem& problem, const Vec& x0,
                   const std::vector<ComparisonMethod>& methods = comparison_methods(),
                   const ComparisonOptions& options = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
