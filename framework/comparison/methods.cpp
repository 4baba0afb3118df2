#include "majorant/framework/comparison/methods.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "majorant/framework/equality_term.h"
#include "majorant/framework/error.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/levenberg_marquardt.h"
#include "majorant/framework/residual_term.h"

namespace majorant {
namespace {

// Newton's method where unknowns lie on manifolds: y0, and y of the result, are the full unknowns.
class ManifoldNewton final : public Minimizer {
 public:
  ManifoldNewton(std::shared_ptr<const ManifoldProblem> problem, NewtonOptions options)
      : problem_(std::move(problem)), options_(std::move(options)) {}
  SolveResult minimize(const Problem&, Vec x0, RunObserver* observer) const override {
    ManifoldResult result = problem_->minimize(x0, options_, observer);
    result.y = std::move(result.x);
    return result;
  }

 private:
  std::shared_ptr<const ManifoldProblem> problem_;
  NewtonOptions options_;
};

std::string curvature_obstacle(const ComparedProblem& p, Curvature curvature) {
  for (const TermId id : p.problem.terms())
    if (!p.problem.term(id).supports(curvature))
      return fmt::format("term '{}' has no curvature model '{}'", p.problem.term(id).name(),
                         curvature_name(curvature));
  return {};
}

void limit(NewtonOptions& options, const MethodLimits& limits) {
  if (limits.tolerance) options.stopping.relative_decrease = *limits.tolerance;
  if (limits.max_iterations) options.stopping.max_iterations = *limits.max_iterations;
  options.linear_solver = limits.solver(options.linear_solver);
  options.stop = limits.stop;
}

template <class Options>
Options first_order(const MethodLimits& limits) {
  Options options;
  if (limits.max_iterations) options.stopping.max_iterations = *limits.max_iterations;
  options.linear_solver = limits.solver(options.linear_solver);
  options.stop = limits.stop;
  return options;
}

ComparisonMethod levenberg_marquardt() {
  return free_method(
      "levenberg-marquardt", "damped steps for least squares",
      [](const ComparedProblem&, const MethodLimits& limits) {
        auto options = first_order<LevenbergMarquardtOptions>(limits);
        if (limits.tolerance) options.stopping.relative_decrease = *limits.tolerance;
        return std::make_unique<LevenbergMarquardtMinimizer>(std::move(options));
      },
      squares_obstacle);
}

// A method of another library, and the header that provides it.
struct Foreign {
  const char *name, *summary, *home;
};
constexpr const char *kCeres = "Ceres", *kCholmod = "CHOLMOD", *kPetsc = "PETSc";
constexpr Foreign kForeign[] = {
    {"newton-cholmod", "newton with CHOLMOD", kCholmod},
    {"newton-mumps", "newton with MUMPS", kPetsc},
    {"newton-cg-hypre", "newton with conjugate gradients and BoomerAMG", kPetsc},
    {"ceres-lbfgs", "Ceres, L-BFGS", kCeres},
    {"ceres-lm", "Ceres, Levenberg-Marquardt", kCeres},
    {"ceres-dogleg", "Ceres, dogleg", kCeres},
};

bool contains(const std::vector<ComparisonMethod>& methods, const std::string& name) {
  return std::any_of(methods.begin(), methods.end(),
                     [&](const ComparisonMethod& m) { return m.name == name; });
}

}  // namespace

bool ComparedProblem::holds() const {
  const auto terms = problem.terms();
  return !bounds.empty() || std::any_of(terms.begin(), terms.end(), [&](TermId id) {
    return dynamic_cast<const EqualityTerm*>(&problem.term(id)) != nullptr;
  });
}

ComparisonMethod newton_method(std::string name, std::string summary, NewtonOptions options) {
  const Curvature curvature = options.curvature;
  return {std::move(name), std::move(summary),
          [curvature](const ComparedProblem& p) { return curvature_obstacle(p, curvature); },
          [options = std::move(options)](const ComparedProblem& p,
                                         const MethodLimits& limits) -> std::unique_ptr<Minimizer> {
            NewtonOptions own = options;
            limit(own, limits);
            if (p.manifolds) return std::make_unique<ManifoldNewton>(p.manifolds, std::move(own));
            if (!p.holds()) return std::make_unique<NewtonMinimizer>(std::move(own));
            BarrierOptions held;
            held.newton = std::move(own);
            return std::make_unique<BarrierMinimizer>(
                BarrierMinimizer::of_bounds(p.bounds, {}, std::move(held)));
          }};
}

std::vector<ComparisonMethod> newton_methods(const NewtonOptions& base) {
  std::vector<ComparisonMethod> all;
  all.push_back(newton_method("newton", "Newton, projected Hessian, exact near the minimum", base));
  const auto add = [&](const char* choice, const char* summary) {
    NewtonOptions options = base;
    options.set_curvature(*curvature_choice(choice));
    options.blend.below = 0;  // a method named after a model never changes it
    all.push_back(newton_method(fmt::format("newton-{}", choice), summary, std::move(options)));
  };
  add("projected", "Newton, projected Hessian throughout");
  add("absolute", "Newton, eigenvalues by absolute value");
  add("adaptive", "Newton, projected or absolute, as the last step went");
  add("majorizer", "Newton, composite majorizer");
  add("paper-majorizer", "Newton, the paper's majorizer");
  add("reweighted", "Newton, SLIM's reweighting");
  add("exact", "Newton, exact Hessian, shifted where indefinite");
  NewtonOptions eigen = base;
  eigen.linear_solver = [] { return make_eigen_ldlt_solver(); };
  all.push_back(newton_method("newton-eigen", "newton with Eigen's L D L^T", std::move(eigen)));
  return all;
}

ComparisonMethod free_method(
    std::string name, std::string summary,
    std::function<std::unique_ptr<Minimizer>(const ComparedProblem&, const MethodLimits&)> make,
    std::function<std::string(const ComparedProblem&)> more) {
  const auto obstacle = [more = std::move(more)](const ComparedProblem& p) -> std::string {
    if (p.manifolds) return "unknowns on manifolds are for Newton's method";
    if (p.holds()) return "bounds and equalities are held by Newton's method, along barriers";
    return more ? more(p) : std::string();
  };
  return {std::move(name), std::move(summary), obstacle, std::move(make)};
}

std::string squares_obstacle(const ComparedProblem& p) {
  for (const TermId id : p.problem.terms())
    if (!dynamic_cast<const ResidualTerm*>(&p.problem.term(id)))
      return fmt::format("term '{}' is no sum of squares", p.problem.term(id).name());
  return {};
}

std::vector<ComparisonMethod> comparison_methods(std::vector<ComparisonMethod> others) {
  std::vector<ComparisonMethod> all = newton_methods();
  const auto has_projected = [](const ComparedProblem& p) {
    return curvature_obstacle(p, Curvature::Projected);  // of the metric
  };
  all.push_back(free_method(
      "lbfgs", "L-BFGS, metric: projected Hessian at the start",
      [](const ComparedProblem&, const MethodLimits& limits) {
        return std::make_unique<LbfgsMinimizer>(first_order<LbfgsOptions>(limits));
      },
      has_projected));
  all.push_back(free_method(
      "gradient-flow", "gradient flow in the same metric",
      [](const ComparedProblem&, const MethodLimits& limits) {
        return std::make_unique<GradientFlowMinimizer>(first_order<GradientFlowOptions>(limits));
      },
      has_projected));
  all.push_back(levenberg_marquardt());
  for (ComparisonMethod& method : others) all.push_back(std::move(method));
  for (const Foreign& foreign : kForeign)
    if (!contains(all, foreign.name))
      all.push_back({foreign.name,
                     foreign.summary,
                     [home = foreign.home](const ComparedProblem&) {
                       return fmt::format("{} is not in this program", home);
                     },
                     {}});
  return all;
}

std::vector<ComparisonMethod> named_methods(const std::vector<std::string>& names,
                                            const std::vector<ComparisonMethod>& known) {
  std::vector<ComparisonMethod> chosen;
  for (const std::string& name : names) {
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const ComparisonMethod& m) { return m.name == name; });
    if (found == known.end()) {
      std::vector<std::string> all;
      for (const ComparisonMethod& method : known) all.push_back(method.name);
      throw InvalidArgument(
          fmt::format("no method is called '{}'; use {}", name, fmt::join(all, ", ")));
    }
    if (!contains(chosen, name)) chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
