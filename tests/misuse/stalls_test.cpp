// Messages of minimizers that end without a minimum: they name only the true reason.
#include <cmath>
#include <memory>
#include <optional>

#include "framework/scalar_terms.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/spectral.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "misuse/outcome.h"

namespace majorant::misuse {
namespace stalls {

using test::Box;
using test::Chain;
using test::Scalar;

constexpr Index kCount = 5;

// Returns the sum of phi(x_i), with the feasible set of `checker` if there is one.
Problem problem(const Scalar& phi, std::shared_ptr<const FeasibilityChecker> checker = nullptr) {
  ProblemBuilder builder(kCount);
  builder.add(std::make_shared<const Chain>(kCount, phi), 1.0);
  if (checker) builder.add(std::move(checker));
  return builder.build();
}
std::shared_ptr<const Box> box(double limit, bool paths = true) {
  return std::make_shared<const Box>(limit, paths);
}

SolveResult newton(const Problem& p, double start = 1) {
  return NewtonMinimizer().minimize(p, Vec::Constant(p.size(), start), {});
}
SolveResult lbfgs(const Problem& p, std::optional<Problem> metric = {}) {
  LbfgsOptions options;
  options.metric = std::move(metric);
  return LbfgsMinimizer(options).minimize(p, Vec::Ones(p.size()), {});
}
SolveResult flow(const Problem& p, std::optional<Problem> metric = {}) {
  GradientFlowOptions options;
  options.metric = std::move(metric);
  return GradientFlowMinimizer(options).minimize(p, Vec::Ones(p.size()), {});
}

// Returns a parabola whose second derivative is reported wrongly.
Scalar with_curvature(double curvature) {
  return {[](double t) { return 1 + t * t; }, [](double t) { return 2 * t; },
          [=](double) { return curvature; }};
}
Scalar constant() {
  return {[](double) { return 7.0; }, [](double) { return 0.0; }, [](double) { return 0.0; }};
}
Scalar linear() {
  return {[](double t) { return t; }, [](double) { return 1.0; }, [](double) { return 0.0; }};
}
// Returns |t| + t^2 / 10.
Scalar kink() {
  return {[](double t) { return std::abs(t) + 0.1 * t * t; },
          [](double t) { return (t < 0 ? -1 : 1) + 0.2 * t; }, [](double) { return 0.2; }};
}

// Minimizes f of two unknowns from (3, 2).
template <class F>
SolveResult newton_of_two(const F& f) {
  ProblemBuilder builder(2);
  builder.add(make_term<2>("two", Cells(Eigen::RowVector2i(0, 1)), f), 1.0);
  return NewtonMinimizer().minimize(builder.build(), Vec{{3.0, 2.0}}, {});
}

ParametrizationResult map_of_a_constant() {
  RowMatrix v(5, 3);
  v << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 0.5;
  Cells f(4, 3);
  f << 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4;
  ParametrizationOptions options;
  options.map.degree = 1;
  const auto energy = spectral("constant", [](auto S, auto s) { return 0.0 * (S + s) + 3.0; });
  options.map.energy = {{energy_factory(energy), 1.0}};
  return parametrize(std::make_shared<const SurfaceMesh>(SurfaceMesh::from_arrays(v, f)), options);
}

constexpr const char* kNotAsPromised =
    "stalled: the energy does not fall as its derivatives promise: it is not smooth there, they "
    "are wrong, or its Hessian is nearly singular";
constexpr const char* kChecker = "stalled: held at the limit of the feasible set";
constexpr const char* kFlat =
    "failed: no direction: the energy has no curvature here, its Hessian is 0";

const std::vector<Call> kCalls{
    {"kink_of_two", kNotAsPromised,
     [] {
       return newton_of_two([](Index, const auto& z) {
         using std::abs;
         return abs(z[0]) + abs(z[1] - z[0]) + 0.1 * z[0] * z[0] + 0.1 * z[1] * z[1];
       });
     }},
    {"kink_far_from_any_bound", kNotAsPromised, [] { return newton(problem(kink(), box(9)), 3); }},
    {"wrong_slopes", kNotAsPromised,
     [] {
       const Scalar phi{[](double t) { return t * t + 1; }, [](double t) { return -2 * t; },
                        [](double) { return 2.0; }};
       return newton(problem(phi));
     }},
    {"hessian_nearly_singular", kNotAsPromised,
     [] { return newton(problem(with_curvature(1e-30))); }},
    {"wall_without_a_barrier", "stalled: held at the limit of the energy's domain",
     [] {
       const Scalar phi{[](double t) { return t < 2 ? -t : test::kInfinity; },
                        [](double) { return -1.0; }, [](double) { return 0.1; }};
       return newton(problem(phi));
     }},
    {"checker_at_the_start", kChecker,
     [] { return newton(problem(test::parabola(0, 0), std::make_shared<const test::Frozen>())); }},
    {"checker_on_the_way", kChecker, [] { return newton(problem(test::parabola(5, 1), box(2))); }},
    {"checker_of_end_points", kChecker,
     [] { return newton(problem(test::parabola(5, 1), box(2, false))); }},
    {"constant", kFlat, [] { return newton(problem(constant())); }},
    {"constant_lbfgs", kFlat, [] { return lbfgs(problem(constant())); }},
    {"constant_flow", kFlat, [] { return flow(problem(constant())); }},
    {"linear_in_a_box", kFlat, [] { return newton(problem(linear(), box(2))); }},
    {"linear_term_in_a_box", kFlat,
     [] {
       ProblemBuilder builder(kCount);
       builder.add(linear_term("weight", Vec::Ones(kCount)), 1.0);
       builder.add(box(2));
       return newton(builder.build());
     }},
    {"no_elements", kFlat,
     [] {
       ProblemBuilder builder(2);
       const auto f = [](Index, const auto& z) { return z[0] * z[1]; };
       builder.add(make_term<2>("none", Cells(0, 2), f), 1.0);
       return newton(builder.build());
     }},
    {"map_of_a_constant", "stalled: no direction: the energy has no curvature here",
     [] { return map_of_a_constant(); }},
    {"saddle_of_two", "failed: unbounded below",
     [] { return newton_of_two([](Index, const auto& z) { return -z[0] * z[0] - z[1] * z[1]; }); }},
    {"hilltop", "converged",  // far away, where the energy vanishes
     [] {
       ProblemBuilder builder(1);
       const auto f = [](Index, const auto& z) {
         using std::exp;
         return exp(-z[0] * z[0]);
       };
       builder.add(make_term<1>("hill", Cells::Zero(1, 1), f), 1.0);
       return newton(builder.build(), 0.1);
     }},
    {"metric_of_a_constant", "failed: no direction: the metric has no curvature here",
     [] { return lbfgs(problem(test::parabola(0, 1)), problem(constant())); }},
    {"flow_in_the_metric_of_a_constant", "failed: no direction: the metric has no curvature here",
     [] { return flow(problem(test::parabola(0, 1)), problem(constant())); }},
};

}  // namespace stalls

class Stalls : public Misuse {};
TEST_P(Stalls, AreReportedAsStalls) { expect_refusal(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Table, Stalls, testing::ValuesIn(stalls::kCalls), name_of);

}  // namespace majorant::misuse

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
