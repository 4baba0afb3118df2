// Wrong calls of element spaces, rules, rest shapes, energies and constraints.
#include <limits>
#include <memory>

#include "majorant/constraints/constraints.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/problem.h"
#include "misuse/outcome.h"

namespace majorant::misuse {
namespace element_calls {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Cells faces() { return (Cells(2, 3) << 0, 1, 2, 0, 2, 3).finished(); }
RowMatrix positions() {
  RowMatrix v(4, 2);
  v << 0, 0, 1, 0, 1, 1, 0, 1;
  return v;
}
using Space = BezierTriangleSpace;
std::shared_ptr<const Space> space(int degree = 1) {
  return std::make_shared<const Space>(faces(), 4, degree);
}
RestShapes rest() { return flat_simplices(positions(), faces()); }
Vec identity() { return Eigen::Map<const Vec>(positions().data(), 8); }

std::shared_ptr<const DensityTerm> energy(const RestShapes& shapes,
                                          const std::vector<Quadrature>& rules) {
  return symmetric_dirichlet()(space(), shapes, rules);
}
void energy_with(const std::function<void(RestShapes&)>& change) {
  RestShapes shapes = rest();
  change(shapes);
  energy(shapes, {radon_rule()});
}
double value_with(const Quadrature& rule) {
  ProblemBuilder builder(8);
  builder.add(energy(rest(), {rule}), 1.0);
  return Evaluator(builder.build()).value(identity());
}
double value_with(const std::function<void(Quadrature&)>& change) {
  Quadrature rule = radon_rule();
  change(rule);
  return value_with(rule);
}
LocalInjectivity injectivity() { return LocalInjectivity(space(), Vec::Ones(2)); }
void add(const Constraint& constraint) {
  ProblemBuilder builder(8);
  builder.add(energy(rest(), {radon_rule()}), 1.0).add(constraint).build();
}
// Returns the problem of a tetrahedron in space.
ProblemBuilder solid() {
  const Cells cell{{0, 1, 2, 3}};
  RowMatrix corners = RowMatrix::Zero(4, 3);
  corners.bottomRows(3).setIdentity();
  const auto volume = density<3, 3>("volume", [](const auto& J) { return J.squaredNorm(); });
  ProblemBuilder builder(12);
  builder.add(make_energy(std::make_shared<const BezierTetrahedronSpace>(cell, 4, 1),
                          flat_simplices(corners, cell), volume),
              1.0);
  return builder;
}

const std::vector<Call> kCalls{
    {"degree_zero", "InvalidArgument: BezierTriangleSpace: degree must be 1..8, is 0",
     [] { space(0); }},
    {"degree_nine", "InvalidArgument: BezierTriangleSpace: degree must be 1..8, is 9",
     [] { space(9); }},
    {"face_of_missing_vertex",
     "InvalidArgument: BezierTriangleSpace: cell 1 has vertex 3, there are 3 vertices",
     [] { Space(faces(), 3, 1); }},
    {"negative_vertices", "InvalidArgument: BezierTriangleSpace: the number of vertices is -4",
     [] { Space(faces(), -4, 1); }},
    {"faces_of_quads", "InvalidArgument: BezierTriangleSpace: cells have 4 columns, expected 3",
     [] { Space(Cells::Zero(1, 4), 4, 1); }},
    {"vertex_twice", "InvalidArgument: BezierTriangleSpace: cell 0 has vertex 1 twice",
     [] { Space((Cells(1, 3) << 1, 1, 2).finished(), 4, 1); }},
    {"edge_of_three", "InvalidArgument: BezierTriangleSpace: facet (0, 1) has 3 cells",
     [] { Space((Cells(3, 3) << 0, 1, 2, 1, 0, 3, 0, 1, 4).finished(), 5, 2); }},
    {"numbering_of_few_nodes", "InvalidArgument: BezierTriangleSpace: cells of 3 nodes, 6",
     [] {
       Space(NodeNumbering{faces(), 4, {}}, 2);
     }},
    {"numbering_outside", "InvalidArgument: BezierTriangleSpace: cell 0 has node 2, there are 2",
     [] {
       Space(NodeNumbering{faces(), 2, {}}, 1);
     }},
    {"quads_of_triangles", "InvalidArgument: BezierQuadSpace: cells have 3 columns, expected 4",
     [] { BezierQuadSpace(faces(), 4, 1); }},
    {"tetrahedra_degree", "InvalidArgument: BezierTetrahedronSpace: degree must be",
     [] { BezierTetrahedronSpace((Cells(1, 4) << 0, 1, 2, 3).finished(), 4, 0); }},
    {"lattice_of_nothing", "InvalidArgument: number_lattice: n is 0",
     [] { number_lattice(faces(), 4, 0); }},
    {"positions_of_few_vertices",
     "InvalidArgument: BezierTriangleSpace: 3 positions for 4 vertices",
     [] { space()->node_positions(RowMatrix::Zero(3, 2)); }},
    {"certify_missing_element", "InvalidArgument: element 2 does not exist, there are 2",
     [] { space()->certify(2, identity(), 3); }},
    {"certify_short_map", "InvalidArgument: the map x has 6 numbers, 8 are needed",
     [] { space()->certify(0, identity().head(6), 3); }},
    {"step_of_short_direction", "InvalidArgument: the direction d has 2 numbers, 8 are needed",
     [] { space()->largest_step(0, identity(), Vec::Zero(2), 1, 3); }},
    {"elevate_short", "InvalidArgument: BezierTriangleSpace::elevate: x has 4 numbers",
     [] { space()->elevate(Vec::Zero(4), *space(2)); }},
    {"elevate_twice", "InvalidArgument: BezierTriangleSpace::elevate: a space of degree 3",
     [] { space()->elevate(identity(), *space(3)); }},
    {"nodes_of_missing_edge", "InvalidArgument: edge_nodes: half-edge 6 does not exist",
     [] { edge_nodes(*space(), 6); }},
    {"basis_at_cartesian_point", "InvalidArgument: BernsteinBasis::values: the point has 2 numbers",
     [] { space()->basis().values(Vec::Zero(2)); }},
    {"rule_of_no_points", "InvalidArgument: gauss_rule: m is 0", [] { gauss_rule(0); }},
    {"exact_rule_negative", "InvalidArgument: exact_rule: the degree is -1",
     [] { exact_rule({3}, -1); }},
    {"exact_rule_too_high", "InvalidArgument: exact_rule: degree 9 of a tetrahedron, 8 is the high",
     [] { exact_rule({4}, 9); }},
    {"exact_rule_of_nothing", "InvalidArgument: exact_rule: the cell has no factors",
     [] { exact_rule({}, 1); }},
    {"exact_rule_of_pentagons", "InvalidArgument: exact_rule: a factor with 5 corners",
     [] { exact_rule({5}, 1); }},
    {"default_rule_of_nothing", "InvalidArgument: EnergyFactory: the space is null",
     [] { symmetric_dirichlet()(nullptr, rest()); }},
    {"lattice_rule_negative", "InvalidArgument: lattice_rule: m is -1", [] { lattice_rule(-1); }},
    {"composite_of_no_pieces", "...m is 0", [] { composite_rule(radon_rule(), 0); }},
    {"rest_index", "InvalidArgument: flat_simplices: cell 1 has vertex 3, there are 3",
     [] { flat_simplices(positions().topRows(3), faces()); }},
    {"rest_negative_index", "InvalidArgument: flat_simplices: cell 0 has vertex -1",
     [] { flat_simplices(positions(), (Cells(1, 3) << -1, 1, 2).finished()); }},
    {"rest_nan", "InvalidArgument: row 1 of flat_simplices: positions is not finite",
     [] {
       RowMatrix v = positions();
       v(1, 1) = kNan;
       flat_simplices(v, faces());
     }},
    {"rest_of_lines_in_points", "InvalidArgument: flat_simplices: positions of 2 coordinates",
     [] { flat_simplices(positions(), (Cells(1, 4) << 0, 1, 2, 3).finished()); }},
    {"curved_rest_few", "InvalidArgument: curved_shapes: 3 positions of 2 coordinates",
     [] { curved_shapes(*space(), positions().topRows(3), radon_rule()); }},
    {"curved_rest_other_rule", "InvalidArgument: BezierTriangleSpace: quadrature of the cell {4}",
     [] { curved_shapes(*space(), positions(), walkington_rule()); }},
    {"energy_null_space", "InvalidArgument: DensityTerm: the space is null",
     [] { symmetric_dirichlet()(nullptr, rest(), {radon_rule()}); }},
    {"energy_no_rule", "InvalidArgument: energy 'symmetric-dirichlet': no quadrature rule",
     [] { energy(rest(), {}); }},
    {"energy_few_shapes", "...rest shapes of 1 elements do not fit the space, which has 2",
     [] { energy_with([](RestShapes& r) { r.measure = Vec::Ones(1); }); }},
    {"energy_degenerate_shape", "...the rest shape of element 1 is degenerate (measure 0)",
     [] {
       RowMatrix v = positions();
       v.row(3) << 0.5, 0.5;
       energy(flat_simplices(v, faces()), {radon_rule()});
     }},
    {"energy_turned_shape", "...the rest shape of element 0 is degenerate (measure -0.5)",
     [] { energy_with([](RestShapes& r) { r.measure[0] = -0.5; }); }},
    {"energy_nan_shape", "...the rest shape of element 1 is degenerate",
     [] { energy_with([](RestShapes& r) { r.inverse(1, 2) = kNan; }); }},
    {"energy_of_volumes", "...the density is for elements of 3 dimensions, the rest shapes have 2",
     [] {
       make_energy(space(), rest(),
                   density<3, 3>("volume", [](const auto& J) { return J.squaredNorm(); }),
                   {radon_rule()});
     }},
    {"rule_of_tetrahedra", "InvalidArgument: BezierTriangleSpace: quadrature of the cell {4}",
     [] { return value_with(walkington_rule()), 0; }},
    {"rule_of_squares", "InvalidArgument: BezierTriangleSpace: quadrature of the cell {2, 2}",
     [] { return value_with(tensor_gauss_rule(2)), 0; }},
    {"rule_of_few_weights", "InvalidArgument: BezierTriangleSpace: quadrature with 3 weights",
     [] { return value_with([](Quadrature& q) { q.weights = Vec::Constant(3, 1 / 3.0); }), 0; }},
    {"rule_of_two_columns", "InvalidArgument: BezierTriangleSpace: quadrature with 7 weights and 7",
     [] {
       return value_with([](Quadrature& q) { q.points = RowMatrix(q.points.leftCols(2)); }), 0;
     }},
    {"rule_of_area_weights",
     "InvalidArgument: BezierTriangleSpace: quadrature whose weights add to",
     [] { return value_with([](Quadrature& q) { q.weights *= 0.5; }), 0; }},
    {"rule_outside", "InvalidArgument: BezierTriangleSpace: quadrature whose point 0 is outside",
     [] { return value_with([](Quadrature& q) { q.points.row(0) << 2, -1, 0; }), 0; }},
    {"no_factory", "InvalidArgument: EnergyFactory: make is null",
     [] { EnergyFactory(DensityTraits{}, nullptr); }},
    {"density_nan_everywhere",
     "infeasible: the start lies outside the energy's domain: value is infinite, or was NaN, in "
     "all "
     "2 elements of term 'lost'",
     [] {
       ProblemBuilder builder(8);
       builder.add(
           make_energy(
               space(), rest(),
               density<2, 2>("lost", [](const auto& J) { return log(-1.0 - J.squaredNorm()); }),
               {radon_rule()}),
           1.0);
       return NewtonMinimizer().minimize(builder.build(), identity(), {});
     }},
    {"injectivity_null", "InvalidArgument: LocalInjectivity: the space is null",
     [] { LocalInjectivity(nullptr, Vec::Ones(2)); }},
    {"injectivity_few_dets",
     "InvalidArgument: LocalInjectivity: 1 rest determinants for 2 elements",
     [] { LocalInjectivity(space(), Vec::Ones(1)); }},
    {"injectivity_nan_det",
     "InvalidArgument: LocalInjectivity: the rest determinant of element 1 is nan, finite and "
     "positive is needed",
     [] {
       LocalInjectivity(space(), Vec{{1, kNan}});
     }},
    {"injectivity_negative_det",
     "InvalidArgument: LocalInjectivity: the rest determinant of element 0 is -1,",
     [] {
       LocalInjectivity(space(), Vec{{-1, 1}});
     }},
    {"injectivity_zero_det", "...the rest determinant of element 0 is 0,",
     [] {
       LocalInjectivity(space(), Vec{{0, 1}});
     }},
    {"spectral_not_symmetric",
     "InvalidArgument: energy 'twisted': its formula is 2.75 at (1.25, 0.75) and 3.25 at (0.75, "
     "1.25)",
     [] { energy_factory(spectral("twisted", [](auto S, auto s) { return S + 2.0 * s; })); }},
    {"spectral_not_symmetric_with_data", "InvalidArgument: energy 'twisted': its formula is",
     [] {
       make_energy(space(), rest(),
                   spectral(
                       "twisted", [](auto S, auto s, double k) { return S + k * s; },
                       Vec(Vec::Constant(2, 3))));
     }},
    {"spectral_infinite_in_one_order", "InvalidArgument: energy 'one': its formula is 0.693",
     [] {
       energy_factory(spectral("one", [](auto S, auto s) {
         using std::log;
         return -log(S - s);
       }));
     }},
    {"spectral_symmetric", "accepted",
     [] { energy_factory(spectral("fine", [](auto S, auto s) { return S * S + s * s; })); }},
    {"injectivity_negative_depth", "InvalidArgument: LocalInjectivity: the depth is -1",
     [] { LocalInjectivity(space(), Vec::Ones(2), -1); }},
    {"injectivity_short_x", "InvalidArgument: LocalInjectivity: x has 3 numbers, 8 are needed",
     [] { injectivity().check(Vec::Zero(3)); }},
    {"injectivity_short_direction", "InvalidArgument: LocalInjectivity::max_step: d has 1 numbers",
     [] { injectivity().max_step(identity(), Vec::Zero(1), 1); }},
    {"angle_sums_null", "InvalidArgument: AngleSums: the space is null",
     [] { AngleSums(nullptr, AngleSums::Vertices::Interior); }},
    {"angle_sums_short", "InvalidArgument: vertex_angle_sums: x has 2 numbers",
     [] { vertex_angle_sums(*space(), Vec::Zero(2)); }},
    {"fixed_node_missing",
     "InvalidArgument: constraint row 'u of node 7': unknown 14 does not exist",
     [] {
       add(FixedPoints({{7, {0, 0}}}));
     }},
    {"fixed_in_the_plane_of_space",
     "InvalidArgument: FixedPoints of the plane, with 2 unknowns each: the nodes of term 'volume' "
     "have 3; FixedPoints::in_space() holds points of space",
     [] {
       solid().add(FixedPoints({{1, {0, 0}}})).build();
     }},
    {"fixed_in_the_space_of_plane",
     "InvalidArgument: FixedPoints of space, with 3 unknowns each: the nodes of term "
     "'symmetric-dirichlet' have 2; FixedPoints() holds points of the plane",
     [] {
       add(FixedPoints::in_space({{0, {0, 0, 0}}}));
     }},
    {"alignment_in_space",
     "InvalidArgument: AxisAlignment, with 2 unknowns each: the nodes of term",
     [] {
       solid().add(AxisAlignment(space(), {{0, 0}})).build();
     }},
    {"fixed_in_space", "accepted",
     [] {
       solid().add(FixedPoints::in_space({{1, {1, 0, 0}}})).build();
     }},
    {"fixed_at_of_lines", "InvalidArgument: FixedPoints::at: 1 numbers per node, 2 or 3 are",
     [] { FixedPoints::at({0}, identity(), 1); }},
    {"fixed_node_negative", "InvalidArgument: FixedPoints: a node is -1",
     [] {
       add(FixedPoints({{-1, {0, 0}}}));
     }},
    {"fixed_at_nan", "InvalidArgument: constraint row 'v of node 0': its right-hand side is nan",
     [] {
       add(FixedPoints({{0, {0, kNan}}}));
     }},
    {"fixed_at_missing_node", "InvalidArgument: FixedPoints::at: node 4 does not exist",
     [] { FixedPoints::at({4}, identity()); }},
    {"fixed_unknown_negative", "InvalidArgument: FixedUnknowns: an unknown is -3",
     [] {
       add(FixedUnknowns({{-3, 0}}));
     }},
    {"fixed_twice_apart", "Error Unsupported: constraints contradict each other: row 'u of node 0'",
     [] {
       add(FixedPoints({{0, {0, 0}}, {0, {1, 0}}}));
     }},
    {"alignment_null", "InvalidArgument: AxisAlignment: the space is null",
     [] { AxisAlignment(nullptr, {}); }},
    {"alignment_edge", "InvalidArgument: AxisAlignment: there is no half-edge 6",
     [] {
       AxisAlignment(space(), {{6, 0}});
     }},
    {"alignment_coordinate", "InvalidArgument: AxisAlignment: there is no half-edge 0 or no coord",
     [] {
       AxisAlignment(space(), {{0, 2}});
     }},
    {"seams_null", "InvalidArgument: SeamlessConstraint: the seams is null",
     [] { SeamlessConstraint(space(), nullptr); }},
};

}  // namespace element_calls

class ElementCalls : public Misuse {};
TEST_P(ElementCalls, IsRefused) { expect_refusal(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Table, ElementCalls, testing::ValuesIn(element_calls::kCalls), name_of);

}  // namespace majorant::misuse

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
