// Staircases become straight, and stay cuts.
#include "majorant/parametrization/seams/cut_paths.h"

#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

// Flags of the edges between these vertices, one after the other.
std::vector<char> path_through(const SurfaceMesh& mesh, const std::vector<Index>& vertices) {
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    for (std::size_t k = 1; k < vertices.size(); ++k)
      if (mesh.from_vertex(h) == vertices[k - 1] && mesh.to_vertex(h) == vertices[k])
        is_cut[h] = is_cut[mesh.opposite(h)] = 1;
  return is_cut;
}

TEST(CutPaths, StaircasesBecomeStraight) {
  constexpr int n = 12;
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(n));
  std::vector<Index> stairs;  // towards the left and up, where no diagonals run
  for (int k = 0; k < 8; ++k) {
    stairs.push_back((2 + k) * (n + 1) + 10 - k);
    stairs.push_back((2 + k) * (n + 1) + 9 - k);
  }
  std::vector<char> is_cut = path_through(mesh, stairs);
  const CutTurning before = turning_of_cuts(mesh, is_cut);
  const Vec length = [&] {
    Vec all(mesh.half_edge_count());
    for (Index h = 0; h < all.size(); ++h) all[h] = mesh.edge_length(h);
    return all;
  }();
  smooth_cuts(mesh, {}, length, is_cut);
  const CutTurning after = turning_of_cuts(mesh, is_cut);
  EXPECT_LT(after.cuts, 0.5 * before.cuts);
  double cut = 0;
  for (Index h = 0; h < length.size(); ++h)
    if (is_cut[h]) cut += 0.5 * length[h] * n;
  EXPECT_NEAR(cut, 15, 1e-9);  // no longer than the stairs
  EXPECT_EQ(mesh.cut_along(is_cut, nullptr).topology().boundary_loops, 2);
}

TEST(CutPaths, NoneTurnsNothing) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(3));
  EXPECT_EQ(turning_of_cuts(mesh, std::vector<char>(to_size(mesh.half_edge_count()), 0)).cuts, 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
