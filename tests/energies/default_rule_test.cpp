// Terms without a given rule: their default rule, and its sufficiency.
#include <gtest/gtest.h>

#include "energies/density_fixture.h"
#include "energies/linear_tetrahedra.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"

namespace majorant {
namespace {

const RowMatrix kTriangle{{0, 0}, {2, 0}, {0.5, 1}};
const RowMatrix kTetrahedron{{0, 0, 0}, {1, 0, 0}, {0.25, 1, 0}, {0, 0.5, 1}};
const RowMatrix kSquare{{0, 0}, {1, 0}, {1.5, 1}, {0.5, 1}};
const RowMatrix kCube{{0, 0, 0}, {1, 0, 0}, {1.5, 1, 0}, {0.5, 1, 0},
                      {0, 0, 1}, {1, 0, 1}, {1.5, 1, 1}, {0.5, 1, 1}};
const RowMatrix kWedge{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, 1, 1}};

template <class Space>
std::shared_ptr<const Space> one_cell(const RowMatrix& corners, int degree) {
  Cells cell(1, corners.rows());
  for (Index k = 0; k < cell.size(); ++k) cell(0, k) = k;
  return std::make_shared<const Space>(cell, static_cast<Index>(corners.rows()), degree);
}

template <class Space>
std::vector<Index> sizes(const RowMatrix& corners, RestJacobian rest, int degrees) {
  std::vector<Index> out;
  for (int degree = 1; degree <= degrees; ++degree)
    out.push_back(one_cell<Space>(corners, degree)->default_rule(rest).size());
  return out;
}

// The table of docs/elements.md.
TEST(DefaultRule, HasTheFewestSufficientPoints) {
  using I = std::vector<Index>;
  const auto constant = RestJacobian::Constant, varying = RestJacobian::Varying;
  EXPECT_EQ(sizes<BezierTriangleSpace>(kTriangle, constant, 6), (I{1, 3, 6, 12, 16, 25}));
  EXPECT_EQ(sizes<BezierTriangleSpace>(kTriangle, varying, 3), (I{1, 3, 6}));
  EXPECT_EQ(sizes<BezierTetrahedronSpace>(kTetrahedron, constant, 5), (I{1, 4, 14, 24, 46}));
  EXPECT_EQ(sizes<BezierTetrahedronSpace>(kTetrahedron, varying, 3), (I{1, 14, 24}));
  EXPECT_EQ(sizes<BezierQuadSpace>(kSquare, varying, 3), (I{4, 9, 16}));
  EXPECT_EQ(sizes<BezierHexahedronSpace>(kCube, varying, 3), (I{8, 27, 125}));
  EXPECT_EQ(sizes<BezierWedgeSpace>(kWedge, varying, 3), (I{6, 21, 80}));
}

// Returns the mean of |J|^2 over one cell, for random control points.
template <class Space, int D>
void expect_exact(const RowMatrix& corners, int degree, const Quadrature& fine) {
  SCOPED_TRACE(testing::Message() << corners.rows() << " corners, degree " << degree);
  const auto space = one_cell<Space>(corners, degree);
  const RestShapes rest = corners.rows() > D + 1
                              ? curved_shapes(*space, space->node_positions(corners), fine)
                              : flat_simplices(corners, space->cells().leftCols(D + 1));
  const auto dirichlet = density<D, D>("dirichlet", [](const auto& J) { return J.squaredNorm(); },
                                       {Domain::Everywhere});
  const Index size = D * space->node_count();
  const auto energy = [&](std::shared_ptr<const EnergyTerm> term, const Vec& x) {
    return Evaluator(ProblemBuilder(size).add(std::move(term), 1).build()).value(x);
  };
  test::Random random(5);
  for (int trial = 0; trial < 5; ++trial) {
    const Vec x = random.vector(size);
    const double exact = energy(make_energy(space, rest, dirichlet, {fine}), x);
    EXPECT_NEAR(energy(make_energy(space, rest, dirichlet), x), exact, 1e-12 * exact);
  }
}

TEST(DefaultRule, IntegratesTheSquareOfTheJacobianExactly) {
  for (int degree = 1; degree <= 5; ++degree) {
    expect_exact<BezierTriangleSpace, 2>(kTriangle, degree, exact_rule({3}, 12));
    expect_exact<BezierTetrahedronSpace, 3>(kTetrahedron, degree, exact_rule({4}, 8));
    expect_exact<BezierQuadSpace, 2>(kSquare, degree, tensor_gauss_rule(9));
    if (degree > 2) continue;
    expect_exact<BezierHexahedronSpace, 3>(kCube, degree, exact_rule({2, 2, 2}, 9));
    expect_exact<BezierWedgeSpace, 3>(kWedge, degree, exact_rule({3, 2}, 9));
  }
}

// Returns the number of points, by counting calls of the formula for local values.
int points_called(const EnergyFactory& energy, int degree, int& calls) {
  const auto space = one_cell<BezierTriangleSpace>(kTriangle, degree);
  const RowMatrix nodes = space->node_positions(kTriangle);
  const auto term = energy(space, flat_simplices(kTriangle, space->faces()));
  calls = 0;
  Evaluator(ProblemBuilder(2 * space->node_count()).add(term, 1).build())
      .value(Eigen::Map<const Vec>(nodes.data(), nodes.size()));
  return calls;
}

TEST(DefaultRule, IsGuardedWhereThereIsABarrier) {
  int calls = 0;
  const auto formula = [&calls](const auto& J) {
    ++calls;
    return J.squaredNorm() + 1.0 / J.determinant();
  };
  const auto barrier = energy_factory(density<2, 2>("with", formula));
  const auto none = energy_factory(density<2, 2>("without", formula, {Domain::Everywhere}));
  // A point takes one call per lane of a batch.
  const int lanes = points_called(none, 1, calls);
  EXPECT_EQ(points_called(barrier, 1, calls), lanes);
  EXPECT_EQ(points_called(none, 2, calls), 3 * lanes);
  EXPECT_EQ(points_called(barrier, 2, calls), (3 + 3) * lanes);
}

TEST(DefaultRule, UserSpacesMayHaveNone) {
  const auto space = std::make_shared<const test::LinearTetrahedra>(Cells{{0, 1, 2, 3}}, 4);
  const auto energy = density<3, 3>("e", [](const auto& J) { return J.squaredNorm(); });
  EXPECT_THROW(make_energy(space, flat_simplices(kTetrahedron, space->cells()), energy),
               InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
