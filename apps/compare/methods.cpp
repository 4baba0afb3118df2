#include "apps/compare/methods.h"

#include <fmt/format.h>

#include <vector>

#include "apps/compare/ceres_plugin.h"
#include "apps/parts.h"
#include "apps/plugins/plugin.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/first_order.h"
#include "majorant/maps/newton_of_maps.h"

namespace majorant::app {
namespace {

// Solvers of Ceres among the methods of `majorant compare`, from a library that is loaded when one
// of them is to run: none in a build without GPL parts.

const CeresPlugin& ceres() {
  static const CeresPlugin& plugin = load_plugin<CeresPlugin>(kCeresPlugin);
  plugin.silence();
  return plugin;
}

void load_ceres() { ceres(); }

Method ceres_gradient(std::string name, std::string summary, CeresOptions::Method method) {
  return {std::move(name), std::move(summary), nullptr,
          [method](const Contest& c) {
            CeresOptions options;
            options.method = method;
            options.max_iterations = c.max_iterations;
            options.stop = c.stop;
            return ceres().gradient(options);
          },
          load_ceres};
}

Method least_squares() {
  const auto obstacle = [](const Contest& c) -> std::string {
    const EnergySum& energy = c.specification.energy;
    const std::string squares = symmetric_dirichlet().traits().name;
    if (energy.size() != 1 || energy[0].make.traits().name != squares || energy[0].weight != 1)
      return "it needs --energy " + squares;
    if (c.specification.face_weight.size()) return "it does not know --weights";
    if (!c.specification.handles.empty()) return "it does not know --handles";
    return {};
  };
  return {"ceres-lm", "Ceres, Levenberg-Marquardt on J and J^-1 as residuals", obstacle,
          [](const Contest& c) {
            LeastSquaresOptions options;
            options.max_iterations = c.max_iterations;
            return ceres().least_squares(c.space, *c.specification.rest, c.rule, options);
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

// Where the exact Hessian takes over near the minimum; never, for methods named after a model.
const double kExactTail = BlendRules().below;
constexpr double kNoExactTail = 0;

Method newton(
    std::string name, std::string summary, Curvature curvature, double blend_below,
    SolverFactory linear_solver = [] { return make_direct_solver(); }) {
  const auto obstacle = [curvature](const Contest& c) {
    return c.problem.supports(curvature) ? std::string()
                                         : fmt::format("energy '{}' has no curvature model '{}'",
                                                       c.energy, curvature_name(curvature));
  };
  return {std::move(name), std::move(summary), obstacle, [=](const Contest& c) {
            NewtonOptions options = newton_of_maps();
            options.curvature = curvature;
            options.blend.below = blend_below;
            options.linear_solver = linear_solver;
            options.stopping.relative_decrease = c.tolerance;
            options.stopping.max_iterations = c.max_iterations;
            options.stop = c.stop;
            return std::make_unique<NewtonMinimizer>(options);
          }};
}

// The same unknowns with the Dirichlet energy |J|^2, whose Hessian is the Laplacian.
Problem dirichlet_problem(const Contest& c) {
  MapSpecification spec = c.specification;
  spec.energy = {{energy_factory(
      invariant("dirichlet", [](const auto& x, const auto& y) { return 2.0 * (x + y); },
                {Domain::Everywhere, Convexity::Convex}))}};
  return map_problem(spec, c.space, c.start, energy_terms(spec, c.space, {c.rule}), c.injectivity)
      .problem;
}

std::unique_ptr<Minimizer> make_gradient_flow(const Contest& c) {
  GradientFlowOptions options;
  options.metric = dirichlet_problem(c);
  options.stopping.max_iterations = c.max_iterations;
  options.stop = c.stop;
  return std::make_unique<GradientFlowMinimizer>(options);
}

std::unique_ptr<Minimizer> make_lbfgs(const Contest& c) {
  LbfgsOptions options;
  options.metric = dirichlet_problem(c);
  options.stopping.max_iterations = c.max_iterations;
  options.stop = c.stop;
  return std::make_unique<LbfgsMinimizer>(options);
}

std::unique_ptr<Minimizer> make_hessian_lbfgs(const Contest& c) {
  LbfgsOptions options;
  options.stopping.max_iterations = c.max_iterations;
  options.stop = c.stop;
  return std::make_unique<LbfgsMinimizer>(options);
}

std::vector<Method> all_methods() {
  std::vector<Method> all{
      newton("newton", "Newton, projected Hessian, exact near the minimum", Curvature::Projected,
             kExactTail),
      newton("newton-projected", "Newton, projected Hessian throughout", Curvature::Projected,
             kNoExactTail),
      newton("newton-majorizer", "Newton, composite majorizer", Curvature::Majorizer, kNoExactTail),
      newton("newton-paper-majorizer", "Newton, the paper's majorizer",
             Curvature::CompositeMajorizer, kNoExactTail),
      newton("newton-reweighted", "Newton, SLIM's reweighting", Curvature::Reweighted,
             kNoExactTail),
      newton("newton-exact", "Newton, exact Hessian, shifted where indefinite", Curvature::Exact,
             kNoExactTail),
      newton("newton-eigen", "newton with Eigen's L D L^T", Curvature::Projected, kExactTail,
             [] { return make_eigen_ldlt_solver(); }),
      {"lbfgs", "L-BFGS, metric: Laplacian", nullptr, make_lbfgs},
      {"lbfgs-hessian", "L-BFGS, metric: projected Hessian at the start", nullptr,
       make_hessian_lbfgs},
      {"gradient-flow", "gradient flow in the Sobolev metric of the Laplacian", nullptr,
       make_gradient_flow},
  };
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
