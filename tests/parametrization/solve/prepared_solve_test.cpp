// The problem prepared in parallel to the start equals the problem of a solve, and results are
// equal.
#include "majorant/parametrization/solve/internal/prepared_solve.h"

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "majorant/framework/parallel.h"
#include "majorant/parametrization/solve/normalized_start.h"
#include "mesh/test_meshes.h"
#include "parametrization/solve/parametrize_expectations.h"

namespace majorant {
namespace {

// Returns a mesh of some 7,000 faces, enough for a multiresolution start.
std::shared_ptr<const SurfaceMesh> hills() {
  PolygonMesh mesh = grid(60);
  for (Vector3& p : mesh.positions) p.z() += 4 * std::sin(0.2 * p.x()) * std::cos(0.3 * p.y());
  return surface(mesh);
}

ParametrizationOptions with_threads(int threads) {
  ParametrizationOptions options = degree(1);
  options.solve.threads = threads;
  return options;
}

// A waiting thread may wake late: retries until one has prepared the problem, where one should.
std::shared_ptr<PreparedParts> prepared(const std::shared_ptr<const SurfaceMesh>& mesh,
                                        const ParametrizationOptions& options, int tries) {
  RunRecord record;
  std::shared_ptr<PreparedParts> parts;
  for (int k = 0; k < tries && !parts; ++k) {
    PreparedSolve preparing(mesh, options, SolverRules(), record);
    std::this_thread::sleep_for(std::chrono::milliseconds(20 * (k + 1)));
    parts = preparing.finish();
  }
  return parts;
}

struct Outcome {
  Vec x;
  std::vector<double> energies;
  std::string solver;

  explicit Outcome(const ParametrizationOptions& options) {
    RunRecord record;
    const ParametrizationResult result = parametrize(hills(), options, record);
    expect_valid(result, options.map.degree);
    x = result.map->control_points();
    for (const TraceEntry& row : record.trace()) energies.push_back(row.energy);
  }
  bool operator==(const Outcome& other) const { return x == other.x && energies == other.energies; }
};

TEST(PreparedSolve, ChangesNoBitOnAnyNumberOfThreads) {
  ParametrizationOptions weighted = with_threads(1), curved = with_threads(1),
                         held = with_threads(1);
  weighted.map.face_weight = Vec::LinSpaced(hills()->face_count(), 1, 2);
  curved.map.degree = 2;
  held.map.pins = {{0, Vector2(0, 0)}, {60, Vector2(60, 0)}};  // known only after the start
  for (ParametrizationOptions options : {with_threads(1), weighted, curved, held}) {
    const Outcome expected(options);
    for (const int threads : {2, 3, 8}) {
      options.solve.threads = threads;
      EXPECT_TRUE(Outcome(options) == expected) << threads;
    }
  }
}

TEST(PreparedSolve, IsTheProblemOfTheSolve) {
  const auto mesh = hills();
  const ThreadCount two(2);
  const ParametrizationOptions options = with_threads(2);
  const std::shared_ptr<PreparedParts> parts = prepared(mesh, options, 50);
  ASSERT_TRUE(parts);
  const Vec uv = initial_map(*mesh, options.map);
  const NormalizedStart start(BezierMap(mesh, parts->space, uv), options.map, Origin::Free, nullptr,
                              parts->rest);
  EXPECT_TRUE(parts->fits(*parts->space, start.map().control_points()));
  EXPECT_FALSE(parts->fits(*parts->space, uv.array() + 1)) << "of another place";
  const BezierMap other = BezierMap::linear(mesh, uv);
  EXPECT_FALSE(parts->fits(other.space(), start.map().control_points())) << "of another space";
  const NormalizedStart plain(other, options.map);
  EXPECT_EQ(plain.specification().rest->measure, parts->rest->measure);
  const Problem made =
      map_problem(plain.specification(), other.shared_space(), plain.map().control_points(),
                  energy_terms(plain.specification(), other.shared_space(), {lattice_rule(1)}),
                  nullptr)
          .problem;
  const SparsePattern &a = made.pattern(), &b = parts->built.problem.pattern();
  EXPECT_EQ(a.column_starts, b.column_starts);
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.block_of, b.block_of);
  const auto with_analysis = [&](Ordering ordering) {
    return make_direct_solver({.ordering = ordering, .analysis = parts->analysis});
  };
  const auto one = with_analysis(Ordering::Automatic), taken = with_analysis(Ordering::Automatic);
  one->analyze(a);                             // another solver object: its analysis is not used
  with_analysis(Ordering::Metis)->analyze(b);  // another ordering: the analysis is not used
  taken->analyze(b);
  EXPECT_FALSE(parts->analysis->take(b, Ordering::Automatic)) << "it was taken";
  EXPECT_EQ(one->description(), taken->description());
  Vec values = Vec::Zero(a.nonzeros());
  for (Index c = 0; c < a.size; ++c) values[a.diagonal_slot(c)] = 2 + c % 3;
  Vec p, q;
  const Vec r = Vec::LinSpaced(a.size, -1, 1);
  ASSERT_EQ(one->factorize(values, 0), FactorStatus::Ok);
  ASSERT_EQ(taken->factorize(values, 0), FactorStatus::Ok);
  one->solve(r, p);
  taken->solve(r, q);
  EXPECT_EQ(p, q);
}

TEST(PreparedSolve, IsOfPlainMapsOfManyFacesOnSeveralThreads) {
  const auto is_prepared = [&](const std::shared_ptr<const SurfaceMesh>& mesh,
                               const ParametrizationOptions& options, int threads, int tries = 3) {
    const ThreadCount some(threads);
    return prepared(mesh, options, tries) != nullptr;
  };
  const auto mesh = hills();
  const ParametrizationOptions plain = degree(1);
  EXPECT_TRUE(is_prepared(mesh, plain, 2, 50));
  EXPECT_FALSE(is_prepared(mesh, plain, 1));
  EXPECT_FALSE(is_prepared(surface(grid(10)), plain, 2));
  ParametrizationOptions options = plain;
  options.map.pins = {{0, Vector2(0, 0)}};
  EXPECT_FALSE(is_prepared(mesh, options, 2));
  options = plain;
  options.map.boundary = BoundaryCondition::Fixed;
  EXPECT_FALSE(is_prepared(mesh, options, 2));
  options = plain;
  options.map.injectivity = MapInjectivity::Global;
  EXPECT_TRUE(is_prepared(mesh, options, 2, 50));
  options.solve.scaffold = ScaffoldUse::FromTheStart;
  EXPECT_FALSE(is_prepared(mesh, options, 2));
  options = plain;
  options.extend = [](MapExtension&) {};
  EXPECT_FALSE(is_prepared(mesh, options, 2));
}

// A run that is stopped at any moment ends like a run on one thread, or reports the stop.
TEST(PreparedSolve, RunsAreStoppedAtAnyTime) {
  for (int last = 1; last < 2000; last = last * 3 / 2 + 1) {
    std::atomic<int> requested = 0;
    const StopCheck stop(
        [&] { return ++requested < last ? Directive::Continue : Directive::Interrupt; });
    RunRecord record(stop);
    try {
      const ParametrizationResult result = parametrize(hills(), with_threads(2), record);
      EXPECT_TRUE(result.status == Status::Interrupted || result.status == Status::Converged);
    } catch (const Stopped& stopped) {
      EXPECT_EQ(stopped.why(), Directive::Interrupt);
    }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
