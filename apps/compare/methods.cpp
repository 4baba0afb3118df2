#include "apps/compare/methods.h"

#include <memory>
#include <utility>
#include <vector>

#include "apps/compare/ceres_plugin.h"
#include "apps/compare/linear_solver_run.h"
#include "apps/parts.h"
#include "apps/plugins/plugin.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/first_order.h"
#include "majorant/maps/newton_of_maps.h"

namespace majorant::app {
namespace {

// Returns the iteration limit of a method; Newton's default if none is set.
int iterations_of(const MethodLimits& limits) {
  return limits.max_iterations.value_or(StoppingRules().max_iterations);
}

// Returns the methods of Ceres, from a library that is loaded on first use. Builds without GPL
// parts have none.

const CeresPlugin& ceres() {
  static const CeresPlugin& plugin = load_plugin<CeresPlugin>(kCeresPlugin);
  plugin.silence();
  return plugin;
}

void load_ceres() { ceres(); }

Method ceres_gradient(std::string name, std::string summary, CeresOptions::Method own) {
  return {name, summary,
          [=](const BenchmarkProblem&) {
            return free_method(name, summary, [=](auto&, const MethodLimits& limits) {
              CeresOptions options;
              options.method = own;
              options.max_iterations = iterations_of(limits);
              options.stop = limits.stop;
              return ceres().gradient(options);
            });
          },
          load_ceres};
}

std::string squares_obstacle_of_maps(const MapSpecification& specification) {
  const EnergySum& energy = specification.energy;
  const std::string squares = symmetric_dirichlet().traits().name;
  if (energy.size() != 1 || energy[0].make.traits().name != squares || energy[0].weight != 1)
    return "it needs --energy " + squares;
  if (specification.face_weight.size()) return "it does not support --weights";
  if (!specification.handles.empty()) return "it does not support --handles";
  return {};
}

Method least_squares() {
  const std::string name = "ceres-lm",
                    summary = "Ceres, Levenberg-Marquardt on J and J^-1 as residuals";
  return {name, summary,
          [=](const BenchmarkProblem& c) {
            return free_method(
                name, summary,
                [space = c.space, rest = c.specification.rest, rule = c.rule](
                    auto&, const MethodLimits& limits) {
                  LeastSquaresOptions options;
                  options.max_iterations = iterations_of(limits);
                  options.stop = limits.stop;
                  return ceres().least_squares(space, *rest, rule, options);
                },
                [why = squares_obstacle_of_maps(c.specification)](auto&) { return why; });
          },
          load_ceres};
}

std::vector<Method> ceres_methods() {
  if (!has_gpl_parts()) return {};
  return {
      ceres_gradient("ceres-lbfgs", "Ceres, L-BFGS", CeresOptions::Method::Lbfgs),
      ceres_gradient("ceres-nlcg", "Ceres, nonlinear conjugate gradients",
                     CeresOptions::Method::NonlinearConjugateGradient),
      least_squares(),
  };
}

// Returns the problem with the Dirichlet energy |J|^2, whose Hessian is the Laplacian.
Problem dirichlet_problem(const BenchmarkProblem& c) {
  MapSpecification spec = c.specification;
  spec.energy = {{energy_factory(
      invariant("dirichlet", [](const auto& x, const auto& y) { return 2.0 * (x + y); },
                {Domain::Everywhere, Convexity::Convex}))}};
  return map_problem(spec, c.space, c.start, energy_terms(spec, c.space, {c.rule}), c.injectivity)
      .problem;
}

// Minimizes by L-BFGS or gradient flow.
template <class TheMinimizer, class Options>
Method first_order(std::string name, std::string summary, bool is_laplacian) {
  return {name, summary, [=](const BenchmarkProblem& c) {
            // The metric is made outside of the timed part, on the thread that runs the method.
            const auto benchmark = std::make_shared<const BenchmarkProblem>(c);
            return free_method(name, summary, [=](auto&, const MethodLimits& limits) {
              Options options;
              if (is_laplacian) options.metric = dirichlet_problem(*benchmark);
              options.stopping.max_iterations = iterations_of(limits);
              options.linear_solver = limits.solver(options.linear_solver);
              options.stop = limits.stop;
              return std::make_unique<TheMinimizer>(options);
            });
          }};
}

Method independent(ComparisonMethod method) {
  const std::string name = method.name, summary = method.summary;
  return {name, summary, [method = std::move(method)](const BenchmarkProblem&) { return method; }};
}

// Makes Newton's method with one of the solvers of --linear-solvers.
Method newton_by(const char* solver, std::string summary, void (*load)()) {
  NewtonOptions options = newton_of_maps();
  options.linear_solver = [solver] { return linear_solver_named(solver); };
  options.near_null_space = near_null_space_of_maps();
  Method method = independent(
      newton_method(std::string("newton-") + solver, std::move(summary), std::move(options)));
  method.load = load;
  method.is_default = false;
  return method;
}

std::vector<Method> all_methods() {
  std::vector<Method> all;
  for (ComparisonMethod& method : newton_methods(newton_of_maps()))
    all.push_back(independent(std::move(method)));
  all.push_back(newton_by("cholmod", "newton with CHOLMOD; by name alone, as the next two",
                          [] { linear_solver_named("cholmod"); }));
  all.push_back(newton_by("mumps", "newton with MUMPS", [] { linear_solver_named("mumps"); }));
  all.push_back(newton_by("cg-hypre", "newton with conjugate gradients and BoomerAMG",
                          [] { linear_solver_named("cg-hypre"); }));
  all.push_back(
      first_order<LbfgsMinimizer, LbfgsOptions>("lbfgs", "L-BFGS, metric: Laplacian", true));
  all.push_back(first_order<LbfgsMinimizer, LbfgsOptions>(
      "lbfgs-hessian", "L-BFGS, metric: projected Hessian at the start", false));
  all.push_back(first_order<GradientFlowMinimizer, GradientFlowOptions>(
      "gradient-flow", "gradient flow in the Sobolev metric of the Laplacian", true));
  for (Method& method : ceres_methods()) all.push_back(std::move(method));
  return all;
}

}  // namespace

std::span<const Method> methods() {
  static const std::vector<Method> all = all_methods();
  return all;
}

const Method* find_method(const std::string& name) {
  for (const Method& m : methods())
    if (m.name == name) return &m;
  return nullptr;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
