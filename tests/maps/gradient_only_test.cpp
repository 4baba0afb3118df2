// A term without space for Hessians gives the same bits of values and gradients.
#include <gtest/gtest.h>

#include <cstring>

#include "energies/density_fixture.h"
#include "majorant/constraints/constraints.h"
#include "majorant/framework/terms/quadratic_penalty.h"

namespace majorant {
namespace {

constexpr std::size_t kStride = LocalSystem::stride;

// Returns values and gradients of the first elements of a term, and checks that nothing is written
// outside the requested part of the Hessian.
std::vector<double> first_order(const EnergyTerm& term, VecIn x, Curvature c, bool with_hessian) {
  const auto n = static_cast<std::size_t>(term.element_dofs().local_size());
  const auto count = std::min<std::size_t>(
      ElementBatch::kMaxSize, static_cast<std::size_t>(term.element_dofs().element_count()));
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), 0);
  Workspace kernel, memory;
  LocalSystem local;
  const std::size_t order1 = (1 + n) * kStride, order2 = n * (n + 1) / 2 * kStride;
  local.value = memory.reserve(order1 + order2);
  std::fill_n(local.value, order1 + order2, -7.0);
  local.gradient = local.value + kStride;
  local.hessian = with_hessian ? local.gradient + n * kStride : nullptr;
  term.local(x, ElementBatch{0, all}, c, {}, kernel, local);
  if (!with_hessian) {
    EXPECT_TRUE(std::all_of(local.value + order1, local.value + order1 + order2,
                            [](double v) { return v == -7.0; }));
  }
  std::vector<double> out;
  for (std::size_t k = 0; k <= n; ++k)
    out.insert(out.end(), local.value + k * kStride, local.value + k * kStride + count);
  return out;
}

void expect_bitwise(const EnergyTerm& term, VecIn x) {
  for (const Curvature c : kCurvatures) {
    if (!term.supports(c)) continue;
    const auto with = first_order(term, x, c, true), without = first_order(term, x, c, false);
    ASSERT_EQ(with.size(), without.size());
    for (const double v : with) ASSERT_TRUE(std::isfinite(v));
    std::size_t different = 0;
    double worst = 0;
    for (std::size_t k = 0; k < with.size(); ++k) {
      different += std::memcmp(&with[k], &without[k], sizeof(double)) != 0;
      worst = std::max(worst, std::abs(with[k] - without[k]));
    }
    EXPECT_EQ(different, 0U) << term.name() << ", model " << static_cast<int>(c) << ": of "
                             << with.size() << ", by " << worst;
  }
}

struct Maps {
  explicit Maps(int degree, bool curved) : mesh(test::grid(5, 4, 0.2, 0.3)) {
    space = std::make_shared<const BezierTriangleSpace>(
        mesh.faces, static_cast<Index>(mesh.positions.rows()), degree);
    test::Random random(4);
    x = test::linear_map(*space, test::flat(mesh.positions));
    if (curved) {
      const Vec nodes = x + random.vector(x.size(), -0.05, 0.05) / degree;
      rest = curved_shapes(*space, Eigen::Map<const RowMatrix>(nodes.data(), x.size() / 2, 2),
                           radon_rule());
    } else {
      rest = flat_triangles(mesh.positions, mesh.faces);
    }
    x += random.vector(x.size(), -0.1, 0.1) / degree;
  }
  test::Mesh mesh;
  std::shared_ptr<const BezierTriangleSpace> space;
  RestShapes rest;
  Vec x;
};

TEST(GradientOnly, EveryEnergy) {
  for (const int degree : {1, 2, 3})
    for (const bool curved : {false, true}) {
      SCOPED_TRACE(testing::Message() << "degree " << degree << ", curved " << curved);
      const Maps m(degree, curved);
      for (const NamedEnergy& energy : named_energies())
        expect_bitwise(*energy.make(m.space, m.rest, {radon_rule()}), m.x);
    }
}

// Kernels compiled for the instruction set of this file.
TEST(GradientOnly, CustomDensities) {
  const Maps m(2, false);
  const std::vector<Quadrature> rule{radon_rule()};
  expect_bitwise(*make_energy(m.space, m.rest, test::spectral_symmetric_dirichlet(), rule), m.x);
  expect_bitwise(*test::baseline("symmetric-arap")(m.space, m.rest, rule), m.x);
  const auto general = density<2, 2>("general", [](const auto& J) {
    return J.squaredNorm() + J.inverse().squaredNorm() + 0.1 * J(0, 1);
  });
  expect_bitwise(*make_energy(m.space, m.rest, general, rule), m.x);
}

TEST(GradientOnly, QuadraticPenalty) {
  const Maps m(2, false);
  std::vector<FixedPoint> points;
  for (Index k = 0; k < 30; ++k) points.push_back({k, Vector2(0.1 * k, 1 - 0.3 * k)});
  expect_bitwise(QuadraticPenalty(FixedPoints(points)), m.x);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
