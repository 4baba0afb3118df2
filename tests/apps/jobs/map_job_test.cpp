// Jobs that every front end runs: refusals before a solve, effects of starts and moves.
#include "majorant/apps/jobs/map_job.h"

#include "expected_error.h"
#include "majorant/mesh/refusal.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

std::shared_ptr<const PolygonMesh> shared(PolygonMesh mesh) {
  return std::make_shared<const PolygonMesh>(std::move(mesh));
}

TEST(MapJob, RefusesAClosedSurfaceWithoutAStart) {
  RunRecord record;
  MapJob job(MapTask::Parametrize, record);
  job.open(shared(torus(12, 8, 0)));
  try {
    job.mapped_mesh();
    FAIL();
  } catch (const Refusal& refusal) {
    EXPECT_EQ(refusal.hint(), Hint::CutOpen);
  }
  SeamlessOptions no_cones;
  no_cones.cones.emplace();
  job.start_seamless(no_cones, "");
  EXPECT_EQ(&job.mapped_mesh(), &job.start->map.mesh());
  EXPECT_EQ(job.init, method_name(job.start->method));
  EXPECT_GT(job.start_seconds, 0);
}

TEST(MapJob, ConesAreNamedByTheInput) {
  PolygonMesh mesh = torus(12, 8, 0);
  mesh.positions.push_back(Vector3::Zero());  // a vertex without a face
  RunRecord record;
  MapJob job(MapTask::Seamless, record);
  job.open(shared(mesh));
  SeamlessOptions options;
  options.cones = std::vector<Cone>{{static_cast<Index>(mesh.positions.size()) - 1, 3}};
  expect_contains(
      error_message(ErrorKind::Unsupported, [&] { job.start_seamless(options, "cones.json"); }),
      {"cones.json"});
}

TEST(MapJob, MovedLayoutsAreProvenAndReported) {
  RunRecord record;
  MapJob job(MapTask::Parametrize, record);
  job.open(shared(grid(4, bumpy)));
  job.options.map.degree = 2;
  job.solve();
  ASSERT_TRUE(job.has_result());
  const double value = job.result.measures.value;
  ASSERT_TRUE(job.place(Turned::Held, LayoutSize::UnitSquare));
  job.prove();
  EXPECT_EQ(job.boundary.result, ProofStatus::Proven);
  EXPECT_TRUE(job.is_normalized);
  EXPECT_FALSE(job.is_aligned);
  EXPECT_EQ(scale_of(job), job.placement->size);
  EXPECT_NEAR(job.result.map->control_uv().maxCoeff(), 1, 1e-12);
  EXPECT_NEAR(job.result.measures.value, value, 1e-9);
  const RunReport report = map_report(job);
  EXPECT_EQ(report.command, "parametrize");
  EXPECT_EQ(report.result["start"], "tutte");
}

// parametrize() has proven required injectivity; only a moved map is proven again.
TEST(MapJob, TheBoundaryIsProvenOnce) {
  RunRecord record;
  MapJob job(MapTask::Parametrize, record);
  job.open(shared(grid(4, bumpy)));
  job.options.map.degree = 1;
  job.options.map.injectivity = MapInjectivity::Global;
  job.solve();
  ASSERT_TRUE(job.result.boundary);
  EXPECT_EQ(job.result.boundary->result, ProofStatus::Proven);
  job.result.boundary->pairs_tested = -7;
  job.prove();
  EXPECT_EQ(job.boundary.pairs_tested, -7);
  ASSERT_TRUE(job.place(Turned::Free, LayoutSize::UnitSquare));
  job.prove();
  EXPECT_EQ(job.boundary.result, ProofStatus::Proven);
  EXPECT_GE(job.boundary.pairs_tested, 0);
  job.options.map.injectivity = MapInjectivity::Local;
  job.solve();
  EXPECT_FALSE(job.result.boundary);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
