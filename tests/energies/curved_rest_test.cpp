// Maps of curved rest shapes: values, gradients and Hessians against a straightforward evaluation.
#include <gtest/gtest.h>

#include "energies/density_fixture.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

constexpr Curvature kHessians[] = {Curvature::Exact, Curvature::Projected, Curvature::Majorizer,
                                   Curvature::CompositeMajorizer, Curvature::Reweighted};

// Returns `dims` numbers per node, the positions in the flat triangles of `mesh`.
RowMatrix lattice_positions(const BezierTriangleSpace& space, const test::Mesh& mesh, int dims) {
  const TriangleIndices& ix = TriangleIndices::of_degree(space.degree());
  RowMatrix p(space.node_count(), dims);
  for (Index f = 0; f < space.element_count(); ++f)
    for (int l = 0; l < ix.count(); ++l) {
      const MultiIndex& m = ix.multi(l);
      Eigen::RowVector3d q = Eigen::RowVector3d::Zero();
      for (int k = 0; k < 3; ++k)
        q += m[static_cast<std::size_t>(k)] * mesh.positions.row(mesh.faces(f, k));
      p.row(space.cells()(f, l)) = q.head(dims) / space.degree();
    }
  return p;
}

// A surface of curved triangles, in the plane (dims 2) or in space, and a map of it.
struct Curved {
  Curved(int degree, int dims, double bend = 0.08) : mesh(test::grid(3, 2, 0.2, 0.3)) {
    space = std::make_shared<const BezierTriangleSpace>(
        mesh.faces, static_cast<Index>(mesh.positions.rows()), degree);
    test::Random random(21);
    nodes = lattice_positions(*space, mesh, dims);
    for (Index k = 0; k < nodes.size(); ++k)
      nodes.data()[k] += random.uniform(-bend, bend) / degree;
    rest = curved_shapes(*space, nodes, rule);
    x = test::linear_map(*space, test::flat(mesh.positions));
    x += random.vector(x.size(), -0.08, 0.08) / degree;
  }
  test::Mesh mesh;
  std::shared_ptr<const BezierTriangleSpace> space;
  RowMatrix nodes;
  Quadrature rule = composite_rule(radon_rule(), 2);
  RestShapes rest;
  Vec x;
};

// Returns J of element e at a point, and half of the area element there. The frame is by
// Gram-Schmidt from the first tangent, or that of the plane.
std::pair<Eigen::Matrix2d, double> jacobian(const Curved& s, Index e, const Barycentric& xi) {
  const Eigen::MatrixX2d g = bernstein_gradients(s.space->degree(), xi);
  Eigen::MatrixX2d rest = Eigen::MatrixX2d::Zero(s.nodes.cols(), 2);
  Eigen::Matrix2d image = Eigen::Matrix2d::Zero();
  for (int l = 0; l < g.rows(); ++l) {
    const Index node = s.space->cells()(e, l);
    rest += s.nodes.row(node).transpose() * g.row(l);
    image += s.x.segment<2>(2 * node) * g.row(l);
  }
  Eigen::Matrix2d r;
  if (rest.rows() == 2) {
    r = rest;
  } else {
    const Vector3 t0 = rest.col(0), t1 = rest.col(1), q0 = t0.normalized();
    r << t0.norm(), q0.dot(t1), 0, t0.cross(t1).norm() / t0.norm();
  }
  return {image * r.inverse(), 0.5 * r.determinant()};
}

double anisotropic(const Eigen::Matrix2d& j) {
  return j(0, 0) * j(0, 0) + 2 * j(0, 1) * j(1, 0) + j(1, 1) * j(1, 1) * j(1, 1) * j(1, 1);
}
auto anisotropic_density() {
  return density<2, 2>("anisotropic",
                       [](const auto& J) {
                         const auto d = J(1, 1) * J(1, 1);
                         return J(0, 0) * J(0, 0) + 2.0 * (J(0, 1) * J(1, 0)) + d * d;
                       },
                       {Domain::Everywhere});
}
double symmetric_dirichlet_of(const Eigen::Matrix2d& j) {
  return j.squaredNorm() + j.inverse().squaredNorm();
}

TEST(CurvedRest, ValuesAreTheQuadratureSum) {
  for (const int dims : {2, 3})
    for (const int degree : {1, 2, 3}) {
      const Curved s(degree, dims);
      const auto sd = test::element_models(*symmetric_dirichlet()(s.space, s.rest, {s.rule}), s.x,
                                           Curvature::Exact);
      const auto other = test::element_models(
          *make_energy(s.space, s.rest, anisotropic_density(), {s.rule}), s.x, Curvature::Exact);
      for (Index e = 0; e < s.space->element_count(); ++e) {
        double sum = 0, sum_other = 0, area = 0;
        for (Index l = 0; l < s.rule.size(); ++l) {
          const auto [j, measure] = jacobian(s, e, s.rule.points.row(l));
          const double w = s.rule.weights[l] * measure;
          ASSERT_GT(measure, 0);
          area += w;
          sum += w * symmetric_dirichlet_of(j);
          sum_other += w * anisotropic(j);
        }
        const auto k = static_cast<std::size_t>(e);
        EXPECT_NEAR(s.rest.measure[e], area, 1e-13 * area);
        EXPECT_NEAR(sd.f[k], sum, 1e-12 * sum) << "degree " << degree << ", dims " << dims;
        EXPECT_NEAR(sd.values[k], sum, 1e-12 * sum);
        EXPECT_NEAR(other.f[k], sum_other, 1e-12 * (1 + std::abs(sum_other)));
      }
    }
}

// The chain rule by hand: d J(p, i) / d x(node, p) = (basis gradient * R^-1)(i).
TEST(CurvedRest, SymmetricDirichletDerivativesByTheChainRule) {
  for (const int dims : {2, 3})
    for (const int degree : {1, 2, 3}) {
      const Curved s(degree, dims);
      const auto models = test::element_models(*symmetric_dirichlet()(s.space, s.rest, {s.rule}),
                                               s.x, Curvature::Exact);
      const int n = 2 * s.space->nodes_per_element();
      for (Index e = 0; e < s.space->element_count(); e += 3) {
        Vec gradient = Vec::Zero(n);
        Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(n, n);
        for (Index l = 0; l < s.rule.size(); ++l) {
          const Barycentric xi = s.rule.points.row(l);
          const auto [j, measure] = jacobian(s, e, xi);
          const test::PointResult m = test::oracle(test::direct_symmetric_dirichlet, j);
          // J is linear in x: its derivative is J of the unit vectors.
          Eigen::MatrixXd by_x(4, n);
          Curved unit = s;
          for (int i = 0; i < n; ++i) {
            unit.x.setZero();
            unit.x[2 * s.space->cells()(e, i / 2) + i % 2] = 1;
            const Eigen::Matrix2d d = jacobian(unit, e, xi).first;
            by_x.col(i) << d(0, 0), d(0, 1), d(1, 0), d(1, 1);
          }
          gradient += s.rule.weights[l] * measure * by_x.transpose() * m.gradient;
          hessian += s.rule.weights[l] * measure * by_x.transpose() * m.hessian * by_x;
        }
        const auto k = static_cast<std::size_t>(e);
        EXPECT_LE((models.gradients[k] - gradient).norm(), 1e-12 * hessian.norm());
        EXPECT_LE((models.hessians[k] - hessian).norm(), 1e-12 * hessian.norm())
            << "degree " << degree << ", dims " << dims;
      }
    }
}

// Every energy and every model: differences, semidefiniteness.
TEST(CurvedRest, DerivativesOfEveryEnergy) {
  for (const int dims : {2, 3}) {
    const Curved s(2, dims);
    for (const NamedEnergy& energy : named_energies()) {
      const auto report =
          check_derivatives(*energy.make(s.space, s.rest, {radon_rule()}), s.x, 1e-6);
      EXPECT_TRUE(report.ok()) << energy.name << "\n" << report.message();
    }
    const auto report = check_derivatives(
        *make_energy(s.space, s.rest, anisotropic_density(), {radon_rule()}), s.x, 1e-6);
    EXPECT_TRUE(report.ok()) << report.message();
  }
}

void expect_same(const EnergyTerm& a, const EnergyTerm& b, VecIn x) {
  for (const Curvature c : kHessians) {
    if (!a.supports(c)) continue;
    const auto ma = test::element_models(a, x, c), mb = test::element_models(b, x, c);
    for (std::size_t e = 0; e < ma.f.size(); ++e) {
      const double h = ma.hessians[e].norm();
      EXPECT_NEAR(ma.f[e], mb.f[e], 1e-12 * (std::abs(ma.f[e]) + h));
      EXPECT_NEAR(ma.values[e], mb.values[e], 1e-12 * (std::abs(ma.f[e]) + h));
      EXPECT_LE((ma.gradients[e] - mb.gradients[e]).norm(), 1e-12 * h);
      EXPECT_LE((ma.hessians[e] - mb.hessians[e]).norm(), 1e-12 * h)
          << a.name() << ", model " << static_cast<int>(c);
    }
  }
}

// Flat triangles given as curved ones take another code path and have equal values.
TEST(CurvedRest, FlatShapesGivenAsCurved) {
  for (const int degree : {1, 2, 3}) {
    const Curved s(degree, 3);
    const RestShapes flat = flat_triangles(s.mesh.positions, s.mesh.faces);
    const RestShapes curved =
        curved_shapes(*s.space, lattice_positions(*s.space, s.mesh, 3), radon_rule());
    ASSERT_TRUE(curved.curved());
    EXPECT_LE((flat.measure - curved.measure).cwiseAbs().maxCoeff(), 1e-14);
    for (const NamedEnergy& energy : named_energies())
      expect_same(*energy.make(s.space, flat, {s.rule}), *energy.make(s.space, curved, {s.rule}),
                  s.x);
    expect_same(*make_energy(s.space, flat, anisotropic_density(), {s.rule}),
                *make_energy(s.space, curved, anisotropic_density(), {s.rule}), s.x);
  }
}

// The rest shape as a map is an isometry, also after a rotation.
TEST(CurvedRest, ARestShapeIsItsOwnIsometry) {
  const Curved s(3, 2);
  const Eigen::Matrix2d turn =
      test::from_parts(Vector2(std::cos(0.8), std::sin(0.8)), Vector2(0, 0));
  Vec x(2 * s.nodes.rows());
  for (Index k = 0; k < s.nodes.rows(); ++k)
    x.segment<2>(2 * k) = turn * s.nodes.row(k).transpose();
  const auto models = test::element_models(*symmetric_dirichlet()(s.space, s.rest, {s.rule}), x,
                                           Curvature::Projected);
  for (Index e = 0; e < s.space->element_count(); ++e) {
    const auto k = static_cast<std::size_t>(e);
    EXPECT_NEAR(models.f[k], 4 * s.rest.measure[e], 1e-12);
    EXPECT_LE(models.gradients[k].norm(), 1e-12);
  }
}

// A batch with different rest shapes, over several batches.
TEST(CurvedRest, ManyElements) {
  const test::Mesh mesh = test::grid(9, 8, 0.2);
  const auto space = std::make_shared<const BezierTriangleSpace>(mesh.faces, 90, 2);
  test::Random random(2);
  RowMatrix nodes = lattice_positions(*space, mesh, 2);
  for (Index k = 0; k < nodes.size(); ++k) nodes.data()[k] += random.uniform(-0.05, 0.05);
  const RestShapes rest = curved_shapes(*space, nodes, radon_rule());
  const Vec x = Eigen::Map<const Vec>(nodes.data(), nodes.size());
  const auto models = test::element_models(*symmetric_dirichlet()(space, rest, {radon_rule()}), x,
                                           Curvature::Exact);
  for (Index e = 0; e < 144; ++e)
    EXPECT_NEAR(models.f[static_cast<std::size_t>(e)], 4 * rest.measure[e], 1e-12);
}

TEST(CurvedRest, SetUpErrors) {
  const Curved s(2, 2);
  EXPECT_THROW(curved_shapes(*s.space, s.nodes.topRows(4), s.rule), InvalidArgument);
  EXPECT_THROW(curved_shapes(*s.space, s.nodes.leftCols(1), s.rule), InvalidArgument);
  RestShapes fewer = s.rest;
  fewer.nodes.conservativeResize(5, Eigen::NoChange);
  EXPECT_THROW(symmetric_dirichlet()(s.space, fewer, {s.rule}), InvalidArgument);
  RestShapes narrow = s.rest;
  narrow.nodes.conservativeResize(Eigen::NoChange, 1);
  EXPECT_THROW(symmetric_dirichlet()(s.space, narrow, {s.rule}), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
