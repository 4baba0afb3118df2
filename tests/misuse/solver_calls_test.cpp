// Wrong calls of minimizers, and messages for energies without a minimum.
#include <cmath>
#include <limits>
#include <memory>

#include "framework/scalar_terms.h"
#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/inequality.h"
#include "misuse/outcome.h"

namespace majorant::misuse {
namespace solver_calls {

using test::Chain;
using test::Scalar;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr Index kCount = 5;

Problem problem(const Scalar& phi) {
  ProblemBuilder builder(kCount);
  builder.add(std::make_shared<const Chain>(kCount, phi), 1.0);
  return builder.build();
}
Problem good() { return problem(test::parabola(1, 0)); }

Scalar linear() {
  return {[](double t) { return 3 * t; }, [](double) { return 3.0; }, [](double) { return 0.0; }};
}
Scalar hill() {
  return {[](double t) { return -t * t; }, [](double t) { return -2 * t; },
          [](double) { return -2.0; }};
}
Scalar nowhere() {
  return {[](double) { return kNan; }, [](double) { return kNan; }, [](double) { return kNan; }};
}
Scalar nan_slope() {
  return {[](double t) { return t * t; }, [](double) { return kNan; }, [](double) { return 2.0; }};
}
Scalar nan_curvature() {
  return {[](double t) { return t * t; }, [](double t) { return 2 * t; },
          [](double) { return kNan; }};
}
Scalar outside() {
  return {[](double t) { return t > 0 ? t - std::log(t) : test::kInfinity; },
          [](double t) { return 1 - 1 / t; }, [](double t) { return 1 / (t * t); }};
}

Vec ones(Index n = kCount) { return Vec::Ones(n); }
Vec with_nan() {
  Vec y = ones();
  y[3] = kNan;
  return y;
}

SolveResult newton(const Problem& p, Vec y0, NewtonOptions o = {}) {
  return NewtonMinimizer(std::move(o)).minimize(p, std::move(y0), {});
}
SolveResult newton_with(const std::function<void(NewtonOptions&)>& change) {
  NewtonOptions o;
  change(o);
  return newton(good(), ones(), o);
}
SolveResult lbfgs_with(const std::function<void(LbfgsOptions&)>& change) {
  LbfgsOptions o;
  change(o);
  return LbfgsMinimizer(std::move(o)).minimize(good(), ones(), {});
}
SolveResult flow_with(const std::function<void(GradientFlowOptions&)>& change) {
  GradientFlowOptions o;
  change(o);
  return GradientFlowMinimizer(std::move(o)).minimize(good(), ones(), {});
}
SolveResult ceres_with(const std::function<void(CeresOptions&)>& change) {
  CeresOptions o;
  change(o);
  return CeresMinimizer(o).minimize(good(), ones(), {});
}
Problem smaller() {
  ProblemBuilder builder(kCount - 1);
  builder.add(std::make_shared<const Chain>(kCount - 1, test::parabola(1, 0)), 1.0);
  return builder.build();
}

// Certifies steps up to the given bound only, which may be invalid.
struct Answers final : FeasibilityChecker {
  explicit Answers(double says) : step(says) {}
  std::string_view name() const override { return "answers"; }
  Verdict check(VecIn) const override { return {}; }
  StepBound max_step(VecIn, VecIn, double) const override { return {step, {}}; }
  double step;
};
SolveResult newton_checked(std::shared_ptr<const FeasibilityChecker> checker) {
  ProblemBuilder builder(kCount);
  builder.add(std::make_shared<const Chain>(kCount, test::parabola(1, 0)), 1.0);
  builder.add(std::move(checker));
  return newton(builder.build(), 3 * ones());
}

const std::vector<Call> kCalls{
    {"checker_nan_step",
     "InvalidArgument: feasibility checker 'answers': max_step() is nan for a step of 1;",
     [] { return newton_checked(std::make_shared<const Answers>(kNan)); }},
    {"checker_negative_step", "InvalidArgument: feasibility checker 'answers': max_step() is -1",
     [] { return newton_checked(std::make_shared<const Answers>(-1)); }},
    {"checker_without_limit", "converged",
     [] { return newton_checked(std::make_shared<const Answers>(test::kInfinity)); }},
    {"bounds_of_fewer",
     "InvalidArgument: Bounds of 3 unknowns in a problem of 5: one for each of the full unknowns",
     [] { return newton_checked(Bounds(Vec::Zero(3), Vec::Constant(3, 9)).checker()); }},
    {"bounds_of_more", "InvalidArgument: Bounds of 6 unknowns in a problem of 5",
     [] { return newton_checked(Bounds(Vec::Zero(6), Vec::Constant(6, 9)).checker()); }},
    {"newton_short_start", "InvalidArgument: the start y has 3 numbers, 5 are needed",
     [] { return newton(good(), ones(3)); }},
    {"newton_empty_start", "InvalidArgument: the start y has 0 numbers",
     [] { return newton(good(), Vec()); }},
    {"newton_long_start", "InvalidArgument: the start y has 6 numbers",
     [] { return newton(good(), ones(6)); }},
    {"newton_nan_start", "InvalidArgument: the start y[3] is nan",
     [] { return newton(good(), with_nan()); }},
    {"newton_infinite_start", "InvalidArgument: the start y[0] is inf",
     [] { return newton(good(), Vec::Constant(kCount, test::kInfinity)); }},
    {"lbfgs_short_start", "InvalidArgument: the start y has 3 numbers",
     [] { return LbfgsMinimizer().minimize(good(), ones(3), {}); }},
    {"lbfgs_nan_start", "InvalidArgument: the start y[3] is nan",
     [] { return LbfgsMinimizer().minimize(good(), with_nan(), {}); }},
    {"flow_short_start", "InvalidArgument: the start y has 3 numbers",
     [] { return GradientFlowMinimizer().minimize(good(), ones(3), {}); }},
    {"ceres_short_start", "InvalidArgument: the start y has 3 numbers",
     [] { return CeresMinimizer().minimize(good(), ones(3), {}); }},
    {"ceres_nan_start", "InvalidArgument: the start y[3] is nan",
     [] { return CeresMinimizer().minimize(good(), with_nan(), {}); }},
    {"no_terms", "InvalidArgument: the problem has no terms, nothing to minimize",
     [] { return newton(ProblemBuilder(3).build(), ones(3)); }},
    {"ceres_no_terms", "InvalidArgument: the problem has no terms",
     [] { return CeresMinimizer().minimize(ProblemBuilder(3).build(), ones(3), {}); }},
    {"linear", "failed: unbounded below: the energy falls to -1.5e+13",
     [] { return newton(problem(linear()), ones()); }},
    {"linear_lbfgs", "failed: unbounded below",
     [] { return LbfgsMinimizer().minimize(problem(linear()), ones(), {}); }},
    {"linear_flow", "failed: unbounded below",
     [] { return GradientFlowMinimizer().minimize(problem(linear()), ones(), {}); }},
    {"linear_ceres", "failed: unbounded below",
     [] { return CeresMinimizer().minimize(problem(linear()), ones(), {}); }},
    {"hill_ceres", "failed: unbounded below",
     [] { return CeresMinimizer().minimize(problem(hill()), ones(), {}); }},
    {"hill_ceres_conjugate_gradients", "failed: unbounded below",
     [] {
       CeresOptions o;
       o.method = CeresOptions::Method::NonlinearConjugateGradient;
       return CeresMinimizer(o).minimize(problem(hill()), ones(), {});
     }},
    {"hill_exact", "failed: unbounded below: the energy falls to -",
     [] { return newton(problem(hill()), ones(), {.curvature = Curvature::Exact}); }},
    {"nan_everywhere",
     "infeasible: the start lies outside the energy's domain: value is NaN in element 0 of term "
     "'chain'",
     [] { return newton(problem(nowhere()), ones()); }},
    {"nan_in_one_element", "...value is NaN in element 3 of term 'chain' (1 of 5",
     [] {
       const Scalar phi{[](double t) { return t == 7 ? kNan : t * t; },
                        [](double t) { return 2 * t; }, [](double) { return 2.0; }};
       Vec y = ones();
       y[3] = 7;
       return newton(problem(phi), y);
     }},
    {"outside_in_one_element", "...value is inf in element 2 of term 'chain' (1 of 5",
     [] {
       Vec y = ones();
       y[2] = -1;
       return newton(problem(outside()), y);
     }},
    {"outside_everywhere", "...infinite, or was NaN, in all 5 elements of term 'chain'",
     [] { return newton(problem(outside()), -ones()); }},
    {"nan_gradient", "failed: no finite direction: gradient is NaN in element 0 of term 'chain'",
     [] { return newton(problem(nan_slope()), ones()); }},
    {"nan_gradient_lbfgs", "failed: no finite direction: gradient is NaN",
     [] { return LbfgsMinimizer().minimize(problem(nan_slope()), ones(), {}); }},
    {"nan_hessian", "failed: no finite direction: Hessian is NaN in element 0 of term 'chain'",
     [] { return newton(problem(nan_curvature()), ones()); }},
    {"no_solver", "InvalidArgument: NewtonOptions: linear_solver is null",
     [] { return newton_with([](NewtonOptions& o) { o.linear_solver = nullptr; }); }},
    {"solver_makes_null", "InvalidArgument: what NewtonOptions: linear_solver makes is null",
     [] {
       return newton_with([](NewtonOptions& o) {
         o.linear_solver = [] { return std::unique_ptr<LinearSolver>(); };
       });
     }},
    {"lbfgs_no_solver", "InvalidArgument: LbfgsOptions: linear_solver is null",
     [] { return lbfgs_with([](LbfgsOptions& o) { o.linear_solver = nullptr; }); }},
    {"flow_no_solver", "InvalidArgument: GradientFlowOptions: linear_solver is null",
     [] { return flow_with([](GradientFlowOptions& o) { o.linear_solver = nullptr; }); }},
    {"negative_history", "InvalidArgument: LbfgsOptions: history is -1",
     [] { return lbfgs_with([](LbfgsOptions& o) { o.history = -1; }); }},
    {"negative_kept_history", "InvalidArgument: NewtonOptions: lagged.history is -5",
     [] { return newton_with([](NewtonOptions& o) { o.lagged.history = -5; }); }},
    {"metric_of_other_size", "InvalidArgument: the metric's problem has other unknowns",
     [] { return lbfgs_with([](LbfgsOptions& o) { o.metric = smaller(); }); }},
    {"flow_metric_of_other_size", "InvalidArgument: the metric's problem has other unknowns",
     [] { return flow_with([](GradientFlowOptions& o) { o.metric = smaller(); }); }},
    {"negative_iterations", "InvalidArgument: StoppingRules: max_iterations is -1",
     [] { return newton_with([](NewtonOptions& o) { o.stopping.max_iterations = -1; }); }},
    {"nan_tolerance", "InvalidArgument: StoppingRules: relative_decrease is nan",
     [] { return newton_with([](NewtonOptions& o) { o.stopping.relative_decrease = kNan; }); }},
    {"no_plateau_window", "InvalidArgument: StoppingRules: plateau_window is 0",
     [] { return newton_with([](NewtonOptions& o) { o.stopping.plateau_window = 0; }); }},
    {"armijo_above_one", "InvalidArgument: LineSearchOptions: armijo is 1.5",
     [] { return newton_with([](NewtonOptions& o) { o.line_search.armijo = 1.5; }); }},
    {"negative_smallest_step", "InvalidArgument: LineSearchOptions: smallest_step is -1",
     [] { return newton_with([](NewtonOptions& o) { o.line_search.smallest_step = -1; }); }},
    {"shrinking_growth", "InvalidArgument: LineSearchOptions: largest_growth is 0.5",
     [] { return newton_with([](NewtonOptions& o) { o.line_search.largest_growth = 0.5; }); }},
    {"forcing_of_one", "InvalidArgument: NewtonOptions: forcing.largest is 1,",
     [] { return newton_with([](NewtonOptions& o) { o.forcing.largest = 1; }); }},
    {"ceres_negative_scale", "InvalidArgument: CeresOptions: scale must be positive",
     [] { return ceres_with([](CeresOptions& o) { o.scale = -1; }); }},
    {"ceres_negative_tolerance", "InvalidArgument: CeresOptions: ",
     [] { return ceres_with([](CeresOptions& o) { o.function_tolerance = -1; }); }},
    {"step_of_short_y", "InvalidArgument: Stepper::step: y has 2 numbers",
     [] {
       NewtonStepper stepper(good(), {});
       Vec y = ones(2);
       double energy = 0;
       stepper.step(y, energy);
     }},
    {"descend_from_short_y", "InvalidArgument: the start y has 2 numbers",
     [] { return NewtonStepper(good(), {}).descend_from(ones(2), 0, {}); }},
};

}  // namespace solver_calls

class SolverCalls : public Misuse {};
TEST_P(SolverCalls, IsRefused) { expect_refusal(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Table, SolverCalls, testing::ValuesIn(solver_calls::kCalls), name_of);

}  // namespace majorant::misuse

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
