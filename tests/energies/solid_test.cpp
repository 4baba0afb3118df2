// Materials and solids: derivatives against automatic differentiation of the textbook formulas, the
// state at rest, and the projection of dilatation inside elements.
#include "majorant/energies/solid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/rest_shapes.h"
#include "majorant/energies/make_energy.h"
#include "majorant/energies/materials/materials.h"
#include "majorant/framework/error.h"
#include "majorant/framework/problem.h"
#include "support.h"

namespace majorant {
namespace {

using test::Random;

const LameConstants kRubber = LameConstants::of(1.3, 0.4);
const MooneyRivlin kMooney{0.3, 0.1, 7.0};
const Ogden kOgden{{{0.6, 2}, {-0.2, -2}, {0.05, 4}}, 5.0};

// A point at which F are compared: value, gradient and Hessian.
template <class Density>
struct ModelAt {
  static constexpr int size = Density::size;
  PointModel<double, size> m;
  PointModel<double, size> slope;
  double value;
  ModelAt(const Density& density, const double (&z)[size]) {
    density.model(z, m);
    density.slope(z, slope);
    value = density.value(z);
  }
};

template <int D>
std::vector<std::array<double, D * D>> deformations() {
  Random random(5);
  std::vector<std::array<double, D * D>> out;
  while (out.size() < 30) {
    std::array<double, D * D> z;
    for (double& entry : z) entry = random.uniform(-1, 1);
    for (int i = 0; i < D; ++i) z[to_size(i * D + i)] += 1;
    double F[D * D];
    std::copy(z.begin(), z.end(), F);
    if (determinant_of<D>(F) > 0.2) out.push_back(z);
  }
  return out;
}

template <int D, class Density, class Textbook>
void expect_formula(const Density& material, Textbook textbook) {
  const auto oracle = density<D, D>("textbook", textbook, Traits{.domain = Domain::Everywhere});
  for (const auto& entries : deformations<D>()) {
    double z[D * D];
    std::copy(entries.begin(), entries.end(), z);
    const ModelAt<Density> a(material, z);
    const ModelAt<std::decay_t<decltype(oracle)>> b(oracle, z);
    const std::string where = std::string(material.name()) + " in " + std::to_string(D);
    EXPECT_NEAR(a.value, b.value, 1e-12 * (1 + std::abs(b.value))) << where;
    EXPECT_EQ(a.m.f, a.value) << where;
    EXPECT_EQ(a.slope.f, a.value) << where;
    for (int r = 0; r < D * D; ++r) {
      EXPECT_NEAR(a.m.g[r], b.m.g[r], 1e-10 * (1 + std::abs(b.m.g[r]))) << where;
      EXPECT_EQ(a.slope.g[r], a.m.g[r]) << where;
    }
    for (int k = 0; k < D * D * (D * D + 1) / 2; ++k)
      EXPECT_NEAR(a.m.k[k], b.m.k[k], 1e-9 * (1 + std::abs(b.m.k[k]))) << where << " entry " << k;
  }
}

// Textbook formulas in F as a 3 x 3 matrix; plane strain has the third row and column of the unit
// matrix.
template <int D, class Matrix>
auto in_space(const Matrix& F) {
  using T = std::decay_t<decltype(F(0, 0))>;
  SmallMatrix<T, 3, 3> out;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      out(i, j) = i < D && j < D ? F(i % D, j % D) : T(i == j ? 1.0 : 0.0);
  return out;
}

template <int D>
void expect_all_formulas() {
  const double mu = kRubber.mu, lambda = kRubber.lambda;
  expect_formula<D>(stable_neo_hookean<D>(kRubber), [=](const auto& plane) {
    using std::log;
    const auto F = in_space<D>(plane);
    const auto I = F.squaredNorm(), off = F.determinant() - 1.0 - mu / lambda + mu / (4 * lambda);
    return mu / 2 * (I - 3.0) + lambda / 2 * off * off - mu / 2 * log(I + 1.0) +
           mu / 2 * std::log(4.0) - 9 * mu * mu / (32 * lambda);
  });
  expect_formula<D>(neo_hookean<D>(kRubber), [=](const auto& plane) {
    using std::log;
    const auto F = in_space<D>(plane);
    const auto l = log(F.determinant());
    return mu / 2 * (F.squaredNorm() - 3.0) - mu * l + lambda / 2 * l * l;
  });
  expect_formula<D>(saint_venant_kirchhoff<D>(kRubber), [=](const auto& plane) {
    const auto F = in_space<D>(plane);
    auto E = 0.5 * (F.transpose() * F);
    for (int i = 0; i < 3; ++i) E(i, i) = E(i, i) - 0.5;
    return mu * E.squaredNorm() + lambda / 2 * E.trace() * E.trace();
  });
  expect_formula<D>(mooney_rivlin<D>(kMooney), [](const auto& plane) {
    using std::pow;
    const auto F = in_space<D>(plane);
    const auto C = F.transpose() * F;
    const auto J = F.determinant();
    const auto I1 = C.trace(), I2 = C.adjugate().trace();
    return kMooney.a * (pow(J, -2.0 / 3) * I1 - 3.0) + kMooney.b * (pow(J, -4.0 / 3) * I2 - 3.0) +
           kMooney.kappa / 2 * (J - 1.0) * (J - 1.0);
  });
  expect_formula<D>(ogden<D>(kOgden), [](const auto& plane) {
    using std::pow;
    const auto F = in_space<D>(plane);
    const auto C = F.transpose() * F;
    const auto J = F.determinant();
    return 0.6 / 2 * (pow(J, -2.0 / 3) * F.squaredNorm() - 3.0) +
           0.2 / 2 * (pow(J, 2.0 / 3) * F.inverse().squaredNorm() - 3.0) +
           0.05 / 4 * (pow(J, -4.0 / 3) * C.squaredNorm() - 3.0) +
           kOgden.kappa / 2 * (J - 1.0) * (J - 1.0);
  });
}

TEST(Materials, AreTheirFormulasInSpace) { expect_all_formulas<3>(); }
TEST(Materials, AreTheirFormulasInPlaneStrain) {
  expect_all_formulas<2>();
  expect_formula<2>(fixed_corotated<2>(kRubber), [](const auto& F) {
    using std::sqrt;
    const auto J = F.determinant();
    const auto trace = sqrt(F.squaredNorm() + 2.0 * J);  // of R^T F
    return kRubber.mu * (F.squaredNorm() - 2.0 * trace + 2.0) +
           kRubber.lambda / 2 * (J - 1.0) * (J - 1.0);
  });
}

// Elements of every element space, curved by a quadratic map.
template <class Space>
struct OneElement {
  std::shared_ptr<const Space> space;
  RestShapes rest;
  Vec x;
  OneElement(const RowMatrix& corners, int degree, bool is_curved) {
    Cells cells(1, static_cast<Index>(corners.rows()));
    for (Index k = 0; k < cells.cols(); ++k) cells(0, k) = k;
    space = std::make_shared<const Space>(cells, static_cast<Index>(corners.rows()), degree);
    RowMatrix nodes = space->node_positions(corners);
    Random random(9);
    const auto disturb = [&random](RowMatrix& positions, double size) {
      for (double& entry : positions.reshaped()) entry += random.uniform(-size, size);
    };
    if (is_curved) {
      disturb(nodes, 0.05);
      rest = curved_shapes(*space, nodes, space->default_rule(RestJacobian::Varying));
    } else {
      rest = flat_simplices(corners, cells);
    }
    disturb(nodes, 0.1);
    RowMatrix stretched = nodes;
    stretched.col(0) *= 1.2;
    x = Eigen::Map<const Vec>(stretched.data(), stretched.size());
  }
};

RowMatrix corners_of_square() {
  RowMatrix out(4, 2);
  out << 0, 0, 1, 0, 1, 1, 0, 1;
  return out;
}
RowMatrix corners_of_triangle() { return corners_of_square().topRows(3); }
RowMatrix corners_of_tetrahedron() {
  RowMatrix out(4, 3);
  out << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  return out;
}
RowMatrix corners_of_cube() {
  RowMatrix out(8, 3);
  out << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1;
  return out;
}

template <int D, class Space>
void expect_derivatives(const OneElement<Space>& element) {
  const auto check = [&](const auto& material) {
    const DerivativeReport report =
        check_derivatives(*make_energy(element.space, element.rest, material), element.x);
    EXPECT_TRUE(report.ok()) << material.name() << "\n" << report.message();
  };
  const auto all = [&](const auto& material) {
    check(material);
    for (int degree = 0; degree <= 2; ++degree) check(mean_dilatation(material, degree));
  };
  all(stable_neo_hookean<D>(kRubber));
  all(neo_hookean<D>(kRubber));
  all(fixed_corotated<D>(kRubber));
  all(mooney_rivlin<D>(kMooney));
  all(ogden<D>(kOgden));
  check(saint_venant_kirchhoff<D>(kRubber));
}

TEST(MeanDilatation, DerivativesOnEveryElement) {
  expect_derivatives<2>(OneElement<BezierTriangleSpace>(corners_of_triangle(), 3, false));
  expect_derivatives<2>(OneElement<BezierTriangleSpace>(corners_of_triangle(), 2, true));
  expect_derivatives<2>(OneElement<BezierQuadSpace>(corners_of_square(), 2, true));
  expect_derivatives<3>(OneElement<BezierTetrahedronSpace>(corners_of_tetrahedron(), 2, false));
  expect_derivatives<3>(OneElement<BezierHexahedronSpace>(corners_of_cube(), 1, true));
}

template <class Term>
double energy_at(const std::shared_ptr<const Term>& term, const Vec& x) {
  const Problem problem = ProblemBuilder(static_cast<Index>(x.size())).add(term, 1).build();
  return Evaluator(problem).value(problem.reduce(x));
}

// If the polynomials contain det F, the projection is the identity; at degree 0 theta is the mean.
TEST(MeanDilatation, ProjectsTheDeterminant) {
  const OneElement<BezierTriangleSpace> e(corners_of_triangle(), 2, false);
  const auto nothing = density<2, 2>(
      "nothing", [](const auto& F) { return 0.0 * F(0, 0); }, Traits{.domain = Domain::Everywhere});
  const auto squared = solid(nothing, [](const auto& J) { return J * J; });
  const Quadrature rule = exact_rule({3}, 8);
  const double whole = energy_at(make_energy(e.space, e.rest, squared, {rule}), e.x);
  const double same =
      energy_at(make_energy(e.space, e.rest, mean_dilatation(squared, 2), {rule}), e.x);
  EXPECT_NEAR(whole, same, 1e-13);
  const auto area = solid(nothing, [](const auto& J) { return 1.0 * J; });
  const double mean = energy_at(make_energy(e.space, e.rest, area, {rule}), e.x) / 0.5;
  const auto averaged = make_energy(e.space, e.rest, mean_dilatation(squared), {rule});
  EXPECT_NEAR(energy_at(averaged, e.x), 0.5 * mean * mean, 1e-13);
  EXPECT_LT(energy_at(averaged, e.x), whole - 1e-4);
  EXPECT_NEAR(averaged->pressures(e.x, rule.points.topRows(2))(0, 1), 2 * mean, 1e-12);
}

TEST(MeanDilatation, MaterialsRestWithoutStress) {
  const OneElement<BezierTetrahedronSpace> e(corners_of_tetrahedron(), 2, false);
  const RowMatrix nodes = e.space->node_positions(corners_of_tetrahedron());
  const Vec rest = Eigen::Map<const Vec>(nodes.data(), nodes.size());
  const auto expect_rest = [&](const auto& material) {
    const auto term = make_energy(e.space, e.rest, material);
    const Problem problem = ProblemBuilder(static_cast<Index>(rest.size())).add(term, 1).build();
    Vec g;
    EXPECT_NEAR(Evaluator(problem).gradient(rest, g), 0, 1e-14) << material.name();
    EXPECT_LT(g.cwiseAbs().maxCoeff(), 1e-14) << material.name();
  };
  const auto both = [&](const auto& material) {
    expect_rest(material);
    expect_rest(mean_dilatation(material));
  };
  both(stable_neo_hookean<3>(kRubber));
  both(neo_hookean<3>(kRubber));
  both(fixed_corotated<3>(kRubber));
  both(mooney_rivlin<3>(kMooney));
  both(ogden<3>(kOgden));
  expect_rest(saint_venant_kirchhoff<3>(kRubber));
}

TEST(MeanDilatation, RefusesUnsupportedElements) {
  const OneElement<BezierTriangleSpace> e(corners_of_triangle(), 2, false);
  const auto material = stable_neo_hookean<2>(kRubber);
  const auto evaluate = [&](int degree, const Quadrature& rule) {
    energy_at(make_energy(e.space, e.rest, mean_dilatation(material, degree), {rule}), e.x);
  };
  EXPECT_THROW(evaluate(1, exact_rule({3}, 1)), InvalidArgument);
  EXPECT_THROW(evaluate(3, exact_rule({3}, 8)), InvalidArgument);
  EXPECT_THROW(evaluate(-1, exact_rule({3}, 8)), InvalidArgument);
  EXPECT_THROW(make_energy(e.space, e.rest, material)->pressures(e.x, exact_rule({3}, 1).points),
               InvalidArgument);
  EXPECT_THROW(LameConstants::of(1, 0.5), InvalidArgument);
  EXPECT_THROW(LameConstants::of(0, 0.3), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
