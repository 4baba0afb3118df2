// The whole run: convergence, what boundaries, pins and limits promise, options that must not
// change the result.
#include "majorant/parametrization/parametrize.h"

#include <atomic>
#include <map>

#include "majorant/constraints/local_injectivity.h"
#include "majorant/energies/make_energy.h"
#include "majorant/parametrization/initial_map.h"
#include "parametrization/parametrization_test_helpers.h"

namespace majorant {
namespace {

ParametrizationOptions degree(int n) {
  ParametrizationOptions options;
  options.degree = n;
  return options;
}

// What must hold for every result, converged or not.
void expect_valid(const ParametrizationResult& result, int n) {
  ASSERT_TRUE(result.map.has_value());
  EXPECT_EQ(result.map->degree(), n);
  EXPECT_TRUE(result.map->control_points().allFinite());
  EXPECT_TRUE(result.measures.locally_injective);
  EXPECT_GT(result.measures.min_det.minCoeff(), 0);
  EXPECT_GE(result.measures.value, 4 - 1e-12);
  EXPECT_LE(result.constraint_residual, 1e-12 * result.map->control_points().cwiseAbs().maxCoeff());
}

// The elevation of the start along the boundary, in the doubles that the solver fixes.
void expect_boundary_fixed(const ParametrizationResult& result, const Vec& start) {
  const BezierMap initial =
      elevated_to(BezierMap::linear(result.map->shared_mesh(), start), result.map->degree());
  const double size = start.cwiseAbs().maxCoeff();
  for (const Index node : result.map->space().boundary_nodes())
    EXPECT_LE((result.map->control_points().segment<2>(2 * node) -
               initial.control_points().segment<2>(2 * node))
                  .norm(),
              1e-14 * size)
        << "node " << node;
}

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
      EXPECT_GT(record.trace()[k].record.step, 0);
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
    options.boundary = BoundaryCondition::Fixed;
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
  options.elevation = Elevation::Direct;
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
      options.tolerance = 1e-8;
      const double expected = parametrize(generated(name), options).measures.value;
      for (const Curvature curvature :
           {Curvature::Majorizer, Curvature::PaperMajorizer, Curvature::Exact}) {
        options.curvature = curvature;
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
  options.curvature = Curvature::Reweighted;
  expect_contains(
      error_message(ErrorKind::Usage, [&] { parametrize(surface(grid(3, bumpy)), options); }),
      {"symmetric-dirichlet", "curvature"});
  // Not known to be convex: no majorizer.
  options.energy = [](std::shared_ptr<const ElementSpace> space, const RestShapes& rest,
                      const std::vector<Quadrature>& rules) {
    return make_energy(std::move(space), rest,
                       spectral("test-mips", Domain::PositiveDeterminant, Convexity::Unknown,
                                [](auto S, auto s) { return S / s + s / S; }),
                       rules);
  };
  for (const Curvature curvature :
       {Curvature::Majorizer, Curvature::PaperMajorizer, Curvature::Reweighted}) {
    options.curvature = curvature;
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
    options.tolerance = tolerance;
    error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
  }
  options = {};
  options.quadrature_points = -1;
  error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
}

TEST(Parametrize, RefusesWhatIsNoDisk) {
  error_message(ErrorKind::Unsupported, [&] { parametrize(surface(torus(8, 6, 1)), degree(1)); });
}

// ---- Meshes with few unknowns, or none ----

const PolygonMesh kTriangle = polygon_mesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 1}}, {{0, 1, 2}});

TEST(Parametrize, ASingleTriangleWithFixedBoundaryHasNoUnknowns) {
  ParametrizationOptions options = degree(1);
  options.boundary = BoundaryCondition::Fixed;
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
  options.boundary = BoundaryCondition::Fixed;
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
    options.tolerance = 1e-10;
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

// ---- Pins ----

TEST(Parametrize, PinsAreHeldExactly) {
  const auto mesh = generated("cap");
  const Vec start = tutte_map(*mesh);
  const double free = parametrize(mesh, degree(1)).measures.value;
  for (const int n : {1, 2, 3})
    for (const BoundaryCondition boundary : {BoundaryCondition::Free, BoundaryCondition::Fixed}) {
      ParametrizationOptions options = degree(n);
      options.boundary = boundary;
      // Interior vertices and one on the boundary, named with and without a target.
      const std::vector<Index> pinned{3, 40, 120, mesh->boundary_loops()[0][5]};
      for (const Index v : pinned) options.pins.push_back({v, std::nullopt});
      options.pins[1].target = Vector2(start.segment<2>(2 * pinned[1]));
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

// Within rounding of the start: held at the target given, also where the boundary holds it too.
TEST(Parametrize, ATargetWithinRoundingIsAccepted) {
  const auto mesh = surface(grid(4, bumpy));
  const Vec start = tutte_map(*mesh);
  for (const BoundaryCondition boundary : {BoundaryCondition::Free, BoundaryCondition::Fixed})
    for (const Index v : {12, 0}) {
      ParametrizationOptions options = degree(2);
      options.boundary = boundary;
      options.pins = {{v, Vector2(start.segment<2>(2 * v) + Vector2(1e-12, -1e-12))}};
      const ParametrizationResult result = parametrize(mesh, options);
      EXPECT_EQ(result.status, Status::Converged) << result.message;
      EXPECT_LT((result.map->control_points().segment<2>(2 * v) - *options.pins[0].target).norm(),
                3e-12);
    }
}

TEST(Parametrize, APinAwayFromTheStartIsInfeasible) {
  const auto mesh = surface(grid(4, bumpy));
  ParametrizationOptions options = degree(2);
  options.pins = {{12, std::nullopt}, {7, Vector2(0.3, 0.2)}};
  expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, options); }),
                  {"inline.obj", "vertex 7", "\"initial\"", "--init"});
}

TEST(Parametrize, RefusesTwoPinsOfOneVertex) {
  const auto mesh = surface(grid(4, bumpy));
  ParametrizationOptions options = degree(1);
  options.pins = {{12, std::nullopt}, {12, std::nullopt}};
  error_message(ErrorKind::Unsupported, [&] { parametrize(mesh, options); });
}

// ---- Other starts ----

TEST(Parametrize, StartsFromTheMapGiven) {
  const auto mesh = surface(grid(5, bumpy));
  ParametrizationOptions options = degree(2);
  options.initial = uv_of(*mesh, [](const Vector3& p) { return Vector2(2 * p.x(), p.y()); });
  options.boundary = BoundaryCondition::Fixed;
  const ParametrizationResult result = parametrize(mesh, options);
  EXPECT_EQ(result.status, Status::Converged) << result.message;
  expect_valid(result, 2);
  expect_boundary_fixed(result, *options.initial);
  EXPECT_NE(result.initial_value, parametrize(mesh, degree(2)).initial_value);
}

TEST(Parametrize, RefusesAStartThatIsNotInjective) {
  const auto mesh = surface(grid(4, bumpy));
  ParametrizationOptions options = degree(2);
  options.initial = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  options.initial->segment<2>(2 * 12) << 0.9, 0.9;
  expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, options); }),
                  {"inline.obj", "face ", "--init"});
  options.initial = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.y(), p.x()); });
  expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, options); }),
                  {"face 1 ", "32 in all"});
  const auto star = surface(cone(8, true));  // twice around
  options.initial = Vec::Zero(18);
  for (Index v = 1; v <= 8; ++v)
    options.initial->segment<2>(2 * v) << std::cos(kPi * v / 2), std::sin(kPi * v / 2);
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

TEST(Parametrize, InterruptionGivesAValidMapOfTheDegree) {
  const auto mesh = generated("tube");
  for (const std::size_t after : {std::size_t(0), std::size_t(3)}) {
    std::atomic<bool> interrupt{after == 0};
    std::size_t calls = 0;
    RunRecord record(INFINITY, std::numeric_limits<int>::max(), &interrupt, [&](const TraceEntry&) {
      if (++calls >= after) interrupt = true;
    });
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
    options.tolerance = tolerance;
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
  options.quadrature_points = 78;
  const ParametrizationResult lattice = parametrize(mesh, options);
  EXPECT_EQ(lattice.status, Status::Converged) << lattice.message;
  expect_valid(lattice, 3);
  EXPECT_NE(lattice.value_quadrature, own.value_quadrature);
  EXPECT_NEAR(lattice.measures.value, own.measures.value, 2e-3 * own.measures.value);
}

// ---- Boundary angles ----

// A fan cut along one edge whose cone angle is far beyond a full turn: without the option the two
// sides of the cut overlap, with it they may not.
PolygonMesh saddle_fan() {
  constexpr int n = 16;
  std::vector<Vector3> positions{{0, 0, 0}};
  for (int k = 0; k <= n; ++k) {
    const double t = 2 * kPi * k / n;
    positions.push_back({std::cos(t), std::sin(t), 1.2 * std::sin(3 * t)});
  }
  for (int k = 0; k <= n; ++k) positions.push_back(2 * positions[at(1 + k)]);
  std::vector<std::vector<Index>> faces;
  for (int k = 0; k < n; ++k) {
    const Index a = 1 + k, b = a + 1, c = n + 2 + k, d = c + 1;
    faces.push_back({0, a, b});
    faces.push_back({a, c, d});
    faces.push_back({a, d, b});
  }
  return polygon_mesh(std::move(positions), std::move(faces));
}

TEST(Parametrize, BoundaryAnglesHoldSectorSumsWithinAFullTurn) {
  const auto mesh = surface(saddle_fan());
  for (const int n : {1, 2}) {
    ParametrizationOptions options = degree(n);
    const ParametrizationResult free = parametrize(mesh, options);
    expect_valid(free, n);
    ASSERT_GT(free.measures.max_boundary_angle, 2 * kPi + 0.1) << "the case does not test it";
    EXPECT_GT(free.measures.boundary_over_full_turn, 0);
    options.boundary_angles = BoundaryAngles::AtMostFullTurn;
    const ParametrizationResult held = parametrize(mesh, options);
    expect_valid(held, n);
    EXPECT_LE(held.measures.max_boundary_angle, 2 * kPi + 1e-6);
    EXPECT_EQ(held.measures.boundary_over_full_turn, 0);
    EXPECT_GT(held.measures.value, free.measures.value);
    EXPECT_TRUE(held.status == Status::Converged || held.status == Status::Stalled);
  }
}

// ---- Meshes of the public collection, where they are there ----

TEST(Parametrize, SolvesPublicDisks) {
  const std::filesystem::path folder =
      std::filesystem::path(MAJORANT_SHARED_DIR) / "data/public/disks";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no " << folder;
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
