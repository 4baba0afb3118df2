// density<M, D>: planar, of volumes, of surfaces in space.
#include <gtest/gtest.h>

#include "energies/builtin_formulas.h"
#include "energies/linear_tetrahedra.h"
#include "majorant/framework/detail/packed_symmetric.h"
#include "majorant/framework/energy_term.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

using test::PointResult;
using Jacobians = std::vector<Eigen::Matrix2d>;

// ---- Planar ----

auto general_mips() {
  return density<2, 2>("mips", [](const auto& J) { return J.squaredNorm() / J.determinant(); });
}
auto general_symmetric_dirichlet() {
  return density<2, 2>("symmetric-dirichlet",
                       [](const auto& J) { return J.squaredNorm() + J.inverse().squaredNorm(); });
}

TEST(GeneralDensity, PlanarFormsEqualTheInvariantOnes) {
  Jacobians j = test::generic_jacobians(false, 101);
  for (const double scale : {0.5, 1.0, 2.0})
    j.push_back(test::from_parts(Vector2(scale, 0), Vector2(0, 0)));
  const test::Triangles t(j.size());
  const std::vector<Quadrature> rule{lattice_rule(1)};
  const std::pair<std::shared_ptr<const EnergyTerm>, const char*> all[] = {
      {make_energy(t.space, t.rest, general_mips(), rule), "mips"},
      {make_energy(t.space, t.rest, general_symmetric_dirichlet(), rule), "symmetric-dirichlet"}};
  for (const auto& [general, name] : all) {
    const auto builtin = find_energy(name)->make(t.space, t.rest, rule);
    for (const Curvature c : kCurvatures)
      EXPECT_EQ(general->supports(c), c == Curvature::Exact || c == Curvature::Projected);
    for (const Curvature c : {Curvature::Exact, Curvature::Projected}) {
      const auto a = test::point_models(*general, j, c), b = test::point_models(*builtin, j, c);
      for (std::size_t e = 0; e < j.size(); ++e) {
        EXPECT_NEAR(a[e].value, b[e].value, 1e-13 * b[e].value);
        EXPECT_LE((a[e].gradient - b[e].gradient).norm(), 1e-12 * (1 + b[e].hessian.norm()));
        EXPECT_LE((a[e].hessian - b[e].hessian).norm(), 1e-11 * b[e].hessian.norm()) << name;
      }
    }
  }
}

// An anisotropic formula, to detect exchanged rows and columns of J or a wrong frame.
TEST(GeneralDensity, AnisotropicDerivatives) {
  const auto f = [](const auto& J) {
    return J(0, 0) * J(0, 0) + 3.0 * J(0, 1) * J(1, 1) + 0.5 * J(1, 0) * J(0, 1) * J(0, 1) +
           1.0 / (J(1, 1) * J(1, 1));
  };
  const Jacobians j = test::generic_jacobians(false, 30);
  const test::Triangles t(j.size());
  const auto term =
      make_energy(t.space, t.rest, density<2, 2>("a", f, {Domain::Everywhere}), {lattice_rule(1)});
  const auto models = test::point_models(*term, j, Curvature::Exact);
  const auto projected = test::point_models(*term, j, Curvature::Projected);
  const auto blended = test::point_models(*term, j, BlendedCurvature::projected(0.3));
  for (std::size_t e = 0; e < j.size(); ++e) {
    const double a = j[e](0, 0), b = j[e](0, 1), c = j[e](1, 0), d = j[e](1, 1);
    EXPECT_NEAR(models[e].value, a * a + 3 * b * d + 0.5 * c * b * b + 1 / (d * d),
                1e-13 * (1 + std::abs(models[e].value)));
    const test::Vector4 g(2 * a, 3 * d + c * b, 0.5 * b * b, 3 * b - 2 / (d * d * d));
    test::Matrix4 h = test::Matrix4::Zero();
    h(0, 0) = 2;
    h(1, 1) = c;
    h(1, 3) = h(3, 1) = 3;
    h(1, 2) = h(2, 1) = b;
    h(3, 3) = 6 / (d * d * d * d);
    EXPECT_LE((models[e].gradient - g).norm(), 1e-13 * g.norm());
    EXPECT_LE((models[e].hessian - h).norm(), 1e-13 * h.norm());
    const test::Matrix4 clamped = test::clamp_eigenvalues(h);
    EXPECT_LE((projected[e].hessian - clamped).norm(), 1e-12 * h.norm());
    EXPECT_LE((blended[e].hessian - 0.7 * h - 0.3 * clamped).norm(), 1e-12 * h.norm());
  }
}

TEST(GeneralDensity, DomainIsTheDeterminant) {
  const Jacobians j{test::from_parts(Vector2(0.5, 0), Vector2(1, 0)), Eigen::Matrix2d::Zero(),
                    Eigen::Matrix2d::Identity()};
  const test::Triangles t(j.size());
  const auto norm = [](const auto& J) { return J.squaredNorm(); };
  const auto barrier = make_energy(t.space, t.rest, density<2, 2>("n", norm), {lattice_rule(1)});
  const auto everywhere = make_energy(
      t.space, t.rest, density<2, 2>("n", norm, {Domain::Everywhere}), {lattice_rule(1)});
  const auto b = test::point_models(*barrier, j, Curvature::Projected);
  const auto f = test::point_models(*everywhere, j, Curvature::Projected);
  for (std::size_t e = 0; e < 3; ++e) {
    EXPECT_EQ(std::isinf(b[e].value), e < 2);
    EXPECT_NEAR(f[e].value, j[e].squaredNorm(), 1e-15);
  }
}

// ---- Volumes ----

using Jet9 = ceres::Jet<ceres::Jet<test::Real, 9>, 9>;
using Inner9 = ceres::Jet<test::Real, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

// |J|^2 + |J^-1|^2 by cofactors written out.
Jet9 volume_formula(const Jet9* a) {
  Jet9 norm = a[0] * a[0], cofactors = Jet9(Inner9(0.0L)), det = Jet9(Inner9(0.0L));
  for (int k = 1; k < 9; ++k) norm = norm + a[k] * a[k];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int p = 3 * ((i + 1) % 3), q = 3 * ((i + 2) % 3), r = (j + 1) % 3, s = (j + 2) % 3;
      const Jet9 c = a[p + r] * a[q + s] - a[p + s] * a[q + r];
      cofactors = cofactors + c * c;
      if (i == 0) det = det + a[j] * c;
    }
  return norm + cofactors / (det * det);
}

auto volume_symmetric_dirichlet() {
  return density<3, 3>("symmetric-dirichlet-3d",
                       [](const auto& J) { return J.squaredNorm() + J.inverse().squaredNorm(); });
}

// A cube corner of jittered tetrahedra around one inner node, and a random map near the identity.
struct Tetrahedra {
  Tetrahedra() {
    test::Random random(12);
    positions.resize(7, 3);
    positions << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0;
    for (int k = 0; k < 21; ++k) positions(k / 3, k % 3) += random.uniform(-0.15, 0.15);
    Cells cells(8, 4);
    for (int e = 0; e < 8; ++e) {
      const int i = e & 1, j = 2 + ((e >> 1) & 1), k = 4 + ((e >> 2) & 1);
      const bool even = (i + j + k) % 2 == 0;
      cells.row(e) << (even ? j : i), (even ? i : j), k, 6;
    }
    space = std::make_shared<const test::LinearTetrahedra>(cells, 7);
    rest = flat_simplices(positions, cells);
    x = Eigen::Map<const Vec>(positions.data(), 21);
    x += random.vector(21, -0.12, 0.12);
  }
  RowMatrix positions;
  std::shared_ptr<const test::LinearTetrahedra> space;
  RestShapes rest;
  Vec x;
};

TEST(GeneralDensity, TetrahedraMatchNestedJets) {
  const Tetrahedra t;
  EXPECT_GT(t.rest.measure.minCoeff(), 0.02);
  const auto term = make_energy(std::shared_ptr<const ElementSpace>(t.space), t.rest,
                                volume_symmetric_dirichlet(), {test::tetrahedron_centroid()});
  ASSERT_EQ(term->element_dofs().block, 3);
  const Vec rest_x = Eigen::Map<const Vec>(t.positions.data(), 21);
  for (const Curvature curvature : {Curvature::Exact, Curvature::Projected}) {
    const auto models = test::element_models(*term, t.x, curvature);
    int indefinite = 0;
    for (Index e = 0; e < 8; ++e) {
      const Eigen::Matrix3d inverse = t.space->tangents(e, rest_x).inverse();
      const Eigen::Matrix3d J = t.space->tangents(e, t.x) * inverse;
      Jet9 a[9];
      for (int k = 0; k < 9; ++k) a[k] = Jet9(Inner9(test::Real(J(k / 3, k % 3)), k), k);
      const Jet9 f = volume_formula(a);
      Vector9 g;
      Matrix9 h;
      for (int i = 0; i < 9; ++i) {
        g[i] = static_cast<double>(f.v[i].a);
        for (int k = 0; k < 9; ++k) h(i, k) = static_cast<double>(f.v[i].v[k]);
      }
      const SymmetricEigen eigen = symmetric_eigen(h);
      indefinite += eigen.values[0] < -1e-3;
      if (curvature == Curvature::Projected)
        h = eigen.vectors * eigen.values.cwiseMax(0).asDiagonal() * eigen.vectors.transpose();
      Eigen::Matrix<double, 9, 12> by_x = Eigen::Matrix<double, 9, 12>::Zero();
      for (int node = 0; node < 4; ++node)
        for (int p = 0; p < 3; ++p)
          for (int i = 0; i < 3; ++i)
            by_x(3 * p + i, 3 * node + p) =
                node > 0 ? inverse(node - 1, i) : -(inverse(0, i) + inverse(1, i) + inverse(2, i));
      const double volume = t.space->tangents(e, rest_x).determinant() / 6;
      const auto k = static_cast<std::size_t>(e);
      EXPECT_NEAR(models.f[k], volume * static_cast<double>(f.a.a), 1e-12 * models.f[k]);
      EXPECT_NEAR(models.values[k], models.f[k], 1e-14 * models.f[k]);
      const Vec gx = volume * by_x.transpose() * g;
      const Eigen::MatrixXd hx = volume * by_x.transpose() * h * by_x;
      EXPECT_LE((models.gradients[k] - gx).norm(), 1e-12 * hx.norm());
      EXPECT_LE((models.hessians[k] - hx).norm(), 1e-12 * hx.norm());
    }
    EXPECT_GT(indefinite, 0);  // otherwise the projection has no effect
  }
  const DerivativeReport report = check_derivatives(*term, t.x, 1e-6);
  EXPECT_TRUE(report.ok()) << report.message();
}

TEST(GeneralDensity, DimensionsMustFit) {
  const test::Triangles triangles(1);
  const Tetrahedra t;
  const std::shared_ptr<const ElementSpace> volume = t.space;
  const std::vector<Quadrature> planar{lattice_rule(1)}, solid{test::tetrahedron_centroid()};
  EXPECT_THROW(make_energy(triangles.space, triangles.rest, volume_symmetric_dirichlet(), planar),
               InvalidArgument);
  EXPECT_THROW(make_energy(triangles.space, t.rest, volume_symmetric_dirichlet(), planar),
               InvalidArgument);
  EXPECT_THROW(make_energy(volume, t.rest, general_mips(), solid), InvalidArgument);
  EXPECT_THROW(symmetric_dirichlet()(volume, t.rest, solid), InvalidArgument);
  EXPECT_NO_THROW(make_energy(volume, t.rest, volume_symmetric_dirichlet(), solid));
  RestShapes wrong = t.rest;
  wrong.dim = 2;
  EXPECT_THROW(make_energy(volume, wrong, volume_symmetric_dirichlet(), solid), InvalidArgument);
  RestShapes narrow = t.rest;  // 4 numbers where 9 are required
  narrow.inverse.conservativeResize(Eigen::NoChange, 4);
  EXPECT_THROW(make_energy(volume, narrow, volume_symmetric_dirichlet(), solid), InvalidArgument);
}

// ---- Surfaces in space ----

struct Membrane {
  explicit Membrane(int degree) : mesh(test::grid(3, 2, 0.2, 0.4)) {
    space = std::make_shared<const BezierTriangleSpace>(
        mesh.faces, static_cast<Index>(mesh.positions.rows()), degree);
    rest = flat_triangles(mesh.positions, mesh.faces);
    test::Random random(14);
    x = random.vector(3 * space->node_count(), -0.2, 0.2);
    for (Index e = 0; e < space->element_count(); ++e)
      for (int l = 0; l < space->nodes_per_element(); ++l) {
        const MultiIndex& m = TriangleIndices::of_degree(degree).multi(l);
        const Index node = space->cells()(e, l);
        for (int k = 0; k < 3; ++k)  // each face adds its part, for a generic surface
          x.segment<3>(3 * node) += 0.3 * m[static_cast<std::size_t>(k)] / degree *
                                    mesh.positions.row(mesh.faces(e, k)).transpose();
      }
  }
  test::Mesh mesh;
  std::shared_ptr<const BezierTriangleSpace> space;
  RestShapes rest;
  Vec x;
};

// |J|^2 on linear triangles: tr(G^-1 U) by edge vectors, Hessian 2 K (x) I with K the stiffness.
TEST(GeneralDensity, MembraneEnergyOfASurfaceInSpace) {
  const Membrane s(1);
  const auto term = make_energy(
      s.space, s.rest, density<3, 2>("membrane", [](const auto& J) { return J.squaredNorm(); }),
      {lattice_rule(1)});
  ASSERT_EQ(term->element_dofs().block, 3);
  for (const Curvature c : {Curvature::Exact, Curvature::Projected}) {
    const auto models = test::element_models(*term, s.x, c);
    for (Index f = 0; f < s.mesh.faces.rows(); ++f) {
      Eigen::Matrix<double, 3, 2> surface, image;
      Eigen::Matrix<double, 2, 3> pick;  // corner values -> edge vectors
      pick << -1, 1, 0, -1, 0, 1;
      for (int k = 0; k < 2; ++k) {
        const Index a = s.mesh.faces(f, 0), b = s.mesh.faces(f, k + 1);
        surface.col(k) = (s.mesh.positions.row(b) - s.mesh.positions.row(a)).transpose();
        image.col(k) = s.x.segment<3>(3 * b) - s.x.segment<3>(3 * a);
      }
      const Eigen::Matrix2d g = surface.transpose() * surface, u = image.transpose() * image;
      const double area = 0.5 * std::sqrt(g.determinant());
      const Eigen::Matrix3d stiffness = 2 * area * pick.transpose() * g.inverse() * pick;
      const auto e = static_cast<std::size_t>(f);
      EXPECT_NEAR(models.f[e], area * (g.inverse() * u).trace(), 1e-12 * models.f[e]);
      for (int i = 0; i < 9; ++i)
        for (int k = 0; k < 9; ++k)
          EXPECT_NEAR(models.hessians[e](i, k), i % 3 == k % 3 ? stiffness(i / 3, k / 3) : 0,
                      1e-12 * stiffness.norm());
    }
  }
}

// Green strain |J^T J - I|^2 / 4 and area, curved elements.
TEST(GeneralDensity, NonlinearSurfaceEnergies) {
  const auto strain = density<3, 2>("strain", [](const auto& J) {
    const auto C = J.transpose() * J;
    const auto a = C(0, 0) - 1.0, b = C(1, 1) - 1.0;
    return 0.25 * (a * a + b * b + 2.0 * (C(0, 1) * C(1, 0)));
  });
  const auto area = density<3, 2>("area", [](const auto& J) {
    using std::sqrt;
    return sqrt((J.transpose() * J).determinant());
  });
  for (const int degree : {1, 2, 3}) {
    const Membrane s(degree);
    for (const auto& term : std::vector<std::shared_ptr<const EnergyTerm>>{
             make_energy(s.space, s.rest, strain, {radon_rule()}),
             make_energy(s.space, s.rest, area, {radon_rule()})}) {
      const DerivativeReport report = check_derivatives(*term, s.x, 2e-6);
      EXPECT_TRUE(report.ok()) << term->name() << "\n" << report.message();
      EXPECT_GT(report.hessian_error, 0);
    }
  }
  // At an isometric embedding both are known.
  const Membrane s(1);
  const Vec same = Eigen::Map<const Vec>(s.mesh.positions.data(), s.mesh.positions.size());
  const auto term = make_energy(s.space, s.rest, area, {lattice_rule(1)});
  const auto models = test::element_models(*term, same, Curvature::Exact);
  for (Index f = 0; f < s.mesh.faces.rows(); ++f)
    EXPECT_NEAR(models.f[static_cast<std::size_t>(f)], s.rest.measure[f], 1e-14);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
