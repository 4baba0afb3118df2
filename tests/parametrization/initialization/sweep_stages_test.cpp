// Sweeps on several threads and sequential sweeps give equal bits.
#include "majorant/parametrization/initialization/internal/sweep_stages.h"

#include <atomic>

#include "majorant/energies/energy_factory.h"
#include "majorant/framework/parallel.h"
#include "majorant/parametrization/initialization/start.h"
#include "mesh/obj_file.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

constexpr int kSweeps = 4;

struct Sheet {
  std::shared_ptr<const SurfaceMesh> mesh;
  CollapsingMesh left;
  Vec uv;
  VertexDescent descent;

  explicit Sheet(const std::shared_ptr<const SurfaceMesh>& m)
      : mesh(m),
        left(m->faces(), m->opposites(), m->vertex_count()),
        uv(tutte_map(*m)),
        descent(left, m->positions(), {{symmetric_dirichlet(), 1.0}}, uv) {
    decimate(left, m->positions(), {m->face_count() / 2, {}});
    descent.measure_all();
  }
  // Some vertices are fixed.
  bool moves(Index v) const { return left.is_present(v) && v % 17 != 3; }
};

Vec one_by_one(const std::shared_ptr<const SurfaceMesh>& mesh) {
  Sheet s(mesh);
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (Index v = 0; v < s.left.vertex_count(); ++v)
      if (s.moves(v)) s.descent.improve(v, 1);
  return s.uv;
}

Vec in_stages(const std::shared_ptr<const SurfaceMesh>& mesh, int threads) {
  const ThreadCount some(threads);
  Sheet s(mesh);
  const SweepStages stages(
      s.left, [&](Index v) { return s.moves(v); }, kSweeps);
  std::vector<VertexDescent> descents(to_size(threads), s.descent);
  stages.visit(descents);
  return s.uv;
}

TEST(SweepStages, GiveTheResultOfASequentialSweep) {
  for (const auto& mesh : {surface(grid(40)), generated("wavy_disk"), generated("creature")}) {
    const Vec expected = one_by_one(mesh);
    ASSERT_NE(expected, Sheet(mesh).uv);
    for (const int threads : {1, 2, 3, 8}) EXPECT_EQ(in_stages(mesh, threads), expected) << threads;
  }
}

TEST(SweepStages, WithoutVerticesChangeNothing) {
  Sheet s(surface(grid(3)));
  const Vec before = s.uv;
  const SweepStages stages(
      s.left, [](Index) { return false; }, kSweeps);
  std::vector<VertexDescent> descents(2, s.descent);
  stages.visit(descents);
  EXPECT_EQ(s.uv, before);
}

TEST(SweepStages, AreStopped) {
  Sheet s(generated("creature"));
  const SweepStages stages(
      s.left, [&](Index v) { return s.moves(v); }, kSweeps);
  const ThreadCount two(2);
  std::vector<VertexDescent> descents(2, s.descent);
  std::atomic<int> requested = 0;
  const StopCheck stop(
      [&] { return ++requested < 5 ? Directive::Continue : Directive::Interrupt; });
  EXPECT_THROW(stages.visit(descents, stop), Stopped);
  EXPECT_LT(requested, 10);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
