// Whole runs with pins, given starts, limits and boundary angles.
#include <atomic>
#include <filesystem>
#include <map>

#include "expected_error.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/energies/make_energy.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh/obj_file.h"
#include "parametrization/solve/parametrize_expectations.h"
#include "public_data.h"

namespace majorant {
namespace {

// ---- Pins ----

TEST(Parametrize, PinsAreHeldExactly) {
  const auto mesh = generated("cap");
  const Vec start = tutte_map(*mesh);
  const double free = parametrize(mesh, degree(1)).measures.value;
  for (const int n : {1, 2, 3})
    for (const BoundaryCondition boundary : {BoundaryCondition::Free, BoundaryCondition::Fixed}) {
      ParametrizationOptions options = degree(n);
      options.map.boundary = boundary;
      // Interior vertices and one on the boundary, with and without a target.
      const std::vector<Index> pinned{3, 40, 120, mesh->boundary_loops()[0][5]};
      for (const Index v : pinned) options.map.pins.push_back({v, std::nullopt});
      options.map.pins[1].target = Vector2(start.segment<2>(2 * pinned[1]));
      const ParametrizationResult result = parametrize(mesh, options);
      EXPECT_EQ(result.status, Status::Converged) << result.message;
      expect_valid(result, n);
      for (const Index v : pinned)
        EXPECT_EQ(Vector2(result.map->control_points().segment<2>(2 * v)),
                  Vector2(start.segment<2>(2 * v)))
            << v;
      if (n == 1) {
        EXPECT_GT(result.measures.value, free * (1 + 1e-6));
      }
    }
}

// A target within rounding of the start is met exactly, also where the boundary is fixed.
TEST(Parametrize, ATargetWithinRoundingIsAccepted) {
  const auto mesh = surface(grid(4, bumpy));
  const Vec start = tutte_map(*mesh);
  for (const BoundaryCondition boundary : {BoundaryCondition::Free, BoundaryCondition::Fixed})
    for (const Index v : {12, 0}) {
      ParametrizationOptions options = degree(2);
      options.map.boundary = boundary;
      options.map.pins = {{v, Vector2(start.segment<2>(2 * v) + Vector2(1e-12, -1e-12))}};
      const ParametrizationResult result = parametrize(mesh, options);
      EXPECT_EQ(result.status, Status::Converged) << result.message;
      EXPECT_LT(
          (result.map->control_points().segment<2>(2 * v) - *options.map.pins[0].target).norm(),
          3e-12);
    }
}

void expect_pins(const ParametrizationResult& r, const std::vector<Pin>& pins) {
  ASSERT_TRUE(r.map);
  for (const Pin& p : pins) {
    const Vector2 place = r.map->control_points().segment<2>(2 * p.vertex);
    EXPECT_EQ(place.x(), p.target->x()) << "vertex " << p.vertex;
    EXPECT_EQ(place.y(), p.target->y()) << "vertex " << p.vertex;
  }
}

// One pin has no effect on the energy, since it is a translation. Several pins increase it and are
// met exactly.
TEST(Parametrize, PinsAwayFromTheStartAreReached) {
  const auto mesh = surface(grid(6, bumpy));
  const std::vector<Pin> pins{{8, Vector2(0.3, 0.2)},
                              {40, Vector2(-0.45, 0.37)},
                              {12, Vector2(0.1, 1.3)},
                              {27, Vector2(-0.3, 0.1)},
                              {0, Vector2(0.77, -0.21)}};
  for (const MapInjectivity injectivity : {MapInjectivity::Local, MapInjectivity::Global})
    for (const std::size_t count : {1, 2, 5}) {
      SCOPED_TRACE(testing::Message() << count << " pins, " << static_cast<int>(injectivity));
      ParametrizationOptions options = degree(2);
      options.map.injectivity = injectivity;
      const double free = parametrize(mesh, options).measures.value;
      options.map.pins.assign(pins.begin(), pins.begin() + static_cast<std::ptrdiff_t>(count));
      const ParametrizationResult r = parametrize(mesh, options);
      expect_valid(r, 2);
      expect_pins(r, options.map.pins);
      if (count == 1) {
        EXPECT_NEAR(r.measures.value, free, 1e-5 * free);
      }
    }
}

// "initial" is the position in the given start, also when the start is moved towards other pins.
TEST(Parametrize, AnInitialPinStaysWhileAnotherIsReached) {
  const auto mesh = surface(grid(4, bumpy));
  ParametrizationOptions options = degree(1);
  options.map.pins = {{12, std::nullopt}, {7, Vector2(0.3, 0.2)}};
  const Vec start = initial_map(*mesh, options.map);
  const ParametrizationResult r = parametrize(mesh, options);
  expect_pins(r, {{12, Vector2(start.segment<2>(24))}, options.map.pins[1]});
}

TEST(Parametrize, PinsThatContradictEachOtherAreNamed) {
  const auto mesh = surface(grid(4, bumpy));
  const auto refused = [&](const std::vector<Pin>& pins, BoundaryCondition boundary,
                           const std::vector<std::string>& parts) {
    ParametrizationOptions options = degree(1);
    options.map.pins = pins;
    options.map.boundary = boundary;
    expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, options); }),
                    parts);
  };
  const Vector2 a(0, 0), b(0.2, 0), c(0, 0.2);
  refused({{7, a}, {12, a}}, BoundaryCondition::Free,
          {"inline.obj", "vertex 7 and vertex 12 have the same"});
  refused({{6, a}, {7, c}, {12, b}}, BoundaryCondition::Free, {"inline.obj", "turn face", "over"});
  refused({{0, a}}, BoundaryCondition::Fixed, {"vertex 0 is on the fixed boundary"});
}

TEST(Parametrize, ALimitBeforeThePinsAreReachedIsReported) {
  const auto mesh = surface(grid(6, bumpy));
  ParametrizationOptions options = degree(1);
  options.map.pins = {{8, Vector2(0.3, 0.2)}, {40, Vector2(-0.5, 0.4)}, {24, Vector2(3, 0.1)}};
  RunRecord record(1e9, 2);
  expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, options, record); }),
                  {"inline.obj", "stopped by a limit", "the limits of the RunRecord"});
}

TEST(Parametrize, RefusesTwoPinsOfOneVertex) {
  const auto mesh = surface(grid(4, bumpy));
  ParametrizationOptions options = degree(1);
  options.map.pins = {{12, std::nullopt}, {12, std::nullopt}};
  error_message(ErrorKind::Unsupported, [&] { parametrize(mesh, options); });
}

// ---- Other starts ----

TEST(Parametrize, StartsFromTheMapGiven) {
  const auto mesh = surface(grid(5, bumpy));
  ParametrizationOptions options = degree(2);
  options.map.initial = uv_of(*mesh, [](const Vector3& p) { return Vector2(2 * p.x(), p.y()); });
  options.map.boundary = BoundaryCondition::Fixed;
  const ParametrizationResult result = parametrize(mesh, options);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  expect_valid(result, 2);
  expect_boundary_fixed(result, *options.map.initial);
  EXPECT_NE(result.initial_value, parametrize(mesh, degree(2)).initial_value);
}

TEST(Parametrize, RefusesAStartThatIsNotInjective) {
  const auto mesh = surface(grid(4, bumpy));
  ParametrizationOptions options = degree(2);
  options.map.initial = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  options.map.initial->segment<2>(2 * 12) << 0.9, 0.9;
  expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, options); }),
                  {"inline.obj", "face ", "MapOptions::initial"});
  options.map.initial = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.y(), p.x()); });
  expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, options); }),
                  {"face 1 ", "32 in all"});
  const auto star = surface(cone(8, true));  // angle sum 4 pi
  options.map.initial = Vec::Zero(18);
  for (Index v = 1; v <= 8; ++v)
    options.map.initial->segment<2>(2 * v) << std::cos(kPi * v / 2), std::sin(kPi * v / 2);
  expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(star, options); }),
                  {"vertex 1 ", "more than once"});
}

// ---- Limits ----

TEST(Parametrize, TimeLimitZeroGivesAValidMapOfTheDegree) {
  const auto mesh = generated("cap");
  RunRecord record(0.0);
  const ParametrizationResult result = parametrize(mesh, degree(3), record);
  EXPECT_EQ(result.status, Status::TimeLimit);
  expect_valid(result, 3);
  EXPECT_LE(record.trace().size(), 1u);
}

TEST(Parametrize, InterruptionBeforeThereIsAMap) {
  const std::atomic<bool> interrupt{true};
  RunRecord record(INFINITY, std::numeric_limits<int>::max(), &interrupt);
  EXPECT_THROW(parametrize(generated("tube"), degree(4), record), Stopped);
  EXPECT_TRUE(record.trace().empty());
}

TEST(Parametrize, InterruptionGivesAValidMapOfTheDegree) {
  const auto mesh = generated("tube");
  for (const std::size_t after : {std::size_t(1), std::size_t(3)}) {
    std::atomic<bool> interrupt{false};
    std::size_t calls = 0;
    StepObserver observer([&](const TraceEntry&, const Vec&) {
      if (++calls >= after) interrupt = true;
      return Directive::Continue;
    });
    RunRecord record(INFINITY, std::numeric_limits<int>::max(), &interrupt, &observer);
    const ParametrizationResult result = parametrize(mesh, degree(4), record);
    EXPECT_EQ(result.status, Status::Interrupted);
    expect_valid(result, 4);
    EXPECT_LE(record.trace().size(), after + 1);
    EXPECT_EQ(record.trace().size(), calls);
  }
}

TEST(Parametrize, MaxIterationsHoldOverAllDegrees) {
  const auto mesh = generated("tube");
  double last = INFINITY;
  for (const int limit : {0, 1, 4, 12}) {
    RunRecord record(INFINITY, limit);
    const ParametrizationResult result = parametrize(mesh, degree(3), record);
    EXPECT_EQ(result.status, Status::MaxIterations) << limit;
    expect_valid(result, 3);
    EXPECT_EQ(static_cast<int>(record.trace().size()), limit);
    EXPECT_LT(result.measures.value, last);
    last = result.measures.value;
  }
}

TEST(Parametrize, LooserTolerancesStopEarlier) {
  const auto mesh = generated("tube");
  std::map<double, std::size_t> iterations;
  for (const double tolerance : {1e-2, 1e-6, 1e-12}) {
    ParametrizationOptions options = degree(1);
    options.solve.tolerance = tolerance;
    RunRecord record;
    parametrize(mesh, options, record);
    iterations[tolerance] = record.trace().size();
  }
  EXPECT_LT(iterations[1e-2], iterations[1e-6]);
  EXPECT_LE(iterations[1e-6], iterations[1e-12]);
}

TEST(Parametrize, QuadraturePointsChangeTheRule) {
  const auto mesh = generated("cap");
  ParametrizationOptions options = degree(3);
  const ParametrizationResult own = parametrize(mesh, options);
  options.solve.quadrature_points = 78;
  const ParametrizationResult lattice = parametrize(mesh, options);
  EXPECT_EQ(lattice.status, Status::Converged) << lattice.message;
  expect_valid(lattice, 3);
  EXPECT_NE(lattice.value_quadrature, own.value_quadrature);
  EXPECT_NEAR(lattice.measures.value, own.measures.value, 2e-3 * own.measures.value);
}

// ---- Boundary angles ----

TEST(Parametrize, BoundaryAnglesHoldSectorSumsWithinAFullTurn) {
  const auto mesh = surface(saddle_fan());
  for (const int n : {1, 2}) {
    ParametrizationOptions options = degree(n);
    const ParametrizationResult free = parametrize(mesh, options);
    expect_valid(free, n);
    ASSERT_GT(free.measures.max_boundary_angle, 2 * kPi + 0.1) << "the case does not test it";
    EXPECT_GT(free.measures.boundary_over_full_turn, 0);
    options.map.boundary_angles = BoundaryAngles::AtMostFullTurn;
    const ParametrizationResult held = parametrize(mesh, options);
    expect_valid(held, n);
    EXPECT_LE(held.measures.max_boundary_angle, 2 * kPi + 1e-6);
    EXPECT_EQ(held.measures.boundary_over_full_turn, 0);
    EXPECT_GT(held.measures.value, free.measures.value);
    EXPECT_EQ(held.status, Status::Stalled) << n << held.message;
  }
}

// ---- Meshes of the public collection ----

TEST(Parametrize, SolvesPublicDisks) {
  const std::filesystem::path folder = public_data("disks");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const char* name : {"spot_500", "blub_500", "mountain_500"}) {
    const auto mesh = surface(read_mesh((folder / (std::string(name) + ".obj")).string()));
    double last = INFINITY;
    for (int n = 1; n <= 3; ++n) {
      const ParametrizationResult result = parametrize(mesh, degree(n));
      EXPECT_EQ(result.status, Status::Converged) << name << ' ' << n << ": " << result.message;
      expect_valid(result, n);
      EXPECT_LE(result.measures.value, last * 1.001) << name << ' ' << n;
      last = result.measures.value;
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
