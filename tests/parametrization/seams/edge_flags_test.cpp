// Edges given by vertices of a file: cut, excluded, refused.
#include "majorant/parametrization/seams/edge_flags.h"

#include <algorithm>

#include "expected_error.h"
#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

// Returns two adjacent squares; 1 and 4 are the ends of their common edge.
SurfaceMesh two_squares() {
  return SurfaceMesh::from_polygons(
      polygon_mesh({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
                   {{0, 1, 4, 3}, {1, 2, 5, 4}}));
}

TEST(EdgeFlags, MarkBothSidesOfInnerEdges) {
  const SurfaceMesh mesh = two_squares();
  const std::vector<char> flags = flags_of_edges(mesh, {{4, 1}, {0, 1}}, "");
  ASSERT_EQ(flags.size(), to_size(mesh.half_edge_count()));
  EXPECT_EQ(std::count(flags.begin(), flags.end(), 1), 2);
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const std::set<Index> ends{mesh.from_vertex(h), mesh.to_vertex(h)};
    EXPECT_EQ(flags[h] != 0, (ends == std::set<Index>{1, 4})) << h;
  }
}

TEST(EdgeFlags, RefusePairsThatAreNoEdgeOfTheFile) {
  const SurfaceMesh mesh = two_squares();
  expect_contains(error_message(ErrorKind::Usage,
                                [&] {
                                  flags_of_edges(mesh, {{0, 5}}, "seams.json");
                                }),
                  {"seams.json: vertices 0 and 5", "no edge of inline.obj"});
  const bool is_diagonal_from_0 =
      mesh.faces().row(0).minCoeff() == 0 && mesh.faces().row(1).minCoeff() == 0;
  const std::array<Index, 2> diagonal =
      is_diagonal_from_0 ? std::array<Index, 2>{0, 4} : std::array<Index, 2>{1, 3};
  expect_contains(error_message(ErrorKind::Usage, [&] { flags_of_edges(mesh, {diagonal}, ""); }),
                  {"inside a polygon"});
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
