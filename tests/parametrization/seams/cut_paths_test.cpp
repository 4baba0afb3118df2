// Zigzag paths are straightened and remain cuts.
#include "majorant/parametrization/seams/cut_paths.h"

#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

// Returns flags of the edges between consecutive vertices.
std::vector<char> path_through(const SurfaceMesh& mesh, const std::vector<Index>& vertices) {
  std::vector<char> is_cut(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    for (std::size_t k = 1; k < vertices.size(); ++k)
      if (mesh.from_vertex(h) == vertices[k - 1] && mesh.to_vertex(h) == vertices[k])
        is_cut[h] = is_cut[mesh.opposite(h)] = 1;
  return is_cut;
}

// Returns a tube of radius 1 with n rows of m quads; vertices row by row.
PolygonMesh tube(int m, int n) {
  std::vector<Vector3> positions;
  std::vector<std::vector<Index>> quads;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i < m; ++i) {
      const double angle = 2 * kPi * i / m;
      positions.push_back({std::cos(angle), std::sin(angle), 0.4 * j});
      const Index next = (i + 1) % m;
      if (j < n) quads.push_back({j * m + i, j * m + next, (j + 1) * m + next, (j + 1) * m + i});
    }
  return polygon_mesh(std::move(positions), std::move(quads));
}

TEST(CutPaths, StaircasesBecomeStraight) {
  constexpr int n = 12;
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(n));
  std::vector<Index> stairs;  // to the left and up, against the diagonals
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
  EXPECT_NEAR(cut, 15, 1e-9);  // no longer than the zigzag path
  EXPECT_EQ(mesh.cut_along(is_cut, nullptr).topology().boundary_loops, 2);
}

// Returns, on a tube of m by n quads, a ring around it and a cut from one of its vertices to the
// border.
std::vector<char> ring_and_branch(const SurfaceMesh& mesh, int m, int n) {
  std::vector<Index> ring, branch;
  for (int i = 0; i <= m; ++i) ring.push_back(n / 2 * m + i % m);
  for (int j = 0; j <= n / 2; ++j) branch.push_back(j * m);
  std::vector<char> is_cut = path_through(mesh, ring);
  const std::vector<char> down = path_through(mesh, branch);
  for (std::size_t h = 0; h < is_cut.size(); ++h) is_cut[h] |= down[h];
  return is_cut;
}

TEST(CutPaths, LoopsWithOneNodeStayLoops) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(tube(16, 8));
  const std::vector<char> is_cut = ring_and_branch(mesh, 16, 8);
  const CutTurning turning = turning_of_cuts(mesh, is_cut);
  EXPECT_NEAR(turning.shortest, turning.cuts, 1e-9);
  std::vector<char> smooth = is_cut;
  smooth_cuts(mesh, {}, Vec::Ones(mesh.half_edge_count()), smooth);
  EXPECT_EQ(smooth, is_cut);
}

// Halves of the loop have one edge and two: straightening the longer half must not give the other
// one.
TEST(CutPaths, LoopsOfThreeEdgesDivide) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(tube(3, 8));
  std::vector<char> is_cut = ring_and_branch(mesh, 3, 8);
  smooth_cuts(mesh, {}, Vec::Ones(mesh.half_edge_count()), is_cut);
  EXPECT_EQ(mesh.cut_along(is_cut, nullptr).topology().components, 2);
}

TEST(CutPaths, WithoutCutsHaveNoTurning) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(3));
  EXPECT_EQ(turning_of_cuts(mesh, std::vector<char>(to_size(mesh.half_edge_count()), 0)).cuts, 0);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
