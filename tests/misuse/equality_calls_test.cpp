// Wrong calls of equalities, and results for equalities that cannot be met.
#include <limits>
#include <memory>
#include <stdexcept>

#include "majorant/framework/barrier_minimizer.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/terms/equality.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/framework/terms/local_term.h"
#include "misuse/outcome.h"

namespace majorant::misuse {
namespace equality_calls {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Term = std::shared_ptr<const EnergyTerm>;

// |z - (2, 1)|^2.
Term bowl() {
  return make_term<2>("bowl", Cells{{0, 1}}, [](Index, const auto& z) {
    const auto a = z[0] - 2.0, b = z[1] - 1.0;
    return a * a + b * b;
  });
}
template <class G>
Term held(G g) {
  return equality<2>("held", Cells{{0, 1}}, [g](Index, const auto& z) { return g(z); });
}
Term circle(double radius = 1) {
  return held([radius](const auto& z) { return z[0] * z[0] + z[1] * z[1] - radius * radius; });
}

BarrierResult solve(const Term& term, double weight = 1, Vec y0 = Vec{{1, 0.5}},
                    const BarrierOptions& options = {}) {
  ProblemBuilder builder(2);
  builder.add(bowl(), 1).add(term, weight);
  return BarrierMinimizer({}, options).run(builder.build(), std::move(y0));
}
BarrierResult solve_both(const Term& a, const Term& b) {
  ProblemBuilder builder(2);
  builder.add(bowl(), 1).add(a, 1).add(b, 1);
  return BarrierMinimizer({}).run(builder.build(), Vec{{1, 0.5}});
}
BarrierResult solve_with(const BarrierOptions& options) {
  return solve(circle(), 1, Vec{{1, 0.5}}, options);
}
BarrierResult with_weights_of_elements() {
  ProblemBuilder builder(2);
  builder.add(bowl(), 1);
  const TermId id = builder.add(circle(), 1);
  const Problem problem = builder.build().with({{id, {.element_weight = Vec::Constant(1, 2)}}});
  return BarrierMinimizer({}).run(problem, Vec{{1, 0.5}});
}
BarrierResult as_barrier() {
  ProblemBuilder builder(2);
  builder.add(bowl(), 1);
  const TermId id = builder.add(circle(), 1);
  return BarrierMinimizer({id}).run(builder.build(), Vec{{1, 0.5}});
}
// Returns the result for an inequality x > 2 that the circle does not reach.
BarrierResult with_a_bound_out_of_reach() {
  ProblemBuilder builder(2);
  const auto bound = Bounds(Vec{{2, -kInfinity}}, Vec{{kInfinity, kInfinity}}).checker();
  builder.add(bowl(), 1).add(circle(), 1).add(bound);
  const HeldBound held_bound{builder.add(bound->barrier(), 1), bound};
  return BarrierMinimizer::of_bounds({held_bound}).run(builder.build(), Vec{{1, 0.5}});
}
SolveResult by_newton() {
  ProblemBuilder builder(2);
  builder.add(bowl(), 1).add(circle(), 1);
  return NewtonMinimizer().minimize(builder.build(), Vec{{1, 0.5}}, {});
}
BarrierOptions tolerance_of(double tolerance) {
  BarrierOptions options;
  options.equality_tolerance = tolerance;
  return options;
}
BarrierOptions few_iterations(int count) {
  BarrierOptions options;
  options.newton.stopping.max_iterations = count;
  return options;
}

const Call kCalls[] = {
    {"weight", "InvalidArgument: BarrierMinimizer: the equality 'held' has a weight",
     [] { return solve(circle(), 2); }},
    {"no_weight", "InvalidArgument: BarrierMinimizer: the equality 'held' has a weight",
     [] { return solve(circle(), 0); }},
    {"weight_nan", "InvalidArgument: ", [] { return solve(circle(), kNan); }},
    {"weights_of_elements", "InvalidArgument: BarrierMinimizer: the equality 'held' has a weight",
     [] { return with_weights_of_elements(); }},
    {"as_barrier", "InvalidArgument: BarrierMinimizer: 'held' is an equality, no barrier",
     [] { return as_barrier(); }},
    {"columns", "InvalidArgument: term 'wide': its lambda takes 2",
     [] {
       return equality<2>("wide", Cells{{0, 1, 2}}, [](Index, const auto& z) { return z[0]; });
     }},
    {"negative_node", "InvalidArgument: term 'below': node 1 of element 0",
     [] {
       return equality<2>("below", Cells{{0, -1}}, [](Index, const auto& z) { return z[0]; });
     }},
    {"no_such_node", "InvalidArgument: ",
     [] {
       return solve(
           equality<2>("beyond", Cells{{0, 7}}, [](Index, const auto& z) { return z[0] - z[1]; }));
     }},
    {"null_term", "InvalidArgument: ", [] { return solve(nullptr); }},
    {"outside_of_its_domain", "infeasible: ",
     [] {
       return solve(held([](const auto& z) {
         using std::log;
         return log(z[0] - 5.0);
       }));
     }},
    {"start_of_another_size", "InvalidArgument: the start y",
     [] { return solve(circle(), 1, Vec::Zero(3)); }},
    {"start_nan", "InvalidArgument: the start y",
     [] {
       return solve(circle(), 1, Vec{{0, kNan}});
     }},
    {"tolerance_zero",
     "InvalidArgument: BarrierOptions: ", [] { return solve_with(tolerance_of(0)); }},
    {"tolerance_negative",
     "InvalidArgument: BarrierOptions: ", [] { return solve_with(tolerance_of(-1e-10)); }},
    {"tolerance_nan",
     "InvalidArgument: BarrierOptions: ", [] { return solve_with(tolerance_of(kNan)); }},
    {"never_met",
     "infeasible: no point meets the equalities, or none nearby: where their violation is least, "
     "'held' at element 0, which begins with unknown 0 is 1, not 0",
     [] { return solve(held([](const auto& z) { return z[0] * z[0] + z[1] * z[1] + 1.0; })); }},
    {"constant", "infeasible: no point meets the equalities",
     [] { return solve(held([](const auto& z) { return 0.0 * z[0] + 3.0; })); }},
    {"contradiction", "infeasible: no point meets the equalities",
     [] { return solve_both(circle(1), circle(2)); }},
    {"twice", "converged: ", [] { return solve_both(circle(), circle()); }},
    {"no_derivative_where_met",
     "stalled: the equalities can be met, but their multipliers grow without limit",
     [] { return solve(held([](const auto& z) { return z[0] * z[0]; })); }},
    {"bound_out_of_reach", "infeasible: no point meets the equalities",
     [] { return with_a_bound_out_of_reach(); }},
    {"unbounded", "max_iterations: ",
     [] {
       ProblemBuilder builder(2);
       builder.add(linear_term("down", Vec{{0, -1}}), 1);
       builder.add(held([](const auto& z) { return z[0] * z[0] * z[0] + z[0] - 2.0; }), 1);
       return BarrierMinimizer({}).run(builder.build(), Vec{{1, 0.5}});
     }},
    {"throws", "foreign exception: of the lambda",
     [] {
       return solve(held([](const auto& z) {
         if (z[0] < 10.0) throw std::runtime_error("of the lambda");
         return z[0];
       }));
     }},
    {"no_iterations", "max_iterations: iteration limit",
     [] { return solve_with(few_iterations(2)); }},
    {"no_elements", "converged: ",
     [] {
       return solve(equality<2>("none", Cells(0, 2), [](Index, const auto& z) { return z[0]; }));
     }},
    {"by_newton", "converged: ", [] { return by_newton(); }},
};

}  // namespace equality_calls

class EqualityCalls : public Misuse {};
TEST_P(EqualityCalls, EndInOneClearOutcome) { expect_refusal(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Table, EqualityCalls, testing::ValuesIn(equality_calls::kCalls), name_of);

}  // namespace majorant::misuse

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
