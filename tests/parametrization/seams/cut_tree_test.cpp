// Branches of cuts that join holes, and which of them may be taken back.
#include "majorant/parametrization/seams/internal/cut_tree.h"

#include <limits>

#include "majorant/mesh/cut_graph.h"
#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

// Branches that may be taken back, at most (cut_tree.cpp).
constexpr Index kMostBranches = 500;

// A wavy square of 3 k + 2 quads a side with k^2 holes of one quad.
SurfaceMesh sheet_with_holes(int k) {
  const int n = 3 * k + 2;
  std::set<int> holes;
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < k; ++i) holes.insert((3 * j + 1) * n + 3 * i + 1);
  return SurfaceMesh::from_polygons(grid_without(n, holes, bumpy));
}

// The loops that are left once the tree has taken back all branches it may.
Index loops_of_shortest(const SurfaceMesh& mesh) {
  const std::vector<char> is_terminal(to_size(mesh.vertex_count()), 0);
  const Vec cost = edge_lengths(mesh);
  FlatteningSystem system(mesh);
  CutTree tree(system, cut_graph(mesh, {}, cost), is_terminal, cost, 40, {});
  const double any = std::numeric_limits<double>::infinity();
  tree.shorten(0, any, {});
  const SurfaceMesh cut = mesh.cut_along(tree.after(tree.steps_within(any)).is_cut, nullptr);
  EXPECT_EQ(cut.topology().components, 1);
  return cut.topology().boundary_loops;
}

// A branch, here one or two edges, ends at each hole. What is left of the cut hangs together: each
// hole that it joins no more is a loop, all others are one loop.
TEST(CutTree, TakesBackASettledNumberOfBranchesAtMost) {
  EXPECT_EQ(loops_of_shortest(sheet_with_holes(6)), 1 + 6 * 6);
  EXPECT_EQ(loops_of_shortest(sheet_with_holes(24)), 1 + kMostBranches);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
