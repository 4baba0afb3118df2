// Bounds with a barrier, in parametrize(): the constrained minimum, bracketed from both sides.
#include <algorithm>

#include "expected_error.h"
#include "majorant/elements/jacobian_net.h"
#include "majorant/energies/make_energy.h"
#include "mesh/obj_file.h"
#include "parametrization/drive/parametrize_expectations.h"

namespace majorant {
namespace {

double stretch_of(const ParametrizationResult& r) {
  const BezierMap& map = *r.map;
  const RestShapes rest = flat_triangles(map.mesh().positions(), map.mesh().faces());
  return largest_stretch(jacobian_net(map.space(), rest), map.control_points()).maxCoeff();
}

// sigma_max < bound at all Bernstein coefficients of J.
class StretchBound final : public BarrierChecker {
 public:
  StretchBound(JacobianNet net, double bound) : net_(std::move(net)), bound_(bound) {}
  std::string_view name() const override { return "largest stretch"; }
  Verdict check(VecIn x) const override {
    Verdict verdict;
    verdict.margin = bound_ - largest_stretch(net_, x).maxCoeff();
    verdict.feasible = verdict.margin > 0;
    return verdict;
  }
  StepBound max_step(VecIn, VecIn, double s) const override { return {s, {}}; }
  std::shared_ptr<const EnergyTerm> barrier() const override {
    const auto wall = [b = bound_ * bound_](const auto& J) {
      return -log(b * b - b * J.squaredNorm() + J.determinant() * J.determinant());
    };
    const Traits everywhere{.domain = Domain::Everywhere};
    return make_energy(net_.triangles, net_.rest, density<2, 2>("stretch", wall, everywhere),
                       {lattice_rule(1)});
  }
  std::shared_ptr<const BarrierChecker> relaxed(VecIn x) const override {
    const double stretch = largest_stretch(net_, x).maxCoeff();
    return std::make_shared<const StretchBound>(net_, std::max(bound_, 1.1 * stretch));
  }

 private:
  JacobianNet net_;
  double bound_;
};

MapExtender bounded(double bound) {
  return [bound](MapExtension& map) {
    map.add(std::make_shared<const StretchBound>(jacobian_net(map.space(), map.rest()), bound));
  };
}

// What exceeds the bound, squared, weighs so much: the minimum of the sum is below the constrained
// one, since the constrained minimum costs nothing here.
MapExtender penalized(double bound, double weight) {
  return [=](MapExtension& map) {
    const JacobianNet net = jacobian_net(map.space(), map.rest());
    const auto excess = [bound](auto S, auto s) {
      const auto square = [bound](auto t) {
        const auto over = t - bound;
        const auto positive = 0.5 * (over + sqrt(over * over + 1e-20));
        return positive * positive;
      };
      return square(S) + square(s);
    };
    map.add(make_energy(net.triangles, net.rest, spectral("excess", excess), {lattice_rule(1)}),
            weight / net.rest.measure.sum());
  };
}

TEST(Bounds, TheConstrainedMinimumIsBracketed) {
  for (const int n : {1, 2, 3}) {
    const auto mesh = generated("cap");
    ParametrizationOptions options = degree(n);
    const ParametrizationResult free = parametrize(mesh, options);
    const double bound = stretch_of(free) / 1.2;
    options.extend = bounded(bound);
    RunRecord record;
    const ParametrizationResult inside = parametrize(mesh, options, record);
    EXPECT_EQ(inside.status, Status::Converged) << inside.message;
    expect_valid(inside, n);
    ASSERT_EQ(inside.checks.size(), 1u);
    EXPECT_TRUE(inside.checks[0].verdict.feasible);
    EXPECT_LT(stretch_of(inside), bound);
    EXPECT_GT(stretch_of(inside), 0.99 * bound);
    EXPECT_TRUE(std::any_of(record.trace().begin(), record.trace().end(),
                            [](const auto& row) { return row.phase == Phase::Barrier; }));
    options.extend = penalized(bound, 1e6);
    const ParametrizationResult below = parametrize(mesh, options);
    EXPECT_EQ(below.status, Status::Converged) << below.message;
    EXPECT_GT(inside.value_quadrature, free.value_quadrature * (1 + 1e-3));
    EXPECT_GE(inside.value_quadrature, below.value_quadrature * (1 - 1e-7)) << "degree " << n;
    EXPECT_LE(inside.value_quadrature, below.value_quadrature * (1 + 1e-4)) << "degree " << n;
  }
}

// What the free minimum meets costs nothing, not even a barrier.
TEST(Bounds, WideBoundsChangeNothing) {
  const auto mesh = generated("cap");
  ParametrizationOptions options = degree(2);
  const ParametrizationResult free = parametrize(mesh, options);
  options.extend = bounded(1.01 * stretch_of(free));
  RunRecord record;
  const ParametrizationResult inside = parametrize(mesh, options, record);
  EXPECT_EQ(inside.status, Status::Converged);
  EXPECT_TRUE(inside.checks[0].verdict.feasible);
  EXPECT_NEAR(inside.measures.value, free.measures.value, 1e-6 * free.measures.value);
  for (const TraceEntry& row : record.trace()) EXPECT_NE(row.phase, Phase::Barrier);
}

TEST(Bounds, HoldWithAScaffold) {
  const auto mesh = generated("cap");
  ParametrizationOptions options = degree(2);
  options.map.injectivity = MapInjectivity::Global;
  const ParametrizationResult free = parametrize(mesh, options);
  const double bound = stretch_of(free) / 1.1;
  options.extend = bounded(bound);
  const ParametrizationResult inside = parametrize(mesh, options);
  EXPECT_EQ(inside.status, Status::Converged) << inside.message;
  expect_valid(inside, 2);
  EXPECT_LT(stretch_of(inside), bound);
  EXPECT_TRUE(inside.checks[0].verdict.feasible);
}

// A fixed boundary as wide as the surface leaves no map that is shrunk everywhere.
TEST(Bounds, WhatCannotBeMetIsInfeasible) {
  const auto mesh = surface(grid(6, bumpy));
  ParametrizationOptions options = degree(1);
  options.map.boundary = BoundaryCondition::Fixed;
  Vec flat(2 * mesh->vertex_count());
  for (Index v = 0; v < mesh->vertex_count(); ++v)
    flat.segment<2>(2 * v) = mesh->positions().row(v).head<2>();
  options.map.initial = flat;
  options.extend = bounded(0.5);
  const ParametrizationResult result = parametrize(mesh, options);
  EXPECT_EQ(result.status, Status::Infeasible);
  expect_contains(result.message, {"largest stretch"});
  EXPECT_FALSE(result.checks[0].verdict.feasible);
  expect_valid(result, 1);
}

TEST(Bounds, BarriersNeedTheCurvatureAskedFor) {
  ParametrizationOptions options = degree(1);
  options.solve.curvature = Curvature::Majorizer;
  options.extend = bounded(2);
  expect_contains(error_message(ErrorKind::Usage, [&] { parametrize(generated("cap"), options); }),
                  {"'stretch'", "majorizer"});
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
