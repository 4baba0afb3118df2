// MapInjectivity::Global: no overlaps, and a higher energy only where the local map would overlap.
#include <algorithm>

#include "expected_error.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/maps/energy_text.h"
#include "majorant/parametrization/solve/parametrize_by.h"
#include "mesh/list_edits.h"
#include "mesh/obj_file.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

ParametrizationOptions options(int n, MapInjectivity injectivity) {
  ParametrizationOptions o = degree(n);
  o.map.injectivity = injectivity;
  return o;
}

// Returns a ramp of small slope over `turns`; flattened isometrically it overlaps itself.
std::shared_ptr<const SurfaceMesh> ramp(double turns, int steps) {
  std::vector<Vector3> positions;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= 2; ++j) {
      const double t = turns * i / steps, angle = 2 * kPi * t, r = 1 + 0.25 * j;
      positions.push_back({r * std::cos(angle), r * std::sin(angle), 0.3 * t});
    }
  std::vector<std::vector<Index>> faces;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 2; ++j) {
      const Index a = 3 * i + j;
      faces.push_back({a, a + 1, a + 4});
      faces.push_back({a, a + 4, a + 3});
    }
  return surface(polygon_mesh(positions, faces));
}

int proof(const ParametrizationResult& result) {
  return static_cast<int>(check_boundary(*result.map).result);
}

TEST(Bijective, ARampThatWouldOverlap) {
  const auto mesh = ramp(1.3, 36);
  for (int n = 1; n <= 3; ++n) {
    const ParametrizationResult local = parametrize(mesh, options(n, MapInjectivity::Local));
    EXPECT_EQ(proof(local), static_cast<int>(ProofStatus::Violated)) << n;
    EXPECT_FALSE(local.scaffold.has_value());
    const ParametrizationResult global = parametrize(mesh, options(n, MapInjectivity::Global));
    expect_valid(global, n);
    EXPECT_EQ(proof(global), static_cast<int>(ProofStatus::Proven)) << n;
    EXPECT_GE(global.measures.value, local.measures.value);
    EXPECT_LE(global.measures.value, 1.01 * local.measures.value);
    EXPECT_EQ(static_cast<int>(global.status), static_cast<int>(Status::Converged));
    ASSERT_EQ(global.scaffold.has_value(), n > 1);
    if (n == 1) continue;
    EXPECT_EQ(global.scaffold->degree, n);
    EXPECT_GT(global.flips.performed, 0);
    EXPECT_LE(global.flips.performed, global.flips.intended);
  }
}

// If the map never overlaps, the run has the bits of the locally injective one, for any limit.
TEST(Bijective, AMapThatDoesNotOverlapIsTheFreeOne) {
  const auto mesh = ramp(0.4, 36);
  for (int n = 1; n <= 3; ++n)
    for (const int limit : {1, 3, 1000}) {
      ParametrizationResult results[2];
      for (const bool global : {false, true}) {
        RunRecord record(std::numeric_limits<double>::infinity(), limit);
        results[global] = parametrize(
            mesh, options(n, global ? MapInjectivity::Global : MapInjectivity::Local), record);
      }
      EXPECT_EQ(results[1].map->control_points(), results[0].map->control_points()) << n;
      EXPECT_EQ(status_name(results[1].status), status_name(results[0].status));
      EXPECT_EQ(proof(results[1]), static_cast<int>(ProofStatus::Proven));
      EXPECT_FALSE(results[1].scaffold.has_value());
      EXPECT_TRUE(results[1].boundary.has_value());
    }
}

// Rows of a trace are maps without overlaps; each step begins at the map of the previous row.
TEST(Bijective, AStepThatOverlapsIsTakenBack) {
  const auto mesh = ramp(1.3, 36);
  for (int n = 1; n <= 3; ++n) {
    ParametrizationOptions requested = options(n, MapInjectivity::Global);
    int shown = 0;
    requested.solve.watch = [&](const TraceEntry&, const MapView& at) {
      ++shown;
      const BezierMap map(mesh, at.space, at.x);
      EXPECT_EQ(static_cast<int>(check_boundary(map).result),
                static_cast<int>(ProofStatus::Proven));
      return Directive::Continue;
    };
    RunRecord record;
    const ParametrizationResult result = parametrize(mesh, requested, record);
    EXPECT_EQ(status_name(result.status), status_name(Status::Converged));
    ASSERT_EQ(result.scaffold.has_value(), n > 1);
    if (n > 1) {
      EXPECT_EQ(result.scaffold->degree, n);
    }
    double last = std::numeric_limits<double>::infinity();
    int iteration = 0;
    for (const TraceEntry& row : record.trace()) {
      EXPECT_EQ(row.record.iteration, ++iteration);
      if (row.phase == Phase::Newton) {
        EXPECT_LE(row.energy, last * (1 + 1e-3));
      }
      last = row.energy;
    }
    EXPECT_GE(shown, iteration);
    ParametrizationOptions surrounded = options(n, MapInjectivity::Global);
    surrounded.solve.scaffold = ScaffoldUse::FromTheStart;
    const ParametrizationResult other = parametrize(mesh, surrounded);
    EXPECT_NEAR(result.measures.value, other.measures.value, 1e-4 * other.measures.value);
  }
}

// Iteration limits before and after the step that is undone.
TEST(Bijective, LimitsEndRunsWithoutOverlaps) {
  const auto mesh = ramp(1.3, 36);
  for (int n = 1; n <= 2; ++n)
    for (int limit = 0; limit < 40; limit += n) {
      RunRecord record(std::numeric_limits<double>::infinity(), limit);
      const ParametrizationResult result =
          parametrize(mesh, options(n, MapInjectivity::Global), record);
      expect_valid(result, n);
      EXPECT_EQ(proof(result), static_cast<int>(ProofStatus::Proven)) << limit;
      EXPECT_LE(record.trace().size(), static_cast<std::size_t>(limit));
    }
}

ParametrizationResult ramp_with(double share_at_rest, int n) {
  SolverRules rules;
  rules.scaffold.share_at_rest = share_at_rest;
  ParametrizationOptions requested = options(n, MapInjectivity::Global);
  requested.solve.scaffold = ScaffoldUse::FromTheStart;
  const auto mesh = ramp(1.3, 36);
  RunRecord record;
  ParametrizationResult result = parametrize_by(
      rules, BezierMap::linear(mesh, initial_map(*mesh, requested.map)), requested, record);
  EXPECT_EQ(status_name(result.status), status_name(Status::Converged)) << n;
  EXPECT_EQ(proof(result), static_cast<int>(ProofStatus::Proven)) << n;
  return result;
}

// The scaffold's barrier is an error of the map, which is reduced at the end.
TEST(Bijective, TheBarrierOfTheScaffoldIsReducedAtTheEnd) {
  const ScaffoldRules usual;
  for (int n = 1; n <= 3; ++n)
    EXPECT_LT(ramp_with(usual.share_at_rest, n).measures.value,
              (1 - 5e-6) * ramp_with(usual.share, n).measures.value)
        << n;
}

// A scaffold of almost no weight allows no step; its weight is restored, and the run converges.
TEST(Bijective, AScaffoldThatYieldsTooMuchIsRestored) {
  EXPECT_LT(ramp_with(1e-12, 2).measures.value,
            (1 + 2e-5) * ramp_with(ScaffoldRules().share, 2).measures.value);
}

// At degree 1 a barrier between parts of the boundary replaces the scaffold, and the map is as
// good. Requests that the barrier does not suit have a scaffold.
TEST(Bijective, ABarrierReplacesTheScaffoldOfStraightMaps) {
  const auto mesh = ramp(1.3, 60);
  for (const char* energy :
       {"symmetric-dirichlet", "arap", "log-isometric", "amips-exponential", "2*mips+3*authalic"}) {
    ParametrizationOptions requested = options(1, MapInjectivity::Global);
    requested.map.energy = *find_energy_sum(energy);
    const ParametrizationResult barrier = parametrize(mesh, requested);
    requested.solve.scaffold = ScaffoldUse::FromTheStart;
    const ParametrizationResult scaffold = parametrize(mesh, requested);
    EXPECT_FALSE(barrier.scaffold.has_value()) << energy;
    ASSERT_TRUE(scaffold.scaffold.has_value()) << energy;
    EXPECT_EQ(proof(barrier), static_cast<int>(ProofStatus::Proven)) << energy;
    EXPECT_EQ(status_name(barrier.status), status_name(Status::Converged)) << energy;
    EXPECT_LE(barrier.measures.value,
              scaffold.measures.value + 1e-3 * std::max(1.0, scaffold.measures.value))
        << energy;
  }
  std::vector<ParametrizationOptions> others(5, options(1, MapInjectivity::Global));
  others[0].solve.curvature = Curvature::Exact;
  others[1].map.energy = *find_energy_sum("mips");  // an enlarged image escapes a barrier
  others[2].map.handles = {{0, Vector2(0, 0)}, {60, Vector2(1.2, 0.3)}};
  others[3].map.face_weight = Vec::Constant(mesh->face_count(), 1e-6);
  others[4].solve.scaffold_flips = ScaffoldFlips::Omitted;
  for (const ParametrizationOptions& other : others) {
    const ParametrizationResult result = parametrize(mesh, other);
    EXPECT_TRUE(result.map.has_value() && result.measures.locally_injective);
    EXPECT_EQ(proof(result), static_cast<int>(ProofStatus::Proven));
    EXPECT_TRUE(result.scaffold.has_value());
  }
}

TEST(Bijective, CostsNothingWhereNothingOverlaps) {
  for (const auto& [name, highest] : {std::pair("cap", 3), std::pair("creature", 1)})
    for (int n = 1; n <= highest; ++n) {
      const auto mesh = generated(name);
      const ParametrizationResult local = parametrize(mesh, options(n, MapInjectivity::Local));
      ASSERT_EQ(proof(local), static_cast<int>(ProofStatus::Proven));
      const ParametrizationResult global = parametrize(mesh, options(n, MapInjectivity::Global));
      expect_valid(global, n);
      EXPECT_EQ(proof(global), static_cast<int>(ProofStatus::Proven));
      EXPECT_EQ(static_cast<int>(global.status), static_cast<int>(Status::Converged));
      EXPECT_LE(global.measures.value, 1.0005 * local.measures.value) << name << ' ' << n;
    }
}

TEST(Bijective, ADiskWithTwoHoles) {
  PolygonMesh polygons = grid(6, bumpy);
  for (const std::size_t square : {22, 13}) erase_lists(polygons.polygons, 2 * square, 2);
  polygons.polygon_lines.resize(polygons.polygons.size());
  const auto mesh = surface(polygons);
  const BezierMap start =
      BezierMap::linear(mesh, uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); }));
  for (int n = 1; n <= 3; ++n) {
    RunRecord record;
    const ParametrizationResult result =
        parametrize(start, options(n, MapInjectivity::Global), record);
    expect_valid(result, n);
    EXPECT_EQ(static_cast<int>(result.status), static_cast<int>(Status::Converged));
    EXPECT_EQ(proof(result), static_cast<int>(ProofStatus::Proven));
    EXPECT_LT(result.measures.value, result.initial_value);
    // Tutte's map has holes, too.
    const ParametrizationResult other = parametrize(mesh, options(n, MapInjectivity::Global));
    expect_valid(other, n);
    EXPECT_EQ(proof(other), static_cast<int>(ProofStatus::Proven));
    EXPECT_NEAR(other.measures.value, result.measures.value, 1e-4 * result.measures.value);
  }
  expect_valid(parametrize(mesh, degree(2)), 2);  // holes need no scaffold
}

// A surface that overlaps itself when free, one with holes, and one with a fixed boundary. Steps on
// coarser meshes have a scaffold, and boundary vertices are reinserted inside the image.
TEST(Bijective, StartsInManyResolutionsHaveNoOverlaps) {
  PolygonMesh holes = grid(24, bumpy);
  for (const std::size_t f : {820u, 500u, 280u}) erase_lists(holes.polygons, f, 1);
  holes.polygon_lines.resize(holes.polygons.size());
  for (const auto& [mesh, boundary] :
       {std::pair(ramp(1.3, 400), BoundaryCondition::Free),
        std::pair(surface(holes), BoundaryCondition::Free),
        std::pair(surface(grid(24, bumpy)), BoundaryCondition::Fixed)}) {
    ParametrizationOptions o = options(1, MapInjectivity::Global);
    o.map.boundary = boundary;
    o.map.start = StartMethod::Multiresolution;
    RunRecord record;
    StartMethod taken = StartMethod::Tutte;
    const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, o.map, record, &taken));
    EXPECT_EQ(start_name(taken), "multiresolution");
    EXPECT_EQ(static_cast<int>(check_boundary(start).result),
              static_cast<int>(ProofStatus::Proven));
    EXPECT_TRUE(std::all_of(record.trace().begin(), record.trace().end(),
                            [](const TraceEntry& row) { return row.level > 0; }));
    const ParametrizationResult result = parametrize(mesh, o);
    expect_valid(result, 1);
    EXPECT_EQ(proof(result), static_cast<int>(ProofStatus::Proven));
    EXPECT_LT(measure_map(start, o.map.energy).value, 1.05 * result.measures.value);
    o.map.start = StartMethod::Tutte;
    EXPECT_NEAR(result.measures.value, parametrize(mesh, o).measures.value,
                1e-4 * result.measures.value);
  }
  MapOptions free = options(1, MapInjectivity::Local).map;
  free.start = StartMethod::Multiresolution;
  const auto mesh = ramp(1.3, 400);
  EXPECT_EQ(
      static_cast<int>(check_boundary(BezierMap::linear(mesh, initial_map(*mesh, free))).result),
      static_cast<int>(ProofStatus::Violated));
}

TEST(Bijective, DirectElevationAndLimits) {
  const auto mesh = ramp(1.3, 36);
  ParametrizationOptions o = options(2, MapInjectivity::Global);
  o.solve.elevation = Elevation::Direct;
  for (const int iterations : {0, 1, 7}) {  // valid after any number of iterations
    RunRecord record(1e9, iterations);
    const ParametrizationResult result = parametrize(mesh, o, record);
    expect_valid(result, 2);
    EXPECT_EQ(static_cast<int>(result.status), static_cast<int>(Status::MaxIterations));
    EXPECT_EQ(proof(result), static_cast<int>(ProofStatus::Proven)) << iterations;
  }
}

TEST(Bijective, PinsAndFixedBoundaryHold) {
  const auto mesh = generated("cap");
  ParametrizationOptions o = options(2, MapInjectivity::Global);
  o.map.pins = {{100, std::nullopt}, {150, std::nullopt}};
  const Vec start = initial_map(*mesh, o.map);
  const ParametrizationResult pinned = parametrize(mesh, o);
  expect_valid(pinned, 2);
  const double size = start.cwiseAbs().maxCoeff();
  for (const Pin& p : o.map.pins)
    EXPECT_LE(
        (pinned.map->control_points().segment<2>(2 * p.vertex) - start.segment<2>(2 * p.vertex))
            .norm(),
        1e-14 * size);
  o.map.pins.clear();
  o.map.boundary = BoundaryCondition::Fixed;
  const ParametrizationResult fixed = parametrize(mesh, o);
  expect_valid(fixed, 2);
  expect_boundary_fixed(fixed, start);
}

TEST(Bijective, AStartThatOverlapsIsRefused) {
  const auto mesh = ramp(1.3, 36);
  ParametrizationOptions o = options(1, MapInjectivity::Global);
  o.map.initial = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, o); });
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
