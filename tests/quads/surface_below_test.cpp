// The faces that a nearest point lies on.
#include "majorant/quads/internal/surface_below.h"

#include <gtest/gtest.h>

#include <set>

namespace majorant {
namespace {

// The mesh is a fan of four faces around (0, 0), and one face that touches its border.
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

// A plate, one unit thick.
SurfaceMesh plate() {
  PolygonMesh polygons;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair(-9.0, -9.0), {9.0, -9.0}, {9.0, 9.0}, {-9.0, 9.0}})
      polygons.positions.emplace_back(x, y, z);
  polygons.polygons = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (Index i = 0; i < 4; ++i) {
    const Index j = (i + 1) % 4;
    polygons.polygons.push_back({i, j, 4 + j});
    polygons.polygons.push_back({i, 4 + j, 4 + i});
  }
  return SurfaceMesh::from_polygons(polygons);
}

// Half way through a plate both sides are as near, and what is as near as the other must not decide
// by its number.
TEST(SurfaceBelow, AcceptsEitherSideInTheMiddleOfAPlate) {
  const SurfaceMesh mesh = plate();
  const SurfaceBelow below(mesh);
  const auto is_away = [&](double middle, bool faces_up) {
    std::array<Vector3, 4> corners{
        {{0, 1, middle - 0.1}, {1, 1, middle - 0.1}, {1, 3, middle + 0.1}, {0, 3, middle + 0.1}}};
    if (!faces_up) std::swap(corners[1], corners[3]);
    return below.is_away(corners, below.tree().nearest({0.5, 2, middle}));
  };
  for (const bool faces_up : {false, true}) {
    EXPECT_FALSE(is_away(0.5, faces_up)) << faces_up;
    EXPECT_EQ(is_away(0.49, faces_up), faces_up);
    EXPECT_EQ(is_away(0.51, faces_up), !faces_up);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
