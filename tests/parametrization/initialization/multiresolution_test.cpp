// The multiresolution start: injective, close to the minimum, independent of the number of threads.
#include "majorant/parametrization/initialization/multiresolution.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "counted_stop.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/framework/newton.h"
#include "majorant/framework/parallel.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/measure.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh/list_edits.h"
#include "mesh/obj_file.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

double energy_of(const std::shared_ptr<const SurfaceMesh>& mesh, const MapOptions& polls,
                 const Vec& uv) {
  MapSpecification spec(polls);
  spec.rest = std::make_shared<const RestShapes>(flat_triangles(mesh->positions(), mesh->faces()));
  const auto space =
      std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), 1);
  return energy_by_face(spec, energy_terms(spec, space, {lattice_rule(1)}), {}, uv).sum() /
         spec.rest->measure.sum();
}

void expect_injective(const std::shared_ptr<const SurfaceMesh>& mesh, const Vec& uv) {
  ASSERT_EQ(uv.size(), 2 * mesh->vertex_count());
  const BezierMap map = BezierMap::linear(mesh, uv);
  EXPECT_TRUE(
      LocalInjectivity(map.shared_space(), Vec::Ones(mesh->face_count())).check(uv).feasible);
  EXPECT_TRUE(AngleSums(map.shared_space(), AngleSums::Vertices::Interior).check(uv).feasible);
}

// Returns the minimum by Newton's method from `start`.
double minimum(const std::shared_ptr<const SurfaceMesh>& mesh, const MapOptions& polls,
               const Vec& start) {
  MapSpecification spec(polls);
  spec.rest = std::make_shared<const RestShapes>(flat_triangles(mesh->positions(), mesh->faces()));
  const auto space =
      std::make_shared<const BezierTriangleSpace>(mesh->faces(), mesh->vertex_count(), 1);
  const Problem problem =
      map_problem(spec, space, start, energy_terms(spec, space, {lattice_rule(1)}),
                  std::make_shared<const LocalInjectivity>(space, 2 * spec.rest->measure))
          .problem;
  return NewtonMinimizer().minimize(problem, problem.reduce(start), {}).energy;
}

// Returns rules with a coarsest mesh so small that the meshes of tests have levels.
MultiresolutionRules small() {
  MultiresolutionRules rules;
  rules.coarsest = 60;
  return rules;
}

TEST(Multiresolution, StartsNearTheMinimum) {
  for (const char* name : {"cap", "creature", "ribbon", "tube", "wavy_disk"}) {
    SCOPED_TRACE(name);
    const auto mesh = generated(name);
    MultiresolutionRecord record;
    const auto uv = multiresolution_map(*mesh, {}, {}, small(), &record);
    ASSERT_TRUE(uv);
    EXPECT_GE(record.levels.size(), 2u);
    expect_injective(mesh, *uv);
    const double energy = energy_of(mesh, {}, *uv);
    EXPECT_LT(energy, 1.1 * minimum(mesh, {}, *uv));
    EXPECT_LT(energy, energy_of(mesh, {}, tutte_map(*mesh)));
  }
}

// Returns the turns of a boundary loop's image: 1 for the outer boundary, -1 for a hole.
double turns(const std::vector<Index>& loop, const Vec& uv) {
  double angle = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const auto at = [&](std::size_t i) -> Vector2 {
      return uv.segment<2>(2 * loop[i % loop.size()]);
    };
    const Vector2 in = at(k + 1) - at(k), out = at(k + 2) - at(k + 1);
    angle += std::atan2(cross(in, out), in.dot(out));
  }
  return angle / (2 * std::numbers::pi);
}

// Holes remain on every level, each with its own loop, so that the start is close to the minimum.
// Tutte's map, which fills holes, is not.
TEST(Multiresolution, KeepsHoles) {
  PolygonMesh plain = grid(20, bumpy);
  for (const std::size_t f : {620u, 300u, 180u}) erase_lists(plain.polygons, f, 1);
  plain.polygon_lines.resize(plain.polygons.size());
  const auto mesh = surface(plain);
  ASSERT_EQ(mesh->boundary_loops().size(), 4u);
  MultiresolutionRecord record;
  const auto uv = multiresolution_map(*mesh, {}, {}, small(), &record);
  ASSERT_TRUE(uv);
  EXPECT_GE(record.levels.size(), 2u);
  EXPECT_LT(record.levels.front().faces, mesh->face_count() / 4);
  expect_injective(mesh, *uv);
  std::vector<double> around;
  for (const auto& loop : mesh->boundary_loops()) around.push_back(turns(loop, *uv));
  std::sort(around.begin(), around.end());
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(around[k], k < 3 ? -1 : 1, 1e-9);
  const double least = minimum(mesh, {}, *uv), energy = energy_of(mesh, {}, *uv);
  EXPECT_LT(energy, 1.02 * least);
  EXPECT_LT(energy - least, 0.1 * (energy_of(mesh, {}, tutte_map(*mesh)) - least));
}

TEST(Multiresolution, KeepsAFixedBoundaryWhereTutteHasIt) {
  const auto mesh = surface(grid(24, bumpy));
  MapOptions polls;
  polls.boundary = BoundaryCondition::Fixed;
  const auto uv = multiresolution_map(*mesh, polls, {}, small());
  ASSERT_TRUE(uv);
  expect_injective(mesh, *uv);
  const Vec tutte = tutte_map(*mesh);
  for (const Index v : mesh->boundary_loops().front())
    EXPECT_EQ(Vector2(uv->segment<2>(2 * v)), Vector2(tutte.segment<2>(2 * v)));
  EXPECT_LT(energy_of(mesh, polls, *uv), 1.02 * minimum(mesh, polls, tutte));
}

// Face weights of 1000 on the left half of a surface: the levels have to consider them to be close
// to the minimum.
TEST(Multiresolution, RespectsFaceWeights) {
  const auto mesh = surface(grid(24, bumpy));
  MapOptions polls;
  polls.face_weight.resize(mesh->face_count());
  for (Index f = 0; f < mesh->face_count(); ++f)
    polls.face_weight[f] = mesh->positions()(mesh->faces()(f, 0), 0) < 0.5 ? 1000 : 1;
  const auto uv = multiresolution_map(*mesh, polls, {}, small());
  ASSERT_TRUE(uv);
  const double least = minimum(mesh, polls, *uv);
  EXPECT_LT(energy_of(mesh, polls, *uv), 1.02 * least);
  const auto unweighted = multiresolution_map(*mesh, {}, {}, small());
  EXPECT_LT(energy_of(mesh, polls, *uv) - least,
            0.2 * (energy_of(mesh, polls, *unweighted) - least));
}

TEST(Multiresolution, TakesEveryEnergyWithABarrier) {
  const auto mesh = surface(grid(20, bumpy));
  for (const NamedEnergy& energy : named_energies()) {
    SCOPED_TRACE(energy.name);
    MapOptions polls;
    polls.energy = {{energy.make, 1.0}};
    const auto uv = multiresolution_map(*mesh, polls, {}, small());
    ASSERT_EQ(uv.has_value(), energy.make.traits().barrier != Barrier::None);
    if (!uv) continue;
    expect_injective(mesh, *uv);
    const double least = minimum(mesh, polls, *uv);
    EXPECT_LT(energy_of(mesh, polls, *uv), least + 0.05 * std::abs(least));
  }
}

TEST(Multiresolution, IsTheSameWithAnyNumberOfThreadsAndAtAnyScale) {
  const auto mesh = generated("creature");
  std::optional<Vec> first;
  for (const int threads : {1, 2, 3, 8}) {
    const ThreadCount count(threads);
    const auto uv = multiresolution_map(*mesh, {}, {}, small());
    ASSERT_TRUE(uv);
    EXPECT_EQ(first.value_or(*uv), *uv);
    first = uv;
  }
  PolygonMesh large = obj_file(std::string(MAJORANT_SOURCE_DIR) + "/examples/meshes/creature.obj");
  for (Vector3& p : large.positions) p *= 1024;
  EXPECT_EQ(*multiresolution_map(*surface(large), {}, {}, small()), 1024 * *first);
}

// The limbs of `creature` are compressed. Relaxing them first reduces the work on all levels.
// Thresholds that no vertex reaches disable it.
TEST(Multiresolution, RelaxesCompressedPartsFirst) {
  const auto mesh = generated("creature");
  MultiresolutionRules rules = small();
  rules.compressed_share = 0;
  MultiresolutionRecord relaxed, left;
  const Vec with = *multiresolution_map(*mesh, {}, {}, rules, &relaxed);
  rules.compressed_share = 2;
  const Vec without = *multiresolution_map(*mesh, {}, {}, rules, &left);
  expect_injective(mesh, with);
  EXPECT_LT(energy_of(mesh, {}, with), energy_of(mesh, {}, without));
  ASSERT_EQ(relaxed.levels.size(), left.levels.size());
  for (std::size_t k = 1; k < left.levels.size(); ++k) {
    EXPECT_GT(relaxed.levels[k].compressed_steps, 0) << k;
    EXPECT_GT(relaxed.levels[k].compressed, 0) << k;
    EXPECT_LT(relaxed.levels[k].compressed, relaxed.levels[k].faces / 2) << k;
    EXPECT_EQ(left.levels[k].compressed, 0) << k;
  }
}

// Relaxing compressed parts changes neither the rest of the map nor a fixed boundary.
TEST(Multiresolution, RelaxingKeepsAFixedBoundary) {
  const auto mesh = surface(grid(24, bumpy));
  MapOptions polls;
  polls.boundary = BoundaryCondition::Fixed;
  MultiresolutionRules rules = small();
  rules.compressed_share = rules.compressed = 0;  // all vertices
  MultiresolutionRecord record;
  const Vec uv = *multiresolution_map(*mesh, polls, {}, rules, &record);
  EXPECT_EQ(record.levels.back().compressed, mesh->vertex_count());
  expect_injective(mesh, uv);
  const Vec tutte = tutte_map(*mesh);
  for (const Index v : mesh->boundary_loops().front())
    EXPECT_EQ(Vector2(uv.segment<2>(2 * v)), Vector2(tutte.segment<2>(2 * v)));
}

// Trace rows of coarse levels, the coarsest first, with their energies; the iteration limit does
// not count them.
TEST(Multiresolution, NotesItsSteps) {
  const auto mesh = generated("creature");
  RunRecord run;
  MultiresolutionRecord record;
  ASSERT_TRUE(multiresolution_map(*mesh, {}, run, small(), &record));
  std::size_t row = 0;
  for (std::size_t k = 0; k + 1 < record.levels.size(); ++k) {
    const LevelRecord& level = record.levels[k];
    for (int step = 0; step < level.steps; ++step, ++row) {
      ASSERT_LT(row, run.trace().size());
      EXPECT_EQ(run.trace()[row].level, static_cast<int>(record.levels.size() - 1 - k));
    }
    EXPECT_EQ(run.trace()[row - 1].energy, level.energy) << k;
  }
  EXPECT_EQ(row, run.trace().size());
  EXPECT_EQ(steps_taken(run.trace()), 0);

  RunRecord short_run(1e9, 0);
  ASSERT_TRUE(multiresolution_map(*mesh, {}, short_run, small()));
  EXPECT_EQ(short_run.trace().size(), run.trace().size());
  EXPECT_EQ(short_run.iterations_left(), 0);
}

TEST(Multiresolution, ReportsUnsupportedCases) {
  for (const int size : {3, 15}) {  // too small for levels, or for more than the coarsest one
    RunRecord run;
    EXPECT_FALSE(multiresolution_map(*surface(grid(size)), {}, run));
    EXPECT_TRUE(run.trace().empty());
  }
  const auto mesh = surface(grid(20));
  MapOptions apart;
  apart.injectivity = MapInjectivity::Global;
  EXPECT_THROW(multiresolution_map(*mesh, apart, {}, small()), InvalidArgument);
  MapOptions angles;
  angles.boundary_angles = BoundaryAngles::AtMostFullTurn;
  EXPECT_FALSE(suits_multiresolution(*mesh, angles));
  EXPECT_FALSE(multiresolution_map(*mesh, angles, {}, small()));
  EXPECT_TRUE(suits_multiresolution(*mesh, {}));
}

TEST(Multiresolution, EndsWhenItIsStopped) {
  const auto mesh = generated("creature");
  const CountedStop whole;
  ASSERT_TRUE(multiresolution_map(*mesh, {}, whole.check(), small()));
  EXPECT_GT(whole.polls(), 20);
  for (long last = 1; last < whole.polls(); last += whole.polls() / 7) {
    const CountedStop stop(last);
    EXPECT_THROW(multiresolution_map(*mesh, {}, stop.check(), small()), Stopped) << last;
    EXPECT_LE(stop.polls_after(), ThreadCount::current()) << last;
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
