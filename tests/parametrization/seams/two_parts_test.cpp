// Two parts of a chart, divided by planes or areas.
#include "majorant/parametrization/seams/internal/two_parts.h"

#include <algorithm>
#include <cmath>

#include "majorant/mesh/cut_graph.h"
#include "parametrization/seams/cut_checks.h"

namespace majorant {
namespace {

std::vector<SurfaceMesh> parts_of(const SurfaceMesh& chart, PartsAround centres) {
  const std::vector<char> flags = border_of_two_parts(chart, edge_lengths(chart), centres, {});
  return pieces_of(chart, flags);
}

// Returns a sheet folded at a quarter of its width.
SurfaceMesh folded() {
  return SurfaceMesh::from_polygons(
      grid(12, [](double x, double) { return 2 * std::max(0.0, x - 0.75); }));
}

TEST(TwoParts, OfPlanesMeetAtTheFold) {
  const SurfaceMesh chart = folded();
  const std::vector<char> flags =
      border_of_two_parts(chart, edge_lengths(chart), PartsAround::Planes, {});
  for (Index h = 0; h < chart.half_edge_count(); ++h) {
    const bool is_fold = chart.opposite(h) >= 0 &&
                         std::abs(chart.positions()(chart.from_vertex(h), 0) - 0.75) < 1e-12 &&
                         std::abs(chart.positions()(chart.to_vertex(h), 0) - 0.75) < 1e-12;
    EXPECT_EQ(flags[h] != 0, is_fold) << h;
  }
}

TEST(TwoParts, GrownFromEndsHaveTheSameArea) {
  const SurfaceMesh chart = folded();
  const std::vector<SurfaceMesh> parts = parts_of(chart, PartsAround::Ends);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0].area(), parts[1].area(), 0.1 * chart.area());
}

// A single polygon is divided into its triangles; several polygons stay undivided.
TEST(TwoParts, AreOfWholePolygonsWhereThereAreSeveral) {
  const SurfaceMesh one = SurfaceMesh::from_polygons(
      polygon_mesh({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}}));
  EXPECT_EQ(parts_of(one, PartsAround::Planes).size(), 2u);
  const SurfaceMesh several = SurfaceMesh::from_polygons(cube_sphere(3));
  for (const PartsAround centres : {PartsAround::Planes, PartsAround::Ends}) {
    const std::vector<char> flags =
        border_of_two_parts(several, edge_lengths(several), centres, {});
    for (Index h = 0; h < several.half_edge_count(); ++h)
      if (flags[h]) {
        EXPECT_NE(several.input_face(face_of(h)), several.input_face(face_of(several.opposite(h))));
      }
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
