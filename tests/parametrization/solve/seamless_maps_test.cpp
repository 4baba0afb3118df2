// parametrize() from seamless starts: seams, cones, pins and boundaries hold at every degree.
#include <filesystem>

#include "expected_error.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/io/read_mesh.h"
#include "parametrization/initialization/seamless_cases.h"
#include "parametrization/solve/parametrize_expectations.h"
#include "public_data.h"

namespace majorant {
namespace {

// Bends the squares out of their plane, so that their maps are not isometric.
Vector3 bent(const Vector3& p) {
  return {p.x() + 0.15 * std::sin(2 * p.y() + p.z()), p.y() + 0.12 * std::sin(1.7 * p.x()),
          p.z() + 0.2 * std::sin(1.3 * p.x() + 2 * p.y())};
}

ParametrizationResult solve(const Start& start, const ParametrizationOptions& options) {
  RunRecord record;
  ParametrizationResult result = parametrize(start.map, options, record);
  // Within a degree energies never increase.
  const auto& trace = record.trace();
  for (std::size_t k = 1; k < trace.size(); ++k)
    if (trace[k].degree == trace[k - 1].degree) {
      EXPECT_GE(trace[k].record.relative_decrease, 0);
    }
  return result;
}

void expect_seamless(const ParametrizationResult& r, int n) {
  expect_valid(r, n);
  const BezierMap& map = *r.map;
  const double size = map.control_points().cwiseAbs().maxCoeff();
  EXPECT_LE(seam_residual(map.space(), map.seams(), map.control_points()), 1e-13 * size);
  const Vec sums = vertex_angle_sums(map.space(), map.control_points());
  Vec total = Vec::Zero(Index(map.seams().quarter_turns().size()));
  for (Index v = 0; v < sums.size(); ++v) total[map.seams().surface_vertex()[v]] += sums[v];
  for (Index v = 0; v < total.size(); ++v)
    if (const int turns = map.seams().quarter_turns()[v]; turns > 0) {
      EXPECT_NEAR(total[v], turns * kPi / 2, 1e-6);
    }
}

std::vector<std::pair<const char*, SeamlessCase>> cases() {
  std::vector<std::pair<const char*, SeamlessCase>> out{
      {"cube, six charts", squares_case(unit_cube(), 3, Charts::OnePerSquare, bent)},
      {"cube, net", squares_case(unit_cube(), 3, Charts::OneWithoutSlits, bent)},
      {"torus", squares_case(square_torus(4, 4), 1, Charts::OneWithoutSlits)},
      {"genus 2", squares_case(holed_plate(2), 2, Charts::OneWithoutSlits, bent)},
      {"annulus", fan_case(5, 3, 1)}};
  for (const int turns : {2, 3, 5, 8}) out.push_back({"fan", fan_case(turns, 3)});
  return out;
}

std::vector<Index> copies_of(const Seams& seams, Index v) {
  std::vector<Index> out;
  for (std::size_t k = 0; k < seams.surface_vertex().size(); ++k)
    if (seams.surface_vertex()[k] == v) out.push_back(Index(k));
  return out;
}

TEST(SeamlessMaps, HoldSeamsAndConesAtEveryDegree) {
  for (const auto& [name, surface] : cases()) {
    const Start start = surface.start();
    double last = INFINITY;
    for (const int n : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << name << ", degree " << n);
      const ParametrizationResult r = solve(start, degree(n));
      EXPECT_EQ(r.status, Status::Converged) << r.message;
      expect_seamless(r, n);
      if (n == 1) {
        EXPECT_LT(r.measures.value, r.initial_value);
      }
      EXPECT_LE(r.measures.value, last * (1 + 1e-9));
      last = r.measures.value;
    }
  }
}

TEST(SeamlessMaps, DoNotDependOnThreads) {
  const Start start = squares_case(holed_plate(1), 8, Charts::OneWithoutSlits, bent).start();
  Vec first;
  for (const int count : {1, 2, 3, 4}) {
    ParametrizationOptions options = degree(2);
    options.solve.threads = count;
    const ParametrizationResult r = solve(start, options);
    if (count == 1) first = r.map->control_points();
    EXPECT_EQ(r.map->control_points(), first) << count;
  }
}

// The result does not depend on the positions of charts: translations of the seams compensate them.
TEST(SeamlessMaps, DoNotDependOnWhereChartsAre) {
  const SeamlessCase near = squares_case(unit_cube(), 3, Charts::OnePerSquare, bent);
  SeamlessCase far = near;
  for (Index f = 0; f < far.corners.rows(); ++f)
    for (Index k = 0; k < 3; ++k)
      far.corners.row(f).segment<2>(2 * k) += Eigen::RowVector2d(512, -768) * (f / 18);
  const ParametrizationResult a = solve(near.start(), degree(2));
  const ParametrizationResult b = solve(far.start(), degree(2));
  EXPECT_EQ(b.status, Status::Converged) << b.message;
  EXPECT_NEAR(a.measures.value, b.measures.value, 1e-6 * a.measures.value);
}

// Additional cuts change the set of maps in neither direction, except with pins, which are
// positions in a chart.
TEST(SeamlessMaps, DoNotDependOnTheCuts) {
  struct Case {
    SeamlessCase surface;
    BoundaryCondition boundary;
  };
  const Case cases[] = {
      {squares_case(unit_cube(), 3, Charts::OneWithoutSlits, bent), BoundaryCondition::Free},
      {squares_case(holed_plate(2), 1, Charts::One, bent), BoundaryCondition::Free},
      {fan_case(5, 3), BoundaryCondition::Fixed},
      {fan_case(5, 3, 1), BoundaryCondition::Fixed},
      {fan_case(3, 3), BoundaryCondition::Free}};
  for (const Case& c : cases) {
    ParametrizationOptions options = degree(2);
    options.map.boundary = c.boundary;
    options.solve.tolerance = 1e-10;
    const auto value = [&](const SeamlessCase& surface) {
      const Start start = surface.start();
      const ParametrizationResult r = solve(start, options);
      EXPECT_EQ(r.status, Status::Converged) << r.message;
      expect_seamless(r, 2);
      return r.measures.value;
    };
    const double expected = value(c.surface);
    for (const unsigned seed : {1u, 2u, 3u})
      for (const double probability : {0.1, 0.4, 1.0}) {
        SCOPED_TRACE(testing::Message() << &c - cases << ' ' << seed << ' ' << probability);
        EXPECT_NEAR(value(with_random_cuts(c.surface, probability, seed)), expected,
                    1e-7 * expected);
      }
  }
}

// ---- Meshes of the public collection ----

TEST(SeamlessMaps, PublicMeshes) {
  const std::filesystem::path folder = public_data("seamless");
  if (folder.empty()) GTEST_SKIP() << kNoPublicData;
  for (const char* name : {"cube_4", "cubesphere_1728", "lshape_1872", "spot_3000"}) {
    SCOPED_TRACE(name);
    const auto mesh = surface(read_mesh((folder / (std::string(name) + ".obj")).string()));
    const Start start = seamless_from_texture(*mesh);
    int defect = 0;
    for (const Cone& c : start.map.seams().cones()) defect += 4 - c.quarter_turns;
    EXPECT_EQ(defect, 4 * mesh->topology().euler_characteristic());
    double last = INFINITY;
    for (const int n : {1, 2}) {
      const ParametrizationResult r = solve(start, degree(n));
      EXPECT_EQ(r.status, Status::Converged) << r.message;
      expect_seamless(r, n);
      EXPECT_LE(r.measures.value, last * (1 + 1e-9));
      last = r.measures.value;
    }
  }
}

// ---- Composed ----

TEST(SeamlessMaps, PinsOnEveryCopyOfCutVertices) {
  for (const auto& [name, surface] : cases()) {
    SCOPED_TRACE(name);
    const Start start = surface.start();
    const BezierMap& map = start.map;
    std::set<Index> pinned;
    for (std::size_t e = 0; e < map.seams().edges().size(); e += 3)
      for (const Index v : copies_of(
               map.seams(),
               map.seams().surface_vertex()[map.mesh().from_vertex(map.seams().edges()[e].side)]))
        pinned.insert(v);
    for (const int n : {1, 3}) {
      ParametrizationOptions options = degree(n);
      for (const Index v : pinned) options.map.pins.push_back({v, std::nullopt});
      const ParametrizationResult r = solve(start, options);
      EXPECT_EQ(r.status, Status::Converged) << r.message;
      expect_seamless(r, n);
      const double size = map.control_points().cwiseAbs().maxCoeff();
      for (const Index v : pinned)
        EXPECT_LE(
            (r.map->control_points().segment<2>(2 * v) - map.control_points().segment<2>(2 * v))
                .norm(),
            1e-13 * size);
    }
  }
}

TEST(SeamlessMaps, APinOnOneCopy) {
  const Start start = squares_case(unit_cube(), 3, Charts::OneWithoutSlits, bent).start();
  const Seams& seams = start.map.seams();
  const Index v = start.map.mesh().from_vertex(seams.edges()[0].side);
  ParametrizationOptions options = degree(2);
  options.map.pins = {{v, Vector2(start.map.control_points().segment<2>(2 * v))}};
  const ParametrizationResult r = solve(start, options);
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  expect_seamless(r, 2);
  EXPECT_NEAR(r.measures.value, solve(start, degree(2)).measures.value, 1e-5);
}

TEST(SeamlessMaps, FixedBoundaries) {
  for (const int turns : {2, 3, 5, 8})
    for (const int inner : {0, 1}) {
      const Start start = fan_case(turns, 4, inner).start();
      for (const int n : {1, 2, 3}) {
        SCOPED_TRACE(testing::Message() << turns << " turns, inner " << inner << ", degree " << n);
        ParametrizationOptions options = degree(n);
        options.map.boundary = BoundaryCondition::Fixed;
        const ParametrizationResult r = solve(start, options);
        EXPECT_EQ(r.status, Status::Converged) << r.message;
        expect_seamless(r, n);
        const BezierMap initial = elevated_to(start.map, n);
        for (const Index node : boundary_nodes(r.map->space(), r.map->seams()))
          EXPECT_LE((r.map->control_points().segment<2>(2 * node) -
                     initial.control_points().segment<2>(2 * node))
                        .norm(),
                    1e-14);
      }
    }
}

TEST(SeamlessMaps, PinsElsewhereAreReached) {
  const Start start = fan_case(5, 3).start();
  ParametrizationOptions options = degree(1);
  options.map.pins = {{1, Vector2(0.5, 0.5)}};
  ParametrizationResult r = solve(start, options);
  expect_seamless(r, 1);
  EXPECT_EQ(Vector2(r.map->control_points().segment<2>(2)), Vector2(0.5, 0.5));
  options.map.pins.push_back({5, Vector2(0.1, 0.9)});
  r = solve(start, options);
  expect_seamless(r, 1);
  for (const Pin& p : options.map.pins)
    EXPECT_LE((r.map->control_points().segment<2>(2 * p.vertex) - *p.target).norm(), 1e-14);
}

// A cone is a combination of translations; the pinned cone must not have their rounding.
TEST(SeamlessMaps, APinnedConeIsMetToTheBit) {
  const Start start = fan_case(5, 3).start();
  for (int k = 0; k < 8; ++k) {
    ParametrizationOptions options = degree(1);
    const Vector2 target(1.3703359426097297 + 0.1 * k, -0.27545938435084033 - 0.07 * k);
    options.map.pins = {{0, target}};
    const ParametrizationResult r = solve(start, options);
    expect_seamless(r, 1);
    EXPECT_EQ(Vector2(r.map->control_points().segment<2>(0)), target) << k;
  }
}

// ---- Aligned edges ----

// Returns the half-edges at the edges of the unit cube, where faces of two directions meet.
std::vector<Index> sides_of_cube(const BezierMap& map) {
  std::vector<Index> out;
  for (const SeamEdge& e : map.seams().edges()) out.push_back(e.side);
  return out;
}

double off_axis(const BezierMap& map, const std::vector<Index>& edges) {
  double worst = 0;
  for (const Index h : edges) {
    const std::vector<Index> nodes = edge_nodes(map.space(), h);
    Vector2 span(0, 0);
    for (const Index a : nodes)
      span = span.cwiseMax(
          (map.control_points().segment<2>(2 * a) - map.control_points().segment<2>(2 * nodes[0]))
              .cwiseAbs());
    worst = std::max(worst, span.minCoeff());
  }
  return worst;
}

TEST(SeamlessMaps, AlignedSidesStayAligned) {
  for (const Charts charts : {Charts::OnePerSquare, Charts::OneWithoutSlits}) {
    const Start start = squares_case(unit_cube(), 3, charts, bent).start();
    const std::vector<Index> sides = sides_of_cube(start.map);
    for (const int n : {1, 2, 3}) {
      ParametrizationOptions options = degree(n);
      const double free = solve(start, options).measures.value;
      options.map.aligned = sides;
      const ParametrizationResult r = solve(start, options);
      EXPECT_EQ(r.status, Status::Converged) << r.message;
      expect_seamless(r, n);
      EXPECT_LE(off_axis(*r.map, sides), 1e-14 * r.map->control_points().cwiseAbs().maxCoeff());
      EXPECT_LE(r.start_moved, 1e-14);
      EXPECT_GE(r.measures.value, free * (1 - 1e-9));
    }
  }
}

TEST(SeamlessMaps, AlignedSidesWithPins) {
  const Start start = squares_case(unit_cube(), 3, Charts::OneWithoutSlits, bent).start();
  ParametrizationOptions options = degree(2);
  options.map.aligned = sides_of_cube(start.map);
  std::set<Index> pinned;
  for (const std::size_t e : {0, 4, 8}) {
    const Index cut = start.map.mesh().from_vertex(start.map.seams().edges()[e].side);
    for (const Index v : copies_of(start.map.seams(), start.map.seams().surface_vertex()[cut]))
      pinned.insert(v);
  }
  for (const Index v : pinned) options.map.pins.push_back({v, std::nullopt});
  const ParametrizationResult r = solve(start, options);
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  expect_seamless(r, 2);
  EXPECT_LE(off_axis(*r.map, options.map.aligned), 1e-13);
  for (const Index v : pinned)
    EXPECT_LE(
        (r.map->control_points().segment<2>(2 * v) - start.map.control_points().segment<2>(2 * v))
            .norm(),
        1e-13);
}

// The boundary of a square, without seams: sides are straight, corners have right angles.
TEST(SeamlessMaps, AlignedBoundary) {
  const auto mesh = surface(grid(8, bumpy));
  std::vector<Index> boundary;
  for (Index h = 0; h < mesh->half_edge_count(); ++h)
    if (mesh->opposite(h) < 0) boundary.push_back(h);
  ParametrizationOptions options = degree(3);
  options.map.initial = uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); });
  options.map.aligned = boundary;
  const ParametrizationResult r = parametrize(mesh, options);
  EXPECT_EQ(r.status, Status::Converged) << r.message;
  expect_valid(r, 3);
  EXPECT_LE(off_axis(*r.map, boundary), 1e-14);
  // Small deviations are projected, large ones refused.
  for (Index k = 0; k < options.map.initial->size(); ++k)
    (*options.map.initial)[k] += 2e-5 * std::sin(double(7 * k));
  const ParametrizationResult s = parametrize(mesh, options);
  EXPECT_EQ(s.status, Status::Converged) << s.message;
  EXPECT_GT(s.start_moved, 1e-6);
  EXPECT_LT(s.start_moved, 4e-5);
  EXPECT_NEAR(s.measures.value, r.measures.value, 1e-6);
  EXPECT_LE(off_axis(*s.map, boundary), 1e-14);
  options.map.boundary = BoundaryCondition::Fixed;
  const ParametrizationResult fixed = parametrize(mesh, options);
  EXPECT_EQ(fixed.status, Status::Converged) << fixed.message;
  EXPECT_LE(off_axis(*fixed.map, boundary), 1e-14);
  options.map.boundary = BoundaryCondition::Free;
  (*options.map.initial)[0] -= 1e-3;
  expect_contains(error_message(ErrorKind::Infeasible, [&] { parametrize(mesh, options); }),
                  {"inline.obj", "edge (", "parallel to an axis"});
  options.map.aligned = {mesh->half_edge_count()};
  error_message(ErrorKind::Usage, [&] { parametrize(mesh, options); });
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
