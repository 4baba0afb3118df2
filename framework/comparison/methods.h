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
// Those of Ceres and CHOLMOD are in ceres_methods.h and cholmod_methods.h, since they need
// libraries that are asked for by name. Not for choosing a method in a program, which makes its
// Minimizer (minimizer.h) itself.
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

// A problem as methods are given it.
struct ComparedProblem {
  Problem problem;
  std::vector<HeldBound> bounds = {};  // of the problem, to be held along barriers
  // Unknowns on manifolds: `problem` is its chart around the start then. Null: there are none.
  std::shared_ptr<const ManifoldProblem> manifolds = {};

  // Returns whether only BarrierMinimizer keeps what is to hold: bounds and equalities.
  bool holds() const;
};

// The limits that a comparison sets in addition to the rules of each method.
struct MethodLimits {
  std::optional<double> tolerance = {};    // StoppingRules::relative_decrease, of Newton's method
  std::optional<int> max_iterations = {};  // none: the method's own
  StopCheck stop = {};
  // Put around the solver of a method, to count and to time; empty: none.
  std::function<SolverFactory(SolverFactory)> watched = {};

  SolverFactory solver(SolverFactory own) const { return watched ? watched(own) : own; }
};

struct ComparisonMethod {
  std::string name, summary;
  // The reason why a problem is not for the method; empty where it is.
  std::function<std::string(const ComparedProblem&)> obstacle;
  std::function<std::unique_ptr<Minimizer>(const ComparedProblem&, const MethodLimits&)> make;
};

// Newton's method with these options: on bounds and equalities as BarrierMinimizer's, on manifolds
// as ManifoldProblem's.
ComparisonMethod newton_method(std::string name, std::string summary, NewtonOptions options);
// "newton", then one method for each choice of curvature (curvature_choice.h), which keeps to it
// throughout, and "newton-eigen". base: what they share.
std::vector<ComparisonMethod> newton_methods(const NewtonOptions& base = {});

// A method that holds neither bounds nor equalities nor manifolds, and has no other obstacle than
// what `more` says; more may be empty.
ComparisonMethod free_method(
    std::string name, std::string summary,
    std::function<std::unique_ptr<Minimizer>(const ComparedProblem&, const MethodLimits&)> make,
    std::function<std::string(const ComparedProblem&)> more = {});
// The reason why a problem is no least squares; empty where it is.
std::string squares_obstacle(const ComparedProblem& problem);

// All methods of the framework, those of `others`, and a row without a run for each known method
// that neither has.
std::vector<ComparisonMethod> comparison_methods(std::vector<ComparisonMethod> others = {});
// Returns the methods with these names, in this order, each once. Throws InvalidArgument, which
// lists all names, if a name is unknown.
std::vector<ComparisonMethod> named_methods(const std::vector<std::string>& names,
                                            const std::vector<ComparisonMethod>& known);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
