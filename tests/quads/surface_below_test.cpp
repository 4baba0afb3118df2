// The faces that a nearest point lies on.
#include "majorant/quads/internal/surface_below.h"

#include <gtest/gtest.h>

#include <set>

namespace majorant {
namespace {

// Of a fan of four around (0, 0), and one face that touches its border.
TEST(FacesAt, InsideOnEdgesAndAtVertices) {
  PolygonMesh polygons;
  polygons.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {2, 2, 0}};
  polygons.polygons = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {1, 5, 2}};
  const SurfaceMesh mesh = SurfaceMesh::from_polygons(polygons);
  const auto at = [&](Index face, const Barycentric& barycentric) {
    const std::vector<Index> faces = faces_at(mesh, {face, barycentric, 0});
    return std::set<Index>(faces.begin(), faces.end());
  };
  EXPECT_EQ(at(0, {0.2, 0.3, 0.5}), (std::set<Index>{0}));
  EXPECT_EQ(at(0, {0.5, 0, 0.5}), (std::set<Index>{0, 1}));
  EXPECT_EQ(at(0, {1e-10, 0.5, 0.5}), (std::set<Index>{0, 4}));
  EXPECT_EQ(at(1, {0, 0.5, 0.5}), (std::set<Index>{1}));
  EXPECT_EQ(at(2, {1, 0, 0}), (std::set<Index>{0, 1, 2, 3}));
  EXPECT_EQ(at(1, {0, 1, 0}), (std::set<Index>{0, 1, 4}));
  EXPECT_EQ(at(4, {0, 0, 1}), (std::set<Index>{0, 1, 4}));
  EXPECT_EQ(at(4, {0, 1, 0}), (std::set<Index>{4}));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
