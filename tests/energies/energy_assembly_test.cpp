// Whole energies of curved maps: independent formulas, finite differences, invariances.
#include <gtest/gtest.h>

#include <memory>

#include "energies/density_fixture.h"
#include "majorant/framework/element_values.h"
#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/problem.h"

namespace majorant {
namespace {

using test::Random;

struct Fixture {
  explicit Fixture(int degree, double bend = 0.12)
      : mesh(test::grid(4, 3, 0.25, 0.3)),
        space(std::make_shared<const BezierTriangleSpace>(
            mesh.faces, static_cast<Index>(mesh.positions.rows()), degree)),
        rest(flat_triangles(mesh.positions, mesh.faces)) {
    Random random(7);
    x = test::linear_map(*space, test::flat(mesh.positions));
    x += bend / degree * random.vector(x.size());
  }
  test::Mesh mesh;
  std::shared_ptr<const BezierTriangleSpace> space;
  RestShapes rest;
  Vec x;
};

// Returns sum_t A_t (|J|^2 + |J^-1|^2) from edge vectors, without a rest frame: |J|^2 = tr(G^-1 U),
// with Gram matrices G of the surface's and U of the plane's edges.
double direct_symmetric_dirichlet(const test::Mesh& mesh, const Vec& x) {
  double sum = 0;
  for (Index f = 0; f < mesh.faces.rows(); ++f) {
    Eigen::Matrix<double, 3, 2> surface;
    Eigen::Matrix2d plane;
    for (int k = 0; k < 2; ++k) {
      surface.col(k) =
          (mesh.positions.row(mesh.faces(f, k + 1)) - mesh.positions.row(mesh.faces(f, 0)))
              .transpose();
      plane.col(k) = x.segment<2>(2 * mesh.faces(f, k + 1)) - x.segment<2>(2 * mesh.faces(f, 0));
    }
    const Eigen::Matrix2d g = surface.transpose() * surface, u = plane.transpose() * plane;
    sum +=
        0.5 * std::sqrt(g.determinant()) * ((g.inverse() * u).trace() + (u.inverse() * g).trace());
  }
  return sum;
}

TEST(EnergyAssembly, LinearMapsMatchTheDirectFormula) {
  const Fixture s(1);
  const auto term = symmetric_dirichlet()(s.space, s.rest, {lattice_rule(1)});
  const Problem problem = ProblemBuilder(s.x.size()).add(term, 1).build();
  const double expected = direct_symmetric_dirichlet(s.mesh, s.x);
  EXPECT_NEAR(Evaluator(problem).value(s.x), expected, 1e-12 * expected);
}

TEST(EnergyAssembly, IsometriesHaveEnergyFour) {
  for (int degree = 1; degree <= 8; ++degree) {
    const test::Mesh mesh = test::grid(4, 4);  // half squares: exact in doubles
    const auto space = std::make_shared<const BezierTriangleSpace>(mesh.faces, 25, degree);
    const RestShapes rest = flat_triangles(mesh.positions, mesh.faces);
    const auto term = symmetric_dirichlet()(
        space, rest, {guarded_rule(composite_rule(radon_rule(), 2), 1, 1e-3)});
    const Problem problem =
        ProblemBuilder(2 * space->node_count()).add(term, 1 / rest.measure.sum()).build();
    Points2 uv = test::flat(mesh.positions);
    EXPECT_NEAR(Evaluator(problem).value(test::linear_map(*space, uv)), 4, 4e-14);
    const Eigen::Matrix2d turn =
        test::from_parts(Vector2(std::cos(1.1), std::sin(1.1)), Vector2(0, 0));
    uv = ((uv * turn.transpose()).rowwise() + Eigen::RowVector2d(2, -3)).eval();
    const Vec x = test::linear_map(*space, uv);
    EXPECT_NEAR(Evaluator(problem).value(x), 4, 4e-13);
    Evaluator evaluator(problem);
    Vec g, h;
    evaluator.linearize(x, Curvature::Projected, g, h);
    EXPECT_LE(g.cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_TRUE(h.allFinite());
  }
  // Exact where no rounding occurs.
  const test::Triangles t(1);
  const auto term = symmetric_dirichlet()(t.space, t.rest, {lattice_rule(1)});
  for (const Eigen::Matrix2d& j : {test::from_parts(Vector2(1, 0), Vector2(0, 0)),
                                   test::from_parts(Vector2(0, -1), Vector2(0, 0))})
    EXPECT_EQ(test::point_models(*term, {j}, Curvature::Exact)[0].value, 4.0);
}

// Returns the fourth-order central difference of the vector function F in direction d.
template <class F>
auto difference(const F& f, const Vec& x, const Vec& d, double h) {
  using Result = std::decay_t<decltype(f(x))>;
  const Result r = (8.0 * (f(Vec(x + h * d)) - f(Vec(x - h * d))) -
                    (f(Vec(x + 2 * h * d)) - f(Vec(x - 2 * h * d)))) /
                   (12 * h);
  return r;
}

class Assembled : public testing::TestWithParam<int> {
  ThreadCount one_{1};  // one thread suffices for these problems
};

void expect_consistent(const Fixture& s, const std::shared_ptr<const EnergyTerm>& term) {
  const Problem problem = ProblemBuilder(s.x.size()).add(term, 0.7).build();
  Evaluator evaluator(problem);
  Vec g, values;
  const double f = evaluator.linearize(s.x, Curvature::Exact, g, values);
  ASSERT_TRUE(std::isfinite(f));
  EXPECT_NEAR(f, evaluator.value(s.x), 1e-13 * f);
  const SparsePattern& p = problem.pattern();
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(p.size, p.size);
  for (Index c = 0; c < p.size; ++c)
    for (Index k = p.column_starts[static_cast<std::size_t>(c)];
         k < p.column_starts[static_cast<std::size_t>(c) + 1]; ++k)
      h(p.rows[static_cast<std::size_t>(k)], c) = h(c, p.rows[static_cast<std::size_t>(k)]) =
          values[k];
  const auto value = [&](const Vec& x) { return evaluator.value(x); };
  const auto gradient = [&](const Vec& x) {
    Vec out, unused;
    evaluator.linearize(x, Curvature::Projected, out, unused);  // every model has the same gradient
    return out;
  };
  Random random(11);
  for (Index i = 0; i < p.size; i += 3) {  // single unknowns show errors that sums hide
    const Vec d = Vec::Unit(p.size, i);
    EXPECT_NEAR(difference(value, s.x, d, 2e-4), g[i], 1e-8 * g.norm()) << "unknown " << i;
    EXPECT_LE((difference(gradient, s.x, d, 2e-4) - h.col(i)).norm(), 1e-8 * h.norm())
        << "column " << i;
  }
  // Translations do not change the energy.
  Vec shift = Vec::Zero(p.size);
  for (Index i = 0; i < p.size; i += 2) shift[i] = 1;
  EXPECT_LE((h * shift).norm(), 1e-12 * h.norm());
  EXPECT_NEAR(g.dot(shift), 0, 1e-12 * g.norm());
  // Rotations do not either: g . (x rotated by 90 degrees) = 0.
  Vec turned(p.size);
  for (Index i = 0; i < p.size; i += 2) turned.segment<2>(i) = Vector2(-s.x[i + 1], s.x[i]);
  EXPECT_NEAR(g.dot(turned), 0, 1e-12 * g.norm() * turned.norm());
}

TEST_P(Assembled, SymmetricDirichlet) {
  const Fixture s(GetParam());
  expect_consistent(s, symmetric_dirichlet()(s.space, s.rest, {radon_rule()}));
}

TEST_P(Assembled, SpectralMips) {
  const Fixture s(GetParam());
  expect_consistent(s, make_energy(s.space, s.rest, test::spectral_mips(), {radon_rule()}));
}

TEST_P(Assembled, Arap) {
  const Fixture s(GetParam());
  expect_consistent(s, make_energy(s.space, s.rest, test::arap(), {radon_rule()}));
}

// The integral by point evaluation of the map, without gradient_products.
TEST_P(Assembled, ValueIsTheQuadratureSum) {
  const Fixture s(GetParam());
  const Quadrature rule = composite_rule(radon_rule(), 2);
  const auto term = symmetric_dirichlet()(s.space, s.rest, {rule});
  const Problem problem = ProblemBuilder(s.x.size()).add(term, 1).build();
  double sum = 0;
  for (Index e = 0; e < s.space->element_count(); ++e)
    for (Index l = 0; l < rule.size(); ++l) {
      const Eigen::MatrixX2d g = bernstein_gradients(GetParam(), rule.points.row(l));
      Eigen::Matrix2d d = Eigen::Matrix2d::Zero();
      for (int k = 0; k < g.rows(); ++k) d += s.x.segment<2>(2 * s.space->cells()(e, k)) * g.row(k);
      const Eigen::Matrix2d j = d * s.rest.inverse_of(e);
      sum += rule.weights[l] * s.rest.measure[e] * (j.squaredNorm() + j.inverse().squaredNorm());
    }
  EXPECT_NEAR(Evaluator(problem).value(s.x), sum, 1e-12 * sum);
}

TEST_P(Assembled, ElementModelsArePositiveSemidefinite) {
  const Fixture s(GetParam());
  const std::vector<Quadrature> rules{radon_rule()};
  for (const auto& term : std::vector<std::shared_ptr<const EnergyTerm>>{
           symmetric_dirichlet()(s.space, s.rest, rules),
           make_energy(s.space, s.rest, test::mips(), rules),
           make_energy(s.space, s.rest, test::arap(), rules)})
    for (const Curvature c :
         {Curvature::Projected, Curvature::Majorizer, Curvature::CompositeMajorizer}) {
      if (!term->supports(c)) continue;
      for (const Eigen::MatrixXd& h : test::element_models(*term, s.x, c).hessians)
        EXPECT_GE(test::smallest_eigenvalue(h), -1e-12 * h.trace()) << term->name();
    }
}

// Batches have several rules; each element uses its own.
TEST_P(Assembled, RulesPerElement) {
  const Fixture s(GetParam());
  const std::vector<Quadrature> rules{lattice_rule(2), radon_rule(), lattice_rule(5)};
  const auto term = symmetric_dirichlet()(s.space, s.rest, rules);
  TermState state;
  double expected = 0;
  std::vector<Vec> by_rule;
  for (const Quadrature& q : rules) {
    const auto single = symmetric_dirichlet()(s.space, s.rest, {q});
    by_rule.push_back(element_values(*single, {}, ColoredBatches(single->element_dofs(), {}), s.x));
  }
  for (Index e = 0; e < s.space->element_count(); ++e) {
    state.element_rule.push_back(e % 3);
    expected += by_rule[static_cast<std::size_t>(e % 3)][e];
  }
  const Problem problem = ProblemBuilder(s.x.size()).add(term, state).build();
  EXPECT_NEAR(Evaluator(problem).value(s.x), expected, 1e-13 * expected);
}

// Listed elements by one rule have the bits of a plan.
TEST_P(Assembled, ValuesOfListedElements) {
  const Fixture s(GetParam());
  const auto term = symmetric_dirichlet()(s.space, s.rest, {lattice_rule(2), radon_rule()});
  TermState state;
  state.element_rule.assign(to_size(s.space->element_count()), 1);
  const ColoredBatches plan(term->element_dofs(), state.element_rule);
  const Vec all = element_values(*term, state, plan, s.x);
  std::vector<Index> listed;
  while (listed.size() < 20 * ElementBatch::kMaxSize)
    for (Index e = s.space->element_count(); e-- > 0;) listed.push_back(e);
  for (const int threads : {1, 2}) {
    const ThreadCount count(threads);
    EXPECT_EQ(element_values(*term, {}, 1, listed, s.x), all(listed));
    EXPECT_EQ(element_values(*term, {}, 1, {}, s.x).size(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Degrees, Assembled, testing::Range(1, 5));

TEST(EnergyAssembly, SetUpErrors) {
  const Fixture s(1);
  EXPECT_THROW(symmetric_dirichlet()(s.space, s.rest, {}), InvalidArgument);
  RestShapes fewer = s.rest;
  fewer.measure.conservativeResize(3);
  EXPECT_THROW(symmetric_dirichlet()(s.space, fewer, {radon_rule()}), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
