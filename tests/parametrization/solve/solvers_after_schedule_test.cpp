// docs/choosing_a_solver.md on a caller's methods and energies: from the start of parametrize()'s
// schedule, they reach the same minimum.
#include "majorant/energies/make_energy.h"
#include "majorant/framework/ceres_minimizer.h"
#include "majorant/framework/first_order.h"
#include "majorant/framework/newton.h"
#include "majorant/io/read_mesh.h"
#include "majorant/maps/rest_shapes_of.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

TEST(SolversAfterSchedule, AgreeOnAQuarticEnergy) {
  const auto mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(
      read_mesh(std::string(MAJORANT_SOURCE_DIR) + "/examples/meshes/creature.obj")));
  const auto quartic = spectral("quartic", [](auto S, auto s) {
    return S * S * S * S + s * s * s * s + 2.0 / (S * S * s * s);
  });
  ParametrizationOptions options = degree(1);
  options.map.energy = {{energy_factory(quartic), 1.0}};
  const ParametrizationResult first = parametrize(mesh, options);
  ASSERT_EQ(first.status, Status::Converged) << first.message;
  const BezierMap start = first.map->elevated();
  MapSpecification spec(options.map);
  spec.rest = std::make_shared<const RestShapes>(rest_shapes(*mesh));
  const auto injectivity =
      std::make_shared<const LocalInjectivity>(start.shared_space(), 2 * spec.rest->measure);
  const Quadrature rule = guarded_rule(composite_rule(radon_rule(), 2), 1, 1e-3);
  const DensityTerms terms = energy_terms(spec, start.shared_space(), {rule});
  const Vec& x = start.control_points();
  const Problem problem = map_problem(spec, start.shared_space(), x, terms, injectivity).problem;
  NewtonOptions exact;
  exact.curvature = Curvature::Exact;
  const double newton = 9.292128219;
  const auto expect = [&](const char* name, const Minimizer& method, double tolerance) {
    const SolveResult r = method.minimize(problem, problem.reduce(x), {});
    EXPECT_EQ(r.status, Status::Converged) << name << ": " << r.message;
    EXPECT_NEAR(r.energy, newton, tolerance * newton) << name;
  };
  expect("newton", NewtonMinimizer(), 1e-8);
  expect("newton-exact", NewtonMinimizer(exact), 1e-9);
  expect("lbfgs-hessian", LbfgsMinimizer(), 1e-9);
  MapSpecification laplacian = spec;
  laplacian.energy = {{energy_factory(
      invariant("dirichlet", [](const auto& p, const auto& q) { return 2.0 * (p + q); },
                {Domain::Everywhere, Convexity::Convex}))}};
  LbfgsOptions with_metric;
  with_metric.metric =
      map_problem(laplacian, start.shared_space(), x,
                  energy_terms(laplacian, start.shared_space(), {rule}), injectivity)
          .problem;
  expect("lbfgs", LbfgsMinimizer(with_metric), 1e-9);
  expect("ceres-lbfgs", CeresMinimizer({.function_tolerance = 1e-10}), 1e-4);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
