#include "methods.h"

#include <ctime>
#include <limits>
#include <utility>

#include "majorant/framework/first_order.h"
#include "majorant/framework/newton.h"

namespace majorant::elasticity {
namespace {

class CountingSolver final : public LinearSolver {
 public:
  explicit CountingSolver(Counts& counts) : counts_(counts), solver_(make_direct_solver()) {}
  void analyze(const SparsePattern& pattern) override { solver_->analyze(pattern); }
  FactorStatus factorize(const Vec& values, double shift) override {
    ++counts_.factorizations;
    return solver_->factorize(values, shift);
  }
  Solution solve(const Vec& r, Vec& p, double tolerance) override {
    ++counts_.solves;
    return solver_->solve(r, p, tolerance);
  }

 private:
  Counts& counts_;
  std::shared_ptr<LinearSolver> solver_;
};

// Ends a run only if the gradient is small.
class GradientTest final : public RunObserver {
 public:
  GradientTest(const Problem& problem, double tolerance)
      : evaluator_(problem), tolerance_(tolerance) {}
  double largest_entry(const Vec& y) {
    evaluator_.gradient(y, gradient_);
    return gradient_.cwiseAbs().maxCoeff();
  }
  Directive after_step(const TraceEntry&, const Vec& y) override {
    return largest_entry(y) < tolerance_ ? Directive::Interrupt : Directive::Continue;
  }

 private:
  Evaluator evaluator_;
  Vec gradient_;
  double tolerance_;
};

NewtonOptions filter_alone() {
  NewtonOptions options;
  options.blend.below = 0;
  options.blend.misled_steps = 0;
  return options;
}

NewtonOptions newton_options(Method method) {
  NewtonOptions options = method == Method::Blend ? NewtonOptions() : filter_alone();
  if (method == Method::Absolute) options.projection = 2;
  if (method == Method::Adaptive) options.set_curvature(*curvature_choice("adaptive"));
  if (method == Method::Majorizer) options.curvature = Curvature::Majorizer;
  if (method == Method::PaperMajorizer) options.curvature = Curvature::CompositeMajorizer;
  if (method == Method::Reweighted) options.curvature = Curvature::Reweighted;
  if (method == Method::Shifted) options.curvature = Curvature::Exact;
  return options;
}

void stop_by_gradient_alone(StoppingRules& rules, int max_iterations) {
  rules.relative_decrease = -std::numeric_limits<double>::infinity();
  rules.decrement = 0;
  rules.max_iterations = max_iterations;
}

std::unique_ptr<Minimizer> minimizer(const Case& c, Method method, int max_iterations,
                                     Counts& counts) {
  const SolverFactory solver = [&counts] { return std::make_shared<CountingSolver>(counts); };
  if (method == Method::Lbfgs) {
    LbfgsOptions options;
    options.metric = c.problem;
    options.linear_solver = solver;
    stop_by_gradient_alone(options.stopping, max_iterations);
    return std::make_unique<LbfgsMinimizer>(options);
  }
  NewtonOptions options = newton_options(method);
  options.linear_solver = solver;
  options.tests_minimum = false;
  stop_by_gradient_alone(options.stopping, max_iterations);
  return std::make_unique<NewtonMinimizer>(options);
}

}  // namespace

std::string method_name(Method method) {
  switch (method) {
    case Method::Clamp:
      return "clamp";
    case Method::Absolute:
      return "absolute";
    case Method::Adaptive:
      return "adaptive";
    case Method::Majorizer:
      return "majorizer";
    case Method::PaperMajorizer:
      return "composite majorization";
    case Method::Reweighted:
      return "reweighted";
    case Method::Lbfgs:
      return "L-BFGS";
    case Method::Shifted:
      return "exact with shift";
    default:
      return "blend (default)";
  }
}

bool supports(const Problem& problem, Method method) {
  return method == Method::Lbfgs || problem.supports(newton_options(method).curvature);
}

Counts run(const Case& c, Method method, double tolerance, int max_iterations) {
  Counts counts;
  GradientTest test(c.problem, tolerance);
  const std::clock_t before = std::clock();
  const auto method_of_run = minimizer(c, method, max_iterations, counts);
  SolveResult result = method_of_run->minimize(c.problem, c.start, &test);
  counts.cpu_seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  counts.iterations = static_cast<int>(result.iterations.size());
  counts.energy = result.energy;
  counts.gradient = test.largest_entry(result.y);
  counts.is_reached = counts.gradient < tolerance;
  counts.status = status_name(result.status);
  counts.y = std::move(result.y);
  return counts;
}

}  // namespace majorant::elasticity

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
