// Wrong calls of derivatives of solutions, of maps and of covariances.
#include <limits>
#include <memory>
#include <optional>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/rest_sensitivity.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/sensitivity.h"
#include "majorant/framework/terms/least_squares.h"
#include "majorant/framework/terms/local_term.h"
#include "majorant/maps/map_extension.h"
#include "majorant/parametrization/solve/map_sensitivity.h"
#include "mesh/test_meshes.h"
#include "misuse/outcome.h"

namespace majorant::misuse {
namespace sensitivity_calls {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Two springs between three nodes on a line with the first node held; their lengths are data.
struct Chain {
  TermId springs;
  Problem problem;
  SolveResult result;
};
Chain chain() {
  const auto term = make_term<2>(
      "springs", (Cells(2, 2) << 0, 1, 1, 2).finished(),
      [](Index e, const auto& z, const auto& l) {
        const auto d = z[1] - z[0] - l[e];
        return d * d;
      },
      Vec(Vec::Ones(2)));
  ProblemBuilder builder(3);
  const TermId id = builder.add(term, 1);
  const Problem problem = builder.add(FixedUnknowns({{0, 0.5}})).build();
  return {id, problem, NewtonMinimizer().minimize(problem, Vec::Zero(2), nullptr)};
}
void with_result(const std::function<void(SolveResult&)>& change) {
  Chain c = chain();
  change(c.result);
  Sensitivity(c.problem, c.result);
}
void with_options(const std::function<void(SensitivityOptions&)>& change) {
  const Chain c = chain();
  SensitivityOptions options;
  change(options);
  Sensitivity(c.problem, c.result, options);
}
Vec forward(const Sensitivity::Change& change) {
  const Chain c = chain();
  return Sensitivity(c.problem, c.result).forward(change);
}
// Makes the derivatives of a problem with one term of two unknowns.
template <class F>
void of_function(F f, const Vec& y) {
  const Problem problem = ProblemBuilder(2).add(make_term<2>("f", Cells{{0, 1}}, f), 1).build();
  SolveResult end;
  end.status = Status::Converged;
  end.y = y;
  Sensitivity(problem, end);
}

Cells faces() { return (Cells(2, 3) << 0, 1, 2, 0, 2, 3).finished(); }
RowMatrix corners() { return (RowMatrix(4, 2) << 0, 0, 1, 0, 1, 1, 0, 1).finished(); }
// Makes the derivatives by the rest positions of a stretched square.
void rest_of(int degree, const RowMatrix& positions, const Cells& cells,
             const std::function<void(const RestSensitivity&, const Sensitivity&)>& call = {}) {
  const auto space = std::make_shared<const BezierTriangleSpace>(faces(), 4, degree);
  ProblemBuilder builder(2 * space->node_count());
  builder.add(symmetric_dirichlet()(space, flat_simplices(corners(), faces())), 1);
  builder.add(FixedPoints({{0, {0, 0}}, {2, {1.2, 1}}}));
  const Problem problem = builder.build();
  const RowMatrix nodes = space->node_positions(corners());
  Vec x = Eigen::Map<const Vec>(nodes.data(), nodes.size());
  x[4] = 1.2;
  const Sensitivity s(problem, NewtonMinimizer().minimize(problem, problem.reduce(x), nullptr));
  const RestSensitivity rest(problem, s, {problem.terms().front()}, positions, cells);
  if (call) call(rest, s);
}

struct Flattened {
  ParametrizationOptions options;
  ParametrizationResult result;
};
Flattened flattened(bool is_pinned) {
  ParametrizationOptions options;
  options.map.degree = 1;
  if (is_pinned) options.map.pins = {{0, {}}, {3, {}}};
  return {options, parametrize(surface(grid(3)), options)};
}
Vec map_forward(const MapSensitivity::Change& change, bool is_pinned = true) {
  const Flattened f = flattened(is_pinned);
  return MapSensitivity(f.result, f.options).forward(change);
}
void map_with(const std::function<void(Flattened&)>& change) {
  Flattened f = flattened(true);
  change(f);
  MapSensitivity(f.result, f.options);
}

using Change = Sensitivity::Change;
using MapChange = MapSensitivity::Change;

const std::vector<Call> kCalls{
    {"result_of_another_size", "InvalidArgument: Sensitivity: result.y has 3 numbers",
     [] { with_result([](SolveResult& r) { r.y = Vec::Zero(3); }); }},
    {"result_not_finite", "InvalidArgument: Sensitivity: result.y",
     [] { with_result([](SolveResult& r) { r.y[0] = kNan; }); }},
    {"result_failed", "Error Unsupported: Sensitivity: there is no solution",
     [] { with_result([](SolveResult& r) { r.status = Status::Failed; }); }},
    {"result_infeasible", "Error Unsupported: Sensitivity: there is no solution",
     [] { with_result([](SolveResult& r) { r.status = Status::Infeasible; }); }},
    {"result_blocked", "Error Unsupported: Sensitivity: a checker holds the result back",
     [] { with_result([](SolveResult& r) { r.blocking = {1}; }); }},
    {"saddle", "Error Unsupported: Sensitivity: the exact Hessian of the solution is indefinite",
     [] {
       of_function([](Index, const auto& z) { return z[0] * z[0] - z[1] * z[1]; }, Vec::Zero(2));
     }},
    {"nothing_holds", "Error Unsupported: Sensitivity: the exact Hessian of the solution is",
     [] {
       of_function([](Index, const auto& z) { return (z[0] - z[1]) * (z[0] - z[1]); },
                   Vec::Zero(2));
     }},
    {"outside_the_domain", "Error Unsupported: Sensitivity: the energy or its derivatives are not",
     [] {
       of_function(
           [](Index, const auto& z) {
             using std::log;
             return z[1] * z[1] - log(z[0]);
           },
           Vec{{-1, 0}});
     }},
    {"polishing_steps_negative", "InvalidArgument: SensitivityOptions: polishing_steps is negative",
     [] { with_options([](SensitivityOptions& o) { o.polishing_steps = -1; }); }},
    {"null_space_of_another_size", "InvalidArgument: SensitivityOptions: null_space has 3",
     [] {
       with_options([](SensitivityOptions& o) {
         o.null_space = [](const Problem&, VecIn) { return Eigen::MatrixXd::Ones(3, 1).eval(); };
       });
     }},
    {"gauge_without_null_space", "InvalidArgument: SensitivityOptions: the gauge has 1 rows",
     [] {
       with_options([](SensitivityOptions& o) {
         o.gauge = [](const Problem&, VecIn) { return Eigen::MatrixXd::Ones(1, 3).eval(); };
       });
     }},
    {"solver_of_nothing", "InvalidArgument: SensitivityOptions",
     [] { with_options([](SensitivityOptions& o) { o.linear_solver = {}; }); }},
    {"right_hand_sides_of_other_rows",
     "InvalidArgument: Sensitivity: right_hand_sides has 2 numbers",
     [] { forward(Change{.right_hand_sides = Vec::Ones(2)}); }},
    {"right_hand_side_nan", "InvalidArgument: Sensitivity: right_hand_sides",
     [] { forward(Change{.right_hand_sides = Vec::Constant(1, kNan)}); }},
    {"weight_of_no_term", "InvalidArgument: Problem::term: no term",
     [] {
       forward(Change{.weights = {{TermId(3), 1.0}}});
     }},
    {"weight_infinite", "InvalidArgument: Sensitivity: weights",
     [] {
       forward(Change{.weights = {{TermId(0), 1 / 0.0}}});
     }},
    {"element_weights_short", "InvalidArgument: Sensitivity: element_weights has 1 numbers",
     [] {
       forward(Change{.element_weights = {{TermId(0), Vec::Ones(1)}}});
     }},
    {"parameters_short", "InvalidArgument: Sensitivity: term 'springs' takes 2 parameters, not 3",
     [] {
       forward(Change{.parameters = {{TermId(0), Vec::Ones(3)}}});
     }},
    {"parameters_nan", "InvalidArgument: Sensitivity: parameters",
     [] {
       forward(Change{.parameters = {{TermId(0), Vec::Constant(2, kNan)}}});
     }},
    {"gradient_of_reduced_unknowns", "InvalidArgument: Sensitivity: gradient has 2 numbers",
     [] { forward(Change{.gradient = Vec::Ones(2)}); }},
    {"slope_of_reduced_unknowns", "InvalidArgument: Sensitivity::adjoint: the slope has 2 numbers",
     [] {
       const Chain c = chain();
       Sensitivity(c.problem, c.result).adjoint(Vec(Vec::Ones(2)));
     }},
    {"slope_nan", "InvalidArgument: Sensitivity::adjoint: the slope",
     [] {
       const Chain c = chain();
       Sensitivity(c.problem, c.result).adjoint(Vec(Vec::Constant(3, kNan)));
     }},
    {"bias_of_no_term", "InvalidArgument: Problem::state: no term",
     [] {
       const Chain c = chain();
       Sensitivity(c.problem, c.result).bias({TermId(7)});
     }},
    {"covariance_of_no_squares",
     "Error Unsupported: covariance: term 'springs' is no sum of squares",
     [] {
       const Chain c = chain();
       covariance(c.problem, c.result, {1});
     }},
    {"rest_of_a_term_without", "InvalidArgument: RestSensitivity: term 'springs' is no density",
     [] {
       const Chain c = chain();
       const Sensitivity s(c.problem, c.result);
       RestSensitivity(c.problem, s, {c.springs}, corners(), faces());
     }},
    {"rest_of_degree_two",
     "Error Unsupported: RestSensitivity: term 'symmetric-dirichlet' has 6 nodes",
     [] { rest_of(2, corners(), faces()); }},
    {"rest_of_other_positions", "InvalidArgument: RestSensitivity: element 0 of term",
     [] { rest_of(1, 2 * corners(), faces()); }},
    {"rest_of_fewer_cells", "InvalidArgument: RestSensitivity: 1 cells of 3 corners for 2 elements",
     [] { rest_of(1, corners(), faces().topRows(1)); }},
    {"rest_change_of_another_size", "InvalidArgument: RestSensitivity: a change of 4 by 3 numbers",
     [] {
       rest_of(1, corners(), faces(), [](const RestSensitivity& rest, const Sensitivity&) {
         rest.forward(RowMatrix::Zero(4, 3));
       });
     }},
    {"map_of_other_degree", "InvalidArgument: MapSensitivity: options of degree 2, the map has 1",
     [] { map_with([](Flattened& f) { f.options.map.degree = 2; }); }},
    {"map_of_other_handles", "InvalidArgument: MapSensitivity: options of 1 handles",
     [] { map_with([](Flattened& f) {
            f.options.map.handles = {{5, {}}};
          }); }},
    {"map_with_additions", "Error Unsupported: MapSensitivity: terms or constraints were added",
     [] { map_with([](Flattened& f) { f.options.extend = [](MapExtension&) {}; }); }},
    {"map_pins_short", "InvalidArgument: MapSensitivity: pins has 1 numbers",
     [] {
       map_forward(MapChange{.pins = {{1, 0}}});
     }},
    {"map_pins_nan", "InvalidArgument: MapSensitivity: pins",
     [] {
       map_forward(MapChange{.pins = {{1, 0}, {kNan, 0}}});
     }},
    {"map_weights_long", "InvalidArgument: MapSensitivity: weights has 2 numbers",
     [] { map_forward(MapChange{.weights = Vec::Ones(2)}); }},
    {"map_without_handles", "InvalidArgument: MapSensitivity: the map has no handles",
     [] { map_forward(MapChange{.handle_weight = 1}); }},
    {"map_gauge_of_pinned",
     "InvalidArgument: MapSensitivity: a gauge is for maps that nothing holds",
     [] {
       const Flattened f = flattened(true);
       MapSensitivity(f.result, f.options, {.gauge = {{0, 1}}});
     }},
    {"map_gauge_outside", "InvalidArgument: MapSensitivity: the gauge has vertex 99",
     [] {
       const Flattened f = flattened(false);
       MapSensitivity(f.result, f.options, {.gauge = {{0, 99}}});
     }},
    {"map_gauge_twice", "InvalidArgument: MapSensitivity: the gauge has the same vertex twice",
     [] {
       const Flattened f = flattened(false);
       MapSensitivity(f.result, f.options, {.gauge = {{4, 4}}});
     }},
};

}  // namespace sensitivity_calls

class SensitivityCalls : public Misuse {};
TEST_P(SensitivityCalls, IsRefused) { expect_refusal(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Table, SensitivityCalls, testing::ValuesIn(sensitivity_calls::kCalls),
                         name_of);

}  // namespace majorant::misuse

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
