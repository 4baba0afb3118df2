// The energy "as similar as possible" with a fixed boundary is a linear problem: one Newton step
// gives the discrete harmonic map of that degree (method.md E9).
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>

#include "energies/density_fixture.h"
#include "majorant/framework/newton.h"
#include "majorant/maps/map_problem.h"

namespace majorant {
namespace {

// A bumpy grid; the start is its projection with inner nodes moved.
struct Sheet {
  explicit Sheet(int degree) : mesh(test::grid(6, 5, 0.25, 0.3)) {
    space = std::make_shared<const BezierTriangleSpace>(
        mesh.faces, static_cast<Index>(mesh.positions.rows()), degree);
    spec.rest = std::make_shared<const RestShapes>(flat_triangles(mesh.positions, mesh.faces));
    spec.energy = {{find_energy("asap")->make, 1.0}};
    spec.boundary = BoundaryCondition::Fixed;
    start = test::linear_map(*space, test::flat(mesh.positions));
    const auto& fixed = space->boundary_nodes();
    test::Random random(3);
    for (Index k = 0; k < space->node_count(); ++k)
      if (!std::binary_search(fixed.begin(), fixed.end(), k))
        start.segment<2>(2 * k) += random.vector(2, -0.04, 0.04) / degree;
  }
  test::Mesh mesh;
  std::shared_ptr<const BezierTriangleSpace> space;
  MapSpecification spec;
  Vec start;
};

// Returns K(i, j) = integral of grad B_i . grad B_j over the surface, from the edge vectors of
// faces. Radon's rule is exact for products of gradients up to degree 3.
Eigen::SparseMatrix<double> stiffness(const Sheet& s) {
  std::vector<Eigen::Triplet<double>> entries;
  const Quadrature rule = radon_rule();
  for (Index f = 0; f < s.mesh.faces.rows(); ++f) {
    Eigen::Matrix<double, 3, 2> t;  // reference coordinates are those of corners 0 and 1
    for (int k = 0; k < 2; ++k)
      t.col(k) =
          (s.mesh.positions.row(s.mesh.faces(f, k)) - s.mesh.positions.row(s.mesh.faces(f, 2)))
              .transpose();
    const Eigen::Matrix2d metric = t.transpose() * t, inverse = metric.inverse();
    const double area = 0.5 * std::sqrt(metric.determinant());
    for (Index l = 0; l < rule.size(); ++l) {
      const Eigen::MatrixX2d g = bernstein_gradients(s.space->degree(), rule.points.row(l));
      const Eigen::MatrixXd k = rule.weights[l] * area * g * inverse * g.transpose();
      for (Index i = 0; i < k.rows(); ++i)
        for (Index j = 0; j < k.cols(); ++j)
          entries.emplace_back(s.space->cells()(f, i), s.space->cells()(f, j), k(i, j));
    }
  }
  Eigen::SparseMatrix<double> k(s.space->node_count(), s.space->node_count());
  k.setFromTriplets(entries.begin(), entries.end());
  return k;
}

// Returns #N by 2 points; boundary nodes are those of `start`.
Points2 harmonic_map(const Sheet& s, const Eigen::SparseMatrix<double>& k) {
  Points2 uv = Eigen::Map<const Points2>(s.start.data(), s.space->node_count(), 2);
  const auto& fixed = s.space->boundary_nodes();
  std::vector<Index> number(static_cast<std::size_t>(uv.rows()), -1);
  Index inner = 0;
  for (Index i = 0; i < uv.rows(); ++i)
    if (!std::binary_search(fixed.begin(), fixed.end(), i))
      number[static_cast<std::size_t>(i)] = inner++;
  std::vector<Eigen::Triplet<double>> entries;
  Points2 rhs = Points2::Zero(inner, 2);
  for (Index c = 0; c < k.outerSize(); ++c)
    for (Eigen::SparseMatrix<double>::InnerIterator it(k, c); it; ++it) {
      const Index i = number[static_cast<std::size_t>(it.row())],
                  j = number[static_cast<std::size_t>(c)];
      if (i < 0) continue;
      if (j >= 0)
        entries.emplace_back(i, j, it.value());
      else
        rhs.row(i) -= it.value() * uv.row(c);
    }
  Eigen::SparseMatrix<double> reduced(inner, inner);
  reduced.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(reduced);
  const Eigen::MatrixX2d solution = solver.solve(Eigen::MatrixX2d(rhs));
  for (Index i = 0; i < uv.rows(); ++i)
    if (number[static_cast<std::size_t>(i)] >= 0)
      uv.row(i) = solution.row(number[static_cast<std::size_t>(i)]);
  return uv;
}

class AsapHarmonic : public testing::TestWithParam<std::tuple<int, Curvature>> {};

TEST_P(AsapHarmonic, OneNewtonStepToTheHarmonicMap) {
  const auto [degree, curvature] = GetParam();
  const Sheet s(degree);
  const auto terms = energy_terms(s.spec, s.space, {radon_rule()});
  const Problem problem =
      map_problem(s.spec, s.space, s.start, terms,
                  std::make_shared<const LocalInjectivity>(s.space, 2 * s.spec.rest->measure))
          .problem;
  NewtonOptions options;
  options.curvature = curvature;
  Vec y = problem.reduce(s.start), g, h;
  Evaluator evaluator(problem);
  evaluator.linearize(y, Curvature::Exact, g, h);
  const double before = g.norm();
  const SolveResult r = NewtonMinimizer(options).minimize(problem, y, {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  ASSERT_EQ(r.iterations.size(), 1U);
  EXPECT_NEAR(r.iterations[0].step, 1, 1e-12);
  EXPECT_EQ(r.iterations[0].shift, 0);
  evaluator.linearize(r.y, Curvature::Exact, g, h);
  EXPECT_LE(g.norm(), 1e-13 * before);

  const Eigen::SparseMatrix<double> k = stiffness(s);
  const Points2 uv = harmonic_map(s, k);
  const Vec x = problem.expand(r.y);
  const Points2 found = Eigen::Map<const Points2>(x.data(), uv.rows(), 2);
  EXPECT_LE((found - uv).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT((uv - Eigen::Map<const Points2>(s.start.data(), uv.rows(), 2)).cwiseAbs().maxCoeff(),
            1e-2);
  // integral = 2 Dirichlet - 2 area; Dirichlet = (u.Ku + v.Kv) / 2, the image is 6 by 5.
  const double dirichlet = 0.5 * (uv.transpose() * (k * uv).eval()).trace();
  const double area = s.spec.rest->measure.sum();
  EXPECT_NEAR(r.energy * area, 2 * dirichlet - 2 * 30, 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Degrees, AsapHarmonic,
                         testing::Combine(testing::Values(1, 2, 3),
                                          testing::Values(Curvature::Projected, Curvature::Exact,
                                                          Curvature::Majorizer)));

// With the majorizer of the paper convergence is linear (E9), so that it is not the default.
TEST(AsapHarmonic, TheCompositeMajorizerNeedsManySteps) {
  const Sheet s(2);
  const auto terms = energy_terms(s.spec, s.space, {radon_rule()});
  const Problem problem =
      map_problem(s.spec, s.space, s.start, terms,
                  std::make_shared<const LocalInjectivity>(s.space, 2 * s.spec.rest->measure))
          .problem;
  NewtonOptions options;
  options.curvature = Curvature::CompositeMajorizer;
  options.blend.below = 0;
  const SolveResult r = NewtonMinimizer(options).minimize(problem, problem.reduce(s.start), {});
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  EXPECT_GT(r.iterations.size(), 3U);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
