// The methods that compare() knows, as values: Newton's method with each model of curvature and
// with several linear solvers, L-BFGS, gradient flow, Levenberg-Marquardt.
//
//   const std::vector<ComparisonMethod> known = comparison_methods();
//   std::vector<ComparisonMethod> chosen = named_methods({"newton", "lbfgs"}, known);
//   chosen.push_back(newton_method("newton-loose", "Newton, to 1e-3", [] {
//     NewtonOptions options;
//     options.stopping.relative_decrease = 1e-3;
//     return options;
//   }()));
//
// The methods of Ceres and CHOLMOD are in ceres_methods.h and cholmod_methods.h, since these
// libraries are optional. Not for choosing a method in a program, which makes its Minimizer
// (minimizer.h) itself.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/minimizer.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/problem.h"
#include "majorant/framework/terms/manifold_problem.h"

namespace majorant {

// The problem in the form that methods receive.
struct ComparedProblem {
  Problem problem;
  std::vector<HeldBound> bounds = {};  // of the problem, held by barriers
  // The manifolds of the unknowns; `problem` is then their chart around the start. Null: none.
  std::shared_ptr<const ManifoldProblem> manifolds = {};

  // Returns whether the problem has bounds or equalities, which only BarrierMinimizer holds.
  bool holds() const;
};

// The limits that a comparison sets in addition to the rules of each method.
struct MethodLimits {
  std::optional<double> tolerance = {};    // StoppingRules::relative_decrease, of Newton's method
  std::optional<int> max_iterations = {};  // none: the method's own
  StopCheck stop = {};
  // Wraps the solver of a method, to count and to time it; empty: no wrapper.
  std::function<SolverFactory(SolverFactory)> watched = {};

  SolverFactory solver(SolverFactory own) const { return watched ? watched(own) : own; }
};

struct ComparisonMethod {
  std::string name, summary;
  // The reason why a problem does not suit the method; empty if it does.
  std::function<std::string(const ComparedProblem&)> obstacle;
  std::function<std::unique_ptr<Minimizer>(const ComparedProblem&, const MethodLimits&)> make;
};

// Newton's method with these options: as BarrierMinimizer's on bounds and equalities, as
// ManifoldProblem's on manifolds.
ComparisonMethod newton_method(std::string name, std::string summary, NewtonOptions options);
// Returns "newton", one method for each choice of curvature (curvature_choice.h) that never changes
// its curvature, and "newton-eigen". base: the options that they share.
std::vector<ComparisonMethod> newton_methods(const NewtonOptions& base = {});

// A method that holds neither bounds nor equalities nor manifolds. `more` (may be empty) returns
// its other obstacles.
ComparisonMethod free_method(
    std::string name, std::string summary,
    std::function<std::unique_ptr<Minimizer>(const ComparedProblem&, const MethodLimits&)> make,
    std::function<std::string(const ComparedProblem&)> more = {});
// Returns the reason why a problem is no least squares problem; empty if it is.
std::string squares_obstacle(const ComparedProblem& problem);

// Returns all methods of the framework, then `others`, then a row without a run for each known
// method that is missing.
std::vector<ComparisonMethod> comparison_methods(std::vector<ComparisonMethod> others = {});
// Returns the methods with these names, in this order, each once. Throws InvalidArgument, which
// lists all names, if a name is unknown.
std::vector<ComparisonMethod> named_methods(const std::vector<std::string>& names,
                                            const std::vector<ComparisonMethod>& known);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
