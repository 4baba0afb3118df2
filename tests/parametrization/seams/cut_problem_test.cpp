// Cuts through given vertices, and their shortening.
#include "majorant/parametrization/seams/internal/cut_problem.h"

#include <algorithm>
#include <set>

#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

TEST(CutProblem, LargeSurfacesAimBelowTheLimitAndSearchOnce) {
  const SurfaceMesh small = SurfaceMesh::from_polygons(cube_sphere(6)),
                    large = SurfaceMesh::from_polygons(cube_sphere(60));
  const CutRequest small_request{{}, std::vector<char>(to_size(small.vertex_count()), 0)},
      large_request{{}, std::vector<char>(to_size(large.vertex_count()), 0)};
  ASSERT_GT(large.vertex_count(), kLargeSurface);
  const CutProblem easy(small, small_request, 0.02), hard(large, large_request, 0.02);
  EXPECT_EQ(easy.limit, 0.02);
  EXPECT_LT(hard.limit, 0.02);
  EXPECT_GT(hard.limit, 0.8 * 0.02);
  EXPECT_GT(easy.rounds(), 1);
  EXPECT_EQ(hard.rounds(), 1);
}

// The eight corners of a cube; one of them has to stay uncut.
TEST(CutProblem, ListsCurvedVertices) {
  const SurfaceMesh cube = SurfaceMesh::from_polygons(voxel_surface(box(3, 3, 3)));
  CutRequest request{{}, std::vector<char>(to_size(cube.vertex_count()), 0)};
  const CutProblem all(cube, request, 0.02);
  EXPECT_EQ(all.curved.size(), 8u);
  EXPECT_TRUE(all.is_faceted);
  request.whole[all.curved.front()] = 1;
  EXPECT_EQ(CutProblem(cube, request, 0.02).curved.size(), 7u);
  const SurfaceMesh dome = SurfaceMesh::from_polygons(grid(6, bumpy));
  const CutRequest smooth{{}, std::vector<char>(to_size(dome.vertex_count()), 0)};
  EXPECT_FALSE(CutProblem(dome, smooth, 0.02).is_faceted);
}

TEST(CutProblem, RoutesAreShortenedUpToTheLimit) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(limbs(8));
  const CutRequest request{{}, std::vector<char>(to_size(mesh.vertex_count()), 0)};
  std::vector<Index> tips;  // the ends of limbs, and four other vertices
  for (Index v = 0; v < mesh.vertex_count(); v += mesh.vertex_count() / 12) tips.push_back(v);
  const CutProblem probe(mesh, request, 1e-9);
  const AutomaticCut full = routed(probe, tips);
  const std::vector<SurfaceMesh> pieces = pieces_of(mesh, full.is_cut);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NO_THROW(pieces.front().require_planar());
  for (const Index v : tips) {
    bool is_on_cut = false;
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      is_on_cut = is_on_cut || (full.is_cut[h] && mesh.from_vertex(h) == v);
    EXPECT_TRUE(is_on_cut) << v;
  }
  const CutProblem problem(mesh, request, 3 * full.strain);
  const AutomaticCut cut = shortened(problem, full, tips);
  EXPECT_LE(cut.strain, problem.limit);
  EXPECT_GT(cut.strain, full.strain);
  EXPECT_EQ(cut.strain, strain_of(problem, cut.is_cut));
  EXPECT_LT(length_of(problem, cut), 0.95 * length_of(problem, full));
  EXPECT_EQ(pieces_of(mesh, cut.is_cut).size(), 1u);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (cut.is_cut[h]) {
      EXPECT_TRUE(full.is_cut[h]);
    }
  // Nothing is shortened if the limit does not allow it.
  EXPECT_EQ(shortened(probe, full, tips).is_cut, full.is_cut);
}

TEST(CutProblem, WeightsAffectPositionsOfCutsNotTheirCost) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(cube_sphere(6));
  CutRequest request{{}, std::vector<char>(to_size(mesh.vertex_count()), 0)};
  request.preferences.weight.assign(to_size(mesh.half_edge_count()), 0.5);
  const CutProblem problem(mesh, request, 0.02);
  const AutomaticCut cut = routed(problem, {0, 7, 50});
  EXPECT_NEAR(cost_of(problem, cut), 0.5 * plain_cost_of(problem, cut), 1e-12);
  EXPECT_NEAR(plain_cost_of(problem, cut), length_of(problem, cut) / std::sqrt(mesh.area()), 1e-9);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
