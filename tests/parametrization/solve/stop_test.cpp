// Runs stopped at any moment. The result is a valid map, never worse than that of an earlier stop,
// or absent; little work is done after the stop.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

#include "counted_stop.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/scaffold/improve_mesh.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "maps/test_maps.h"
#include "mesh/test_meshes.h"
#include "parametrization/fields/closed_surfaces.h"

namespace majorant {
namespace {

// Stop checks after a stop: at the ends of enclosing solves, of degrees and of measuring.
constexpr long kMostAfterwards = 12;
constexpr long kRuns = 150;  // moments, evenly spaced over the whole run

// Calls run(record) for moments over the whole run, and judge(stop, result), without a result if
// the run was Stopped.
template <class Run, class Judge>
void at_any_moment(const Run& run, const Judge& judge) {
  const CountedStop never;
  RunRecord whole(never.check());
  run(whole);
  ASSERT_GT(never.polls(), 20);
  for (long k = 1; k <= never.polls(); k += std::max(1L, never.polls() / kRuns)) {
    SCOPED_TRACE(k);
    const CountedStop stop(k);
    RunRecord record(stop.check());
    using Result = decltype(run(record));
    std::optional<Result> result;
    try {
      result = run(record);
    } catch (const Stopped& stopped) {
      EXPECT_EQ(stopped.why(), Directive::Interrupt);
    }
    EXPECT_TRUE(stop.stopped());
    EXPECT_LE(stop.polls_after(), kMostAfterwards);
    judge(record, result);
  }
}

double mean_of(const BezierMap& map, const EnergySum& energy) {
  Vec unused;
  return mean_density(map, flat_triangles(map.mesh().positions(), map.mesh().faces()), energy,
                      unused);
}

void expect_best_so_far(const ParametrizationOptions& options,
                        const std::shared_ptr<const SurfaceMesh>& mesh) {
  const BezierMap start = BezierMap::linear(mesh, initial_map(*mesh, options.map));
  double last = mean_of(start, options.map.energy) * (1 + 1e-9);
  int absent = 0;
  at_any_moment([&](RunRecord& record) { return parametrize(mesh, options, record); },
                [&](const RunRecord& record, const std::optional<ParametrizationResult>& result) {
                  if (!result) {
                    ++absent;
                    EXPECT_EQ(last, mean_of(start, options.map.energy) * (1 + 1e-9))
                        << "a result was there";
                    return;
                  }
                  ASSERT_TRUE(result->map);
                  EXPECT_EQ(result->map->degree(), options.map.degree);
                  EXPECT_EQ(result->status == Status::Interrupted,
                            record.trace().empty() || result->status != Status::Converged);
                  EXPECT_TRUE(result->measures.locally_injective);
                  EXPECT_GT(result->measures.min_det.minCoeff(), 0);
                  EXPECT_TRUE(std::isfinite(result->measures.value));
                  EXPECT_TRUE(std::isfinite(result->measures.sigma_min));
                  if (options.map.injectivity == MapInjectivity::Global) {
                    EXPECT_EQ(check_boundary(*result->map).result, ProofStatus::Proven);
                    if (options.solve.scaffold == ScaffoldUse::FromTheStart) {
                      ASSERT_TRUE(result->scaffold);
                    }
                  }
                  const double energy = mean_of(*result->map, options.map.energy);
                  // The energy of the returned map, to the accuracy of the optimizer's rule.
                  EXPECT_NEAR(result->value_quadrature, energy, 2e-3 * energy);
                  EXPECT_LE(energy, last * (1 + 1e-3));
                  last = std::min(last, energy);
                });
  EXPECT_GT(absent, 0);
}

TEST(Stop, LocallyInjectiveMaps) {
  ParametrizationOptions options;
  for (const int degree : {1, 3}) {
    options.map.degree = degree;
    expect_best_so_far(options, surface(grid(4, bumpy)));
  }
  options.map.degree = 2;
  options.solve.elevation = Elevation::Direct;
  expect_best_so_far(options, surface(grid(4, bumpy)));
  options.map.energy = {{find_energy("arap")->make}};  // the run stalls before its end
  expect_best_so_far(options, surface(grid(4, bumpy)));
}

TEST(Stop, BijectiveMaps) {
  ParametrizationOptions options;
  options.map.injectivity = MapInjectivity::Global;
  options.map.degree = 2;
  for (const ScaffoldUse use : {ScaffoldUse::WhereMapsOverlap, ScaffoldUse::FromTheStart}) {
    options.solve.scaffold = use;
    expect_best_so_far(options, surface(grid(3, bumpy)));
  }
}

TEST(Stop, SeamlessMaps) {
  const auto mesh = surface(cube(4));
  at_any_moment(
      [&](RunRecord& record) { return make_seamless(*mesh, {}, record); },
      [&](const RunRecord&, const std::optional<Start>& result) { EXPECT_FALSE(result); });
}

TEST(Stop, Deformations) {
  const auto mesh = surface(grid(5));
  ParametrizationOptions options;
  options.map.degree = 2;
  options.map.handles = {{0, Vector2(0, 0)}, {35, Vector2(1.5, 1.5)}};
  const BezierMap start = planar_map(mesh);
  at_any_moment([&](RunRecord& record) { return deform(start, options, record); },
                [&](const RunRecord&, const std::optional<ParametrizationResult>& result) {
                  ASSERT_TRUE(result && result->map);
                  EXPECT_TRUE(result->measures.locally_injective);
                });
}

TEST(Stop, BeforeTheFirstStepHandlesAreAsFarAsTheStartHasThem) {
  const BezierMap start = planar_map(surface(grid(2)));
  ParametrizationOptions options;
  options.map.degree = 2;
  options.map.handles = {{8, Vector2(1.25, 1)}};
  const CountedStop stop(1);
  RunRecord record(stop.check());
  const ParametrizationResult result = parametrize(start, options, record);
  EXPECT_EQ(result.status, Status::Interrupted);
  EXPECT_EQ(result.variables, 0);
  EXPECT_NEAR(result.handle_distance, 0.25, 1e-12);
}

TEST(Stop, MeasuringStops) {
  const auto mesh = surface(grid(5, bumpy));
  const BezierMap map = elevated_to(BezierMap::linear(mesh, initial_map(*mesh, MapOptions())), 3);
  const EnergySum energy{{symmetric_dirichlet()}};
  const MapMeasures whole = measure_map(map, energy);
  EXPECT_FALSE(whole.cut_short);
  const CountedStop never;
  EXPECT_EQ(measure_map(map, energy, never.check()).value, whole.value);
  for (long k = 1; k <= never.polls(); ++k) {
    const CountedStop stop(k);
    const MapMeasures m = measure_map(map, energy, stop.check());
    EXPECT_TRUE(m.cut_short);
    EXPECT_LE(stop.polls_after(), ThreadCount::current());
    EXPECT_NEAR(m.value, whole.value, 0.1 * whole.value);
    EXPECT_EQ(m.min_det, whole.min_det);
    EXPECT_EQ(m.locally_injective, whole.locally_injective);
    EXPECT_LE(m.sigma_max, whole.sigma_max);
    EXPECT_GE(m.sigma_min, whole.sigma_min);
    EXPECT_GT(m.sigma_max, 0);
  }
}

TEST(Stop, FlipsOfEdges) {
  const auto mesh = surface(grid(5));
  const BezierMap identity =
      BezierMap::linear(mesh, uv_of(*mesh, [](const Vector3& p) { return Vector2(p.x(), p.y()); }));
  const BezierMap map = shaken(identity, 0.06, 1);
  const EnergySum energy{{symmetric_dirichlet()}};
  const CountedStop never;
  const Index all = improve_mesh(map, energy, never.check()).flips.performed;
  ASSERT_GT(all, 0);
  for (long k = 1; k <= never.polls(); ++k) {
    const CountedStop stop(k);
    const ImprovedMap improved = improve_mesh(map, energy, stop.check());
    EXPECT_LE(improved.flips.performed, all);
    EXPECT_TRUE(measure_map(improved.map, energy).locally_injective);
    EXPECT_EQ(stop.polls_after(), 0);
  }
}

// Reading ends immediately by an exception, wherever it is stopped. Each other thread may do one
// more check at the moment of the stop.
template <class Read>
void expect_ends_at_once(const Read& read, long least_requested) {
  const CountedStop never;
  read(never.check());
  ASSERT_GE(never.polls(), least_requested);
  for (long k = 1; k <= never.polls(); k += std::max(1L, never.polls() / kRuns)) {
    const CountedStop stop(k);
    EXPECT_THROW(read(stop.check()), Stopped);
    EXPECT_LT(stop.polls_after(), ThreadCount::current());
  }
}

TEST(Stop, ReadersOfMeshes) {
  const auto folder = std::filesystem::temp_directory_path() / "majorant_stop_test";
  std::filesystem::create_directories(folder);
  const PolygonMesh mesh = grid(60);
  const auto file = [&](const char* name) { return (folder / name).string(); };
  std::ofstream obj(file("a.obj")), off(file("a.off")), ply(file("a.ply")), stl(file("a.stl"));
  off << "OFF\n" << mesh.positions.size() << ' ' << mesh.polygons.size() << " 0\n";
  ply << "ply\nformat ascii 1.0\nelement vertex " << mesh.positions.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nelement face "
      << mesh.polygons.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  stl << "solid\n";
  for (const Vector3& p : mesh.positions) {
    obj << "v " << p.transpose() << '\n';
    off << p.transpose() << '\n';
    ply << p.transpose() << '\n';
  }
  for (const auto& f : mesh.polygons) {
    obj << "f " << f[0] + 1 << ' ' << f[1] + 1 << ' ' << f[2] + 1 << '\n';
    for (std::ofstream* out : {&off, &ply})
      *out << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
    stl << "facet normal 0 0 1\nouter loop\n";
    for (const Index v : f) stl << "vertex " << mesh.positions[v].transpose() << '\n';
    stl << "endloop\nendfacet\n";
  }
  stl << "endsolid\n";
  for (std::ofstream* out : {&obj, &off, &ply, &stl}) out->close();
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl"}) {
    SCOPED_TRACE(name);
    // At least one check for each 4096 of 11,000 records.
    expect_ends_at_once([&](const StopCheck& stop) { read_mesh(file(name), stop); }, 4);
  }
  expect_ends_at_once([&](const StopCheck& stop) { SurfaceMesh::from_polygons(mesh, stop); }, 6);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
