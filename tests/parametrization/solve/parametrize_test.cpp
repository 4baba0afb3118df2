// Whole runs: convergence, fixed boundaries, options that must not change the result, few unknowns.
#include <map>

#include "expected_error.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/energies/make_energy.h"
#include "majorant/parametrization/initialization/start.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

class GeneratedMesh : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, GeneratedMesh,
                         testing::Values("cap", "creature", "ribbon", "tube", "wavy_disk"));

TEST_P(GeneratedMesh, ConvergesAndHigherDegreesAreNotWorse) {
  const auto mesh = generated(GetParam());
  std::map<int, double> value;
  for (int n = 1; n <= 3; ++n) {
    RunRecord record;
    const ParametrizationResult result = parametrize(mesh, degree(n), record);
    EXPECT_EQ(result.status, Status::Converged) << n << ": " << result.message;
    expect_valid(result, n);
    value[n] = result.measures.value;
    EXPECT_LT(value[n], result.initial_value);
    EXPECT_NEAR(result.value_quadrature, value[n], 5e-3 * value[n]);
    EXPECT_LT(result.newton_decrement, 1e-4);
    ASSERT_FALSE(record.trace().empty());
    for (std::size_t k = 0; k < record.trace().size(); ++k) {
      EXPECT_EQ(record.trace()[k].record.iteration, static_cast<int>(k) + 1);
      EXPECT_EQ(record.trace()[k].record.step > 0,
                record.trace()[k].outcome == StepResult::Outcome::Moved);
      if (k > 0) {
        EXPECT_GE(record.trace()[k].degree, record.trace()[k - 1].degree);
      }
    }
    EXPECT_EQ(record.trace().back().degree, n);
  }
  EXPECT_LE(value[2], value[1] * (1 + 1e-6));
  EXPECT_LE(value[3], value[2] * 1.001);
}

TEST_P(GeneratedMesh, FixedBoundaryStaysWhereTutteHasIt) {
  const auto mesh = generated(GetParam());
  const Vec start = tutte_map(*mesh);
  const bool quick = mesh->face_count() == 486;  // cap and wavy_disk
  const double free = parametrize(mesh, degree(1)).measures.value;
  for (const int n : quick ? std::vector<int>{1, 2, 3} : std::vector<int>{1}) {
    ParametrizationOptions options = degree(n);
    options.map.boundary = BoundaryCondition::Fixed;
    const ParametrizationResult result = parametrize(mesh, options);
    EXPECT_EQ(result.status, Status::Converged) << n << ": " << result.message;
    expect_valid(result, n);
    expect_boundary_fixed(result, start);
    EXPECT_LT(result.measures.value, result.initial_value);
    if (n == 1) {
      EXPECT_GT(result.measures.value, free);
    }
  }
}

TEST_P(GeneratedMesh, DirectElevationReachesTheSame) {
  const auto mesh = generated(GetParam());
  ParametrizationOptions options = degree(3);
  const double incremental = parametrize(mesh, options).measures.value;
  options.solve.elevation = Elevation::Direct;
  RunRecord record;
  const ParametrizationResult direct = parametrize(mesh, options, record);
  expect_valid(direct, 3);
  EXPECT_EQ(direct.status, Status::Converged) << direct.message;
  EXPECT_NEAR(direct.measures.value, incremental, 0.01 * incremental);
  for (const TraceEntry& entry : record.trace()) EXPECT_EQ(entry.degree, 3);
}

TEST(Parametrize, HigherDegreesConverge) {
  const auto mesh = generated("tube");
  double last = parametrize(mesh, degree(3)).measures.value;
  for (const int n : {4, 5}) {
    const ParametrizationResult result = parametrize(mesh, degree(n));
    EXPECT_EQ(result.status, Status::Converged) << n << ": " << result.message;
    expect_valid(result, n);
    EXPECT_LE(result.measures.value, last * 1.001) << n;
    last = result.measures.value;
  }
}

TEST(Parametrize, EveryCurvatureReachesTheSameEnergy) {
  for (const char* name : {"cap", "wavy_disk", "tube"})
    for (const int n : {1, 2}) {
      ParametrizationOptions options = degree(n);
      options.solve.tolerance = 1e-8;
      const double expected = parametrize(generated(name), options).measures.value;
      for (const Curvature curvature :
           {Curvature::Majorizer, Curvature::CompositeMajorizer, Curvature::Exact}) {
        options.solve.curvature = curvature;
        const ParametrizationResult result = parametrize(generated(name), options);
        EXPECT_EQ(result.status, Status::Converged) << name << ' ' << static_cast<int>(curvature);
        expect_valid(result, n);
        EXPECT_NEAR(result.measures.value, expected, 1e-4 * expected)
            << name << ", degree " << n << ", curvature " << static_cast<int>(curvature);
      }
    }
}

TEST(Parametrize, RefusesACurvatureTheEnergyDoesNotHave) {
  ParametrizationOptions options = degree(2);
  // The energy declares no properties: no majorizer, no reweighting.
  options.map.energy = {
      {energy_factory(spectral("test-mips", [](auto S, auto s) { return S / s + s / S; }))}};
  for (const Curvature curvature :
       {Curvature::Majorizer, Curvature::CompositeMajorizer, Curvature::Reweighted}) {
    options.solve.curvature = curvature;
    expect_contains(
        error_message(ErrorKind::Usage, [&] { parametrize(surface(grid(3, bumpy)), options); }),
        {"test-mips", "curvature"});
  }
}

TEST(Parametrize, RefusesOptionsOutOfRange) {
  const auto mesh = surface(grid(2));
  for (const int n : {-1, 0, 9, 1000}) {
    const std::string message =
        error_message(ErrorKind::Usage, [&] { parametrize(mesh, degree(n)); });
    expect_contains(message, {"degree", std::to_string(n)});
  }
  ParametrizationOptions options;
  for (const double tolerance : {0.0, -1.0, double(NAN)}) {
    options.solve.tolerance = tolerance;
    error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
  }
  options = {};
  options.solve.quadrature_points = -1;
  error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
}

TEST(Parametrize, RefusesSurfacesThatAreNoDisks) {
  error_message(ErrorKind::Unsupported, [&] { parametrize(surface(torus(8, 6, 1)), degree(1)); });
}

// ---- Meshes with few unknowns, or none ----

const PolygonMesh kTriangle = polygon_mesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 1}}, {{0, 1, 2}});

TEST(Parametrize, ASingleTriangleWithFixedBoundaryHasNoUnknowns) {
  ParametrizationOptions options = degree(1);
  options.map.boundary = BoundaryCondition::Fixed;
  RunRecord record;
  const ParametrizationResult result = parametrize(surface(kTriangle), options, record);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_EQ(result.variables, 0);
  EXPECT_TRUE(record.trace().empty());
  EXPECT_EQ(result.measures.value, result.initial_value);
  EXPECT_EQ(result.map->control_points(), tutte_map(*surface(kTriangle)));
}

TEST(Parametrize, ASingleCubicTriangleWithFixedBoundaryHasOnePoint) {
  ParametrizationOptions options = degree(3);
  options.map.boundary = BoundaryCondition::Fixed;
  const ParametrizationResult result = parametrize(surface(kTriangle), options);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  EXPECT_EQ(result.variables, 2);
  expect_valid(result, 3);
  expect_boundary_fixed(result, tutte_map(*surface(kTriangle)));
  EXPECT_LE(result.measures.value, result.initial_value * (1 + 1e-9));
}

TEST(Parametrize, ASingleFreeTriangleBecomesIsometric) {
  for (const int n : {1, 2, 3, 8}) {
    const ParametrizationResult result = parametrize(surface(kTriangle), degree(n));
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    EXPECT_NEAR(result.measures.value, 4, 1e-9) << n;
  }
}

TEST(Parametrize, APlanarMeshBecomesIsometric) {
  PolygonMesh mesh = grid(6);
  for (Vector3& p : mesh.positions) p = {p.x() + 0.3 * p.y(), 2 * p.y(), 0.5 * p.x() - p.y()};
  for (const int n : {1, 2, 3, 4}) {
    ParametrizationOptions options = degree(n);
    options.solve.tolerance = 1e-10;
    const ParametrizationResult result = parametrize(surface(mesh), options);
    EXPECT_EQ(result.status, Status::Converged) << result.message;
    expect_valid(result, n);
    EXPECT_NEAR(result.measures.value, 4, 1e-9) << n;
    EXPECT_NEAR(result.measures.sigma_max, 1, 1e-4) << n;
    EXPECT_NEAR(result.measures.sigma_min, 1, 1e-4) << n;
  }
}

TEST(Parametrize, DoesNotDependOnScale) {
  const PolygonMesh mesh = grid(5, bumpy);
  const double expected = parametrize(surface(mesh), degree(2)).measures.value;
  for (const double scale : {1e-9, 1e-6, 3.0, 1e6, 1e9}) {
    PolygonMesh scaled = mesh;
    for (Vector3& p : scaled.positions) p *= scale;
    const ParametrizationResult result = parametrize(surface(scaled), degree(2));
    EXPECT_EQ(result.status, Status::Converged) << scale;
    EXPECT_NEAR(result.measures.value, expected, 1e-9 * expected) << scale;
  }
}

// The scale of a map is undetermined under |J|^2: the map shrinks until its energy is rounding.
TEST(Parametrize, AnEnergyThatVanishesEndsTheRun) {
  ParametrizationOptions options = degree(1);
  options.map.energy = {
      {energy_factory(invariant("dirichlet", [](const auto& x, const auto& y) { return x + y; },
                                {Domain::Everywhere, Convexity::Convex}))}};
  const ParametrizationResult result = parametrize(generated("cap"), options);
  EXPECT_EQ(status_name(result.status), status_name(Status::Converged));
  EXPECT_TRUE(result.measures.locally_injective);
  EXPECT_LE(result.measures.value, 1e-14);
  EXPECT_EQ(result.message, "the energy vanishes");
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
