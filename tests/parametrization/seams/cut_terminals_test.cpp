// Terminals of automatic cuts.
#include "majorant/parametrization/seams/internal/cut_terminals.h"

#include <algorithm>
#include <cmath>

#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

CutRequest plain_request(const SurfaceMesh& mesh) {
  return {{}, std::vector<char>(to_size(mesh.vertex_count()), 0)};
}

// Returns the number of a vertex of a grid of n by n squares.
Index at(int n, int i, int j) { return j * (n + 1) + i; }

TEST(CutTerminals, LeastWeightsComeFirst) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(8));
  CutRequest request = plain_request(mesh);
  EXPECT_TRUE(least_weighted_vertices(CutProblem(mesh, request, 0.02)).empty());
  const Index low = at(8, 2, 2), lower = at(8, 6, 5);
  request.preferences.weight.assign(to_size(mesh.half_edge_count()), 1);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    for (const Index v : {mesh.from_vertex(h), mesh.to_vertex(h)}) {
      if (v == low) request.preferences.weight[h] = 0.4;
      if (v == lower) request.preferences.weight[h] = 0.1;
    }
  EXPECT_EQ(least_weighted_vertices(CutProblem(mesh, request, 0.02)),
            (std::vector<Index>{lower, low}));
  request.whole[lower] = 1;
  EXPECT_EQ(least_weighted_vertices(CutProblem(mesh, request, 0.02)), std::vector<Index>{low});
}

// On a flat sheet with one bump, only the top of the bump is compressed.
TEST(CutTerminals, BumpsAreCompressed) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(20, [](double x, double y) {
    return 0.3 * std::exp(-40 * ((x - 0.3) * (x - 0.3) + (y - 0.6) * (y - 0.6)));
  }));
  CutRequest request = plain_request(mesh);
  const CutProblem problem(mesh, request, 0.02);
  const AutomaticCut none{std::vector<char>(to_size(mesh.half_edge_count()), 0), 0, {}};
  const std::vector<Index> vertices = compressed_vertices(problem, none);
  ASSERT_EQ(vertices.size(), 1u);
  const Vector3 top = mesh.positions().row(vertices.front());
  EXPECT_LT((top.head<2>() - Vector2(0.3, 0.6)).norm(), 0.15);
  request.whole[vertices.front()] = 1;
  EXPECT_TRUE(compressed_vertices(problem, none).empty());
}

TEST(CutTerminals, ConesAreWhereTheCubeHasCorners) {
  const SurfaceMesh cube = SurfaceMesh::from_polygons(voxel_surface(box(4, 4, 4)));
  CutRequest request = plain_request(cube);
  const CutProblem problem(cube, request, 0.02);
  std::vector<Index> cones = field_cones(problem);
  std::sort(cones.begin(), cones.end());
  EXPECT_EQ(cones, problem.curved);
  request.whole[cones.front()] = 1;
  EXPECT_EQ(field_cones(problem).size(), cones.size() - 1);
}

TEST(CutTerminals, OnACutAreItsEndsAndTheConesThatItPasses) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(6));
  const CutRequest request = plain_request(mesh);
  CutProblem problem(mesh, request, 0.02);
  const Index end = at(6, 3, 3), on = at(6, 2, 3), off = at(6, 4, 4);
  problem.cones = {off, on};
  AutomaticCut cut{std::vector<char>(to_size(mesh.half_edge_count()), 0), 0, {end}};
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    for (int i = 0; i < 3; ++i)
      if (std::minmax(mesh.from_vertex(h), mesh.to_vertex(h)) ==
          std::minmax(at(6, i, 3), at(6, i + 1, 3)))
        cut.is_cut[h] = 1;
  EXPECT_EQ(terminals_on(problem, cut), (std::vector<Index>{end, on}));
}

// For one vertex at the centre of the unit square: half of its distance to the boundary. For two
// vertices: half of their distance for each.
TEST(CutTerminals, LeastCostIsHalfOfTheDistance) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(8));
  const CutRequest request = plain_request(mesh);
  const CutProblem problem(mesh, request, 0.02);
  EXPECT_NEAR(least_cost_through(problem, {at(8, 4, 4)}), 0.25, 1e-12);
  EXPECT_NEAR(least_cost_through(problem, {at(8, 4, 4), at(8, 5, 4)}), 0.125, 1e-12);
  const SurfaceMesh cube = SurfaceMesh::from_polygons(voxel_surface(box(3, 3, 3)));
  const CutRequest all = plain_request(cube);
  const CutProblem closed(cube, all, 0.02);
  const AutomaticCut cut = routed(closed, closed.curved);
  EXPECT_LE(least_cost_through(closed, closed.curved),
            plain_cost_of(closed, cut) * std::sqrt(cube.area()) + 1e-12);
  EXPECT_NEAR(least_cost_through(closed, closed.curved), 8 * 0.5 * 3 * 0.25, 1e-12);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
