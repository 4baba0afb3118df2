// Lengths and counts agree with the flags of cuts.
#include "majorant/parametrization/seams/internal/cut_totals.h"

#include "majorant/parametrization/seams/internal/pieces.h"
#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

// Returns three unit squares in a row; {1, 5} and {2, 6} are the edges between them.
SurfaceMesh three_squares() {
  return SurfaceMesh::from_polygons(polygon_mesh(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {0, 2, 0}, {1, 2, 0}, {2, 2, 0}, {3, 2, 0}},
      {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}}));
}

Index half_edge_between(const SurfaceMesh& mesh, Index a, Index b) {
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.from_vertex(h) == a && mesh.to_vertex(h) == b) return h;
  return -1;
}

TEST(CutTotals, CountEveryEdgeOnce) {
  const SurfaceMesh mesh = three_squares();
  SurfaceCuts cuts;
  cuts.is_cut.assign(to_size(mesh.half_edge_count()), 0);
  std::vector<char> requested = cuts.is_cut;
  for (const auto& [a, b] : {std::pair<Index, Index>{1, 5}, {2, 6}}) {
    const Index h = half_edge_between(mesh, a, b);
    cuts.is_cut[h] = cuts.is_cut[mesh.opposite(h)] = 1;
    if (a == 1) requested[h] = requested[mesh.opposite(h)] = 1;
  }
  cuts.components.resize(1);
  add_totals(mesh, requested, component_faces(mesh.opposites()), cuts);
  EXPECT_EQ(cuts.edges, 2);
  EXPECT_EQ(cuts.added_edges, 1);
  EXPECT_DOUBLE_EQ(cuts.length, 4);
  EXPECT_DOUBLE_EQ(cuts.added_length, 2);
  EXPECT_EQ(cuts.components.front().pieces, 3);
  EXPECT_DOUBLE_EQ(cuts.components.front().length, 4);
}

TEST(CutTotals, AddedCutsCanBeRemovedAgain) {
  const SurfaceMesh mesh = three_squares();
  const CutOptions options = cuts_by(CutMethod::Given);
  SurfaceCuts cuts = choose_cuts(mesh, options);
  ASSERT_EQ(cuts.edges, 0);
  const Index inner = half_edge_between(mesh, 1, 5), outer = half_edge_between(mesh, 0, 1);
  add_cuts(mesh, options, {inner, mesh.opposite(inner), outer}, cuts);
  expect_planar_pieces(mesh, cuts);
  EXPECT_EQ(cuts.edges, 1);
  EXPECT_EQ(cuts.added_edges, 1);
  EXPECT_DOUBLE_EQ(cuts.added_length, 2);
  EXPECT_EQ(cuts.components.front().pieces, 2);
  remove_cuts(mesh, options, {inner}, cuts);
  EXPECT_EQ(cuts.edges, 0);
  EXPECT_DOUBLE_EQ(cuts.added_length, 0);
  EXPECT_EQ(cuts.components.front().pieces, 1);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
