// Sectors of aligned edges, against flat surfaces with known angles.
#include "majorant/parametrization/fields/internal/aligned_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// Returns the half-edges along the lines of a grid of n by n squares, without diagonals.
std::vector<char> grid_lines(const SurfaceMesh& mesh, int n) {
  std::vector<char> lines(to_size(mesh.half_edge_count()), 0);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Vector3 edge =
        mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h));
    lines[h] = edge.norm() < 1.1 / n;
  }
  return lines;
}

TEST(AlignedEdges, FixedAnglesAreThoseOfTheLongestEdge) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(2));
  const FieldGeometry geometry(mesh);
  EXPECT_EQ(fixed_angles(mesh, geometry, {}), Vec::Constant(mesh.face_count(), kNotAligned));
  const Vec all =
      fixed_angles(mesh, geometry, std::vector<char>(to_size(mesh.half_edge_count()), 1));
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Vector3 edge =
        mesh.positions().row(mesh.to_vertex(h)) - mesh.positions().row(mesh.from_vertex(h));
    if (edge.norm() < 0.6) continue;  // only diagonals are longer
    EXPECT_NEAR(std::remainder(all[face_of(h)] - geometry.edge_direction[h], 4 * kQuarter), 0,
                1e-12);
  }
}

// A parallel field turns by the angles of its sectors.
TEST(AlignedEdges, SectorsOfAGridHoldTheirAngles) {
  constexpr int kSquares = 4;
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(kSquares));
  const FieldGeometry geometry(mesh);
  const std::vector<char> lines = grid_lines(mesh, kSquares);
  const Vec fixed = fixed_angles(mesh, geometry, lines);
  const AlignedSectors sectors =
      aligned_sectors(mesh, geometry, lines, fixed, Vec::Zero(mesh.half_edge_count()));
  // Grid lines cross at inner vertices and end at the boundary.
  ASSERT_EQ(sectors.turns.size(), to_size(4 * kSquares * kSquares));
  for (std::size_t s = 0; s < sectors.turns.size(); ++s) {
    EXPECT_EQ(sectors.turns[s], 1);
    EXPECT_EQ(sectors.target[s], 1);
    EXPECT_EQ(sectors.least[s], 1);
    const auto& at = sectors.at[sectors.vertex[s]];
    EXPECT_EQ(std::count(at.begin(), at.end(), static_cast<Index>(s)), 1);
  }
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    int turns = 0;
    for (const Index s : sectors.at[v]) turns += sectors.turns[s];
    EXPECT_NEAR(turns, geometry.angle_sum[v] / kQuarter, 1e-9);
  }
}

TEST(AlignedEdges, RotationsAreTakenAwayFromTheTurns) {
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(grid(2));
  const FieldGeometry geometry(mesh);
  const std::vector<char> lines = grid_lines(mesh, 2);
  const Vec fixed = fixed_angles(mesh, geometry, lines);
  Vec rotation = Vec::Zero(mesh.half_edge_count());
  Index diagonal = 0;
  while (lines[diagonal] || mesh.opposite(diagonal) < 0) ++diagonal;
  rotation[diagonal] = kQuarter;
  rotation[mesh.opposite(diagonal)] = -kQuarter;
  const AlignedSectors sectors = aligned_sectors(mesh, geometry, lines, fixed, rotation);
  // Moving a turn across a half-edge takes it from the sector at its start to the sector at its
  // end.
  EXPECT_EQ(sectors.turns[sectors.of_corner[diagonal]], 2);
  EXPECT_EQ(sectors.turns[sectors.of_corner[mesh.opposite(diagonal)]], 0);
}

TEST(AlignedEdges, LeastTurnsHoldCornersBelow180Degrees) {
  EXPECT_EQ(least_turns_at(4, 4), 3);  // three quads of 120 degrees
  EXPECT_EQ(least_turns_at(1, 4), 1);
  EXPECT_EQ(least_turns_at(1.9, 4), 2);  // one quad of 171 degrees exceeds the limit
  EXPECT_EQ(least_turns_at(9, 4), 4);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
