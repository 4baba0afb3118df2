// Bounds with a barrier in parametrize(): the constrained minimum, with lower and upper limits.
#include <algorithm>
#include <vector>

#include "../examples/stretch_bound.h"
#include "expected_error.h"
#include "majorant/energies/make_energy.h"
#include "majorant/framework/terms/inequality.h"
#include "majorant/parametrization/solve/parametrize_by.h"
#include "mesh/obj_file.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

double stretch_of(const ParametrizationResult& r) {
  const BezierMap& map = *r.map;
  const RestShapes rest = flat_triangles(map.mesh().positions(), map.mesh().faces());
  return largest_stretch(jacobian_net(map.space(), rest), map.control_points()).maxCoeff();
}

MapExtender bounded(double bound) {
  return [bound](MapExtension& map) {
    map.add(std::make_shared<const StretchBound>(jacobian_net(map.space(), map.rest()), bound));
  };
}

// Adds the squared violation of the bound with this weight. The minimum of the sum is below the
// constrained minimum, at which the added term is 0.
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

// Bounds of framework/terms/, on single unknowns and on functions of some: a square that is too
// small for the map.
TEST(Bounds, BoundsOfTermsHold) {
  const auto mesh = generated("cap");
  const ParametrizationResult free = parametrize(mesh, degree(2));
  const auto reach = [](const BezierMap& map) {
    return map.control_points().cwiseAbs().maxCoeff();
  };
  const Vec& x = free.map->control_points();
  const double size =
      x(Eigen::seq(0, Eigen::last, 2)).maxCoeff() - x(Eigen::seq(0, Eigen::last, 2)).minCoeff();
  const double limit = 0.45 * size;
  const MapExtender extenders[] = {
      [&](MapExtension& map) {
        const Vec most = Vec::Constant(map.start().size(), limit * map.scale());
        map.add(Bounds(-most, most).checker());
      },
      [&](MapExtension& map) {
        Cells each(map.start().size(), 1);
        for (Index k = 0; k < each.rows(); ++k) each(k, 0) = k;
        for (const double side : {1.0, -1.0}) {
          const auto room = [side, most = limit * map.scale()](Index, const auto& z) {
            return most - side * z[0];
          };
          map.add(inequality<1>("inside", each, room).checker());
        }
      }};
  std::vector<double> energies;
  for (const MapExtender& extend : extenders) {
    ParametrizationOptions options = degree(2);
    options.extend = extend;
    const ParametrizationResult held = parametrize(mesh, options);
    EXPECT_EQ(held.status, Status::Converged) << held.message;
    expect_valid(held, 2);
    EXPECT_LT(reach(*held.map), limit);
    EXPECT_GT(reach(*held.map), 0.999 * limit);
    EXPECT_GT(held.value_quadrature, free.value_quadrature * (1 + 1e-4));
    energies.push_back(held.value_quadrature);
  }
  EXPECT_NEAR(energies[0], energies[1], 1e-5 * energies[0]);
}

// For bounds that measure their violation, the start is the minimum of the violation instead of a
// sequence of relaxed bounds. The square is much too small for the map.
TEST(Bounds, ViolationsLeadInside) {
  const auto mesh = generated("cap");
  ParametrizationOptions options = degree(2);
  const Vec x = parametrize(mesh, options).map->control_points();
  const auto u = x(Eigen::seq(0, Eigen::last, 2));
  const double limit = 0.35 * (u.maxCoeff() - u.minCoeff());
  options.extend = [&](MapExtension& map) {
    const Vec most = Vec::Constant(map.start().size(), limit * map.scale());
    map.add(Bounds(-most, most).checker());
  };
  RunRecord record;
  const ParametrizationResult held = parametrize(mesh, options, record);
  EXPECT_EQ(held.status, Status::Converged) << held.message;
  expect_valid(held, 2);
  EXPECT_TRUE(held.checks[0].verdict.feasible);
  EXPECT_LT(std::count_if(record.trace().begin(), record.trace().end(),
                          [](const auto& row) { return row.phase == Phase::Barrier; }),
            70);
}

// Bounds that the free minimum satisfies change nothing and need no barrier.
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

// A remaining effect of the barrier is reported, and the status is not Converged.
TEST(Bounds, BarriersThatDoNotVanishAreReported) {
  const auto mesh = generated("cap");
  ParametrizationOptions options = degree(1);
  options.extend = bounded(stretch_of(parametrize(mesh, options)) / 1.2);
  SolverRules rules;
  rules.bounds.weights.fall = 0.97;
  RunRecord record;
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options.map));
  const ParametrizationResult result = parametrize_by(rules, start, options, record);
  EXPECT_EQ(result.status, Status::Stalled);
  expect_contains(result.message, {"inside the bounds", "40 weights"});
  EXPECT_TRUE(result.checks[0].verdict.feasible);
}

// A fixed boundary as wide as the surface leaves no map that is compressed everywhere.
TEST(Bounds, UnreachableBoundsAreInfeasible) {
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

TEST(Bounds, BarriersNeedTheRequestedCurvature) {
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
