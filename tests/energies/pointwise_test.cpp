// Formulas called point by point have the results of the kernels compiled for them: every curvature
// model, every number of elements in the last batch, curved rest shapes, stars.
#include <gtest/gtest.h>

#include "energies/density_fixture.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/energies/spectral.h"
#include "majorant/framework/error.h"

namespace majorant {
namespace {

using Jacobians = std::vector<Eigen::Matrix2d>;

Jacobians well_conditioned() {
  Jacobians all;
  for (const Eigen::Matrix2d& j : test::injective_jacobians())
    if (test::norm_alpha(j) > 0.2 && test::norm_alpha(j) < 5 && test::cancellation(j) < 100)
      all.push_back(j);
  return all;
}

constexpr Domain kInside = Domain::PositiveDeterminant;
constexpr Convexity kUnknown = Convexity::Unknown;

auto mips_again() {
  return invariant(
      "mips", [](const auto& x, const auto& y) { return 2.0 * ((x + y) / (x - y)); },
      {kInside, kUnknown, Reweighting::Refused, Barrier::Weak, FreeScale::Arbitrary},
      [](const auto& x, const auto& y) { return 4.0 * ((x + y) / ((x - y) * (x - y))); });
}

auto symmetric_dirichlet_again() {
  return invariant("symmetric-dirichlet",
                   [](const auto& x, const auto& y) {
                     const auto det = x - y;
                     return 2.0 * ((x + y) * (1.0 + 1.0 / (det * det)));
                   },
                   {kInside, Convexity::Convex, Reweighting::Separable, Barrier::Strong});
}

// Returns formulas of the built-in energies, which are called point by point instead of through
// compiled kernels. densities/ is not included, so that changes there do not recompile this file.
auto formulas() {
  return std::tuple{
      symmetric_dirichlet_again(),
      mips_again(),
      invariant("asap", [](const auto&, const auto& y) { return 4.0 * y; },
                {Domain::Everywhere, Convexity::Convex, Reweighting::Refused, Barrier::None,
                 FreeScale::Collapses}),
      invariant("arap",
                [](const auto& x, const auto& y) {
                  using std::sqrt;
                  return 2.0 * (x + y) - 4.0 * sqrt(x) + 2.0;
                },
                {Domain::Everywhere, Convexity::Convex, Reweighting::Separable}),
      invariant("symmetric-arap",
                [](const auto& x, const auto& y) {
                  using std::sqrt;
                  const auto det = x - y;
                  return 2.0 * ((x + y) * (1.0 + 1.0 / (det * det))) -
                         4.0 * (sqrt(x) * (1.0 + 1.0 / det)) + 4.0;
                },
                {kInside, Convexity::Convex, Reweighting::Separable}),
      spectral("log-isometric",
               [](const auto& S, const auto& s) {
                 using std::log;
                 return log(S) * log(S) + log(s) * log(s);
               },
               {kInside, kUnknown, Reweighting::Separable}),
      invariant("authalic",
                [](const auto& x, const auto& y) {
                  const auto det = x - y;
                  return det + 1.0 / det;
                },
                {kInside, kUnknown, Reweighting::Refused}),
      invariant("amips-exponential",
                [](const auto& x, const auto& y) {
                  using std::exp;
                  const auto det = x - y;
                  return exp(5.0 * (0.25 * (2.0 * ((x + y) / det) + det + 1.0 / det) - 1.0));
                },
                {kInside, kUnknown, Reweighting::Refused})};
}

template <class Density>
void expect_same_models(const Density& density) {
  SCOPED_TRACE(density.name());
  const Jacobians j = well_conditioned();
  const test::Triangles t(j.size());
  const std::vector<Quadrature> rule{lattice_rule(1)};
  const NamedEnergy* builtin = find_energy(density.name());
  ASSERT_NE(builtin, nullptr);
  const auto points = make_energy(t.space, t.rest, density, rule);
  const auto batches = builtin->make(t.space, t.rest, rule);
  std::vector<BlendedCurvature> models{BlendedCurvature::projected(0.4)};
  for (const Curvature c : kCurvatures) {
    EXPECT_EQ(points->supports(c), batches->supports(c));
    if (points->supports(c)) models.push_back(c);
  }
  for (const BlendedCurvature c : models) {
    const auto a = test::point_models(*points, j, c), b = test::point_models(*batches, j, c);
    for (std::size_t e = 0; e < j.size(); ++e) {
      EXPECT_NEAR(a[e].value, b[e].value, 1e-12 * std::abs(b[e].value) + 1e-13)
          << test::describe(j[e]);
      EXPECT_LE((a[e].gradient - b[e].gradient).norm(), 1e-10 * (1 + b[e].hessian.norm()));
      EXPECT_LE((a[e].hessian - b[e].hessian).norm(), 1e-9 * b[e].hessian.norm())
          << test::describe(j[e]) << " model " << static_cast<int>(c.model);
    }
  }
}

TEST(Pointwise, BuiltInFormulasHaveTheSameModels) {
  std::apply([](const auto&... density) { (expect_same_models(density), ...); }, formulas());
  EXPECT_EQ(std::tuple_size_v<decltype(formulas())>, named_energies().size());
}

// Every remainder of every batch width.
TEST(Pointwise, AnyNumberOfElements) {
  const Jacobians all = well_conditioned();
  const auto density = mips_again();
  const std::vector<Quadrature> rule{lattice_rule(1)};
  for (std::size_t count = 1; count < 20; ++count) {
    const Jacobians j(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    const test::Triangles t(count);
    const auto a =
        test::point_models(*make_energy(t.space, t.rest, density, rule), j, Curvature::Projected);
    for (std::size_t e = 0; e < count; ++e)
      EXPECT_NEAR(a[e].value, 2 * (j[e].squaredNorm() / 2) / j[e].determinant(), 1e-12);
  }
}

TEST(Pointwise, OutsideTheDomainIsInfinite) {
  Jacobians j = well_conditioned();
  j.resize(9);
  j[4] = test::from_parts(Vector2(0.5, 0), Vector2(1, 0));  // det < 0
  const test::Triangles t(j.size());
  const auto term = make_energy(t.space, t.rest, mips_again(), {lattice_rule(1)});
  for (const auto& models : {test::point_models(*term, j, Curvature::Projected)})
    for (std::size_t e = 0; e < j.size(); ++e) EXPECT_EQ(std::isinf(models[e].value), e == 4);
}

// A star by kernels of the built-in energy, and by the same formula called point by point.
TEST(Pointwise, StarsAreThoseOfTheBuiltInEnergy) {
  const test::Triangles t(1);
  const auto mine = make_energy(t.space, t.rest, symmetric_dirichlet_again(), {lattice_rule(1)});
  const auto general = make_energy(
      t.space, t.rest,
      density<2, 2>("general",
                    [](const auto& J) { return J.squaredNorm() + J.inverse().squaredNorm(); }),
      {lattice_rule(1)});
  const auto builtin = symmetric_dirichlet()(t.space, t.rest, {lattice_rule(1)});
  constexpr int kCount = 5, stride = StarView::stride;
  std::vector<double> rows(StarView::Rows * stride);
  for (int p = 0; p < 8; ++p) {
    const int k = std::min(p, kCount - 1);
    const double a = 2 * std::numbers::pi * k / kCount, b = 2 * std::numbers::pi * (k + 1) / kCount;
    const double numbers[] = {
        1,           0,           0.2,         1.1,        p < kCount ? 0.3 + 0.1 * k : 0.0,
        std::cos(a), std::sin(a), std::cos(b), std::sin(b)};
    for (int r = 0; r < StarView::Rows; ++r) rows[r * stride + p] = numbers[r];
  }
  const StarView view{kCount, rows.data()};
  const StarModel expected = builtin->star(view, Vector2(0.1, -0.05));
  for (const auto& term : {mine, general}) {
    const StarModel m = term->star(view, Vector2(0.1, -0.05));
    EXPECT_NEAR(m.f, expected.f, 1e-11 * expected.f);
    EXPECT_NEAR(m.gx, expected.gx, 1e-9 * expected.f);
    EXPECT_NEAR(m.hxy, expected.hxy, 1e-9 * expected.f);
    EXPECT_NEAR(m.hyy, expected.hyy, 1e-9 * expected.f);
    EXPECT_NEAR(m.area_margin, expected.area_margin, 1e-14);
  }
}

// Without a Hessian no eigenvalues are computed, and the gradient has the same bits.
TEST(Pointwise, GradientsDoNotDependOnTheHessian) {
  const Jacobians j = well_conditioned();
  const test::Triangles t(j.size());
  const auto term = make_energy(t.space, t.rest,
                                density<2, 2>("squared",
                                              [](const auto& J) {
                                                const auto n = J.squaredNorm();
                                                return n * n - 3.0 * J.trace() * J.trace();
                                              }),
                                {lattice_rule(1)});
  const Vec x = test::corners_of(j);
  const auto models = test::element_models(*term, x, Curvature::Projected);
  std::vector<Index> one{3};
  Workspace workspace, memory;
  LocalSystem local;
  local.value = memory.reserve(7 * LocalSystem::stride);
  local.gradient = local.value + LocalSystem::stride;
  term->local(x, {0, one}, Curvature::Projected, {}, workspace, local);
  EXPECT_EQ(local.value[0], models.f[3]);
  for (Index i = 0; i < 6; ++i)
    EXPECT_EQ(local.gradient[to_size(i) * LocalSystem::stride], models.gradients[3][i]);
}

TEST(Pointwise, JacobiansOfOtherSizesHaveNoKernels) {
  EXPECT_THROW(jacobian_kernels(0, 2), InvalidArgument);
  EXPECT_THROW(jacobian_kernels(2, 4), InvalidArgument);
  for (int rows = 1; rows <= 3; ++rows)
    for (int dims = 1; dims <= 3; ++dims) {
      EXPECT_EQ(jacobian_kernels(rows, dims).rows, rows);
      EXPECT_EQ(jacobian_kernels(rows, dims).dims, dims);
    }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
