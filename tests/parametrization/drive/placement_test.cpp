// Layouts turned and moved before they are certified, and what they are turned along.
#include "majorant/parametrization/drive/internal/placement.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "majorant/energies/named_energies.h"
#include "majorant/parametrization/drive/parametrize.h"
#include "majorant/parametrization/maps/internal/principal_axes.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

const EnergySum kMeasured{{symmetric_dirichlet(), 1.0}};
const Vector2 kAlong(0.6, 0.8);

BezierMap map_to_place() {
  ParametrizationOptions options;
  options.map.degree = 2;
  return *parametrize(surface(grid(4, bumpy)), options).map;
}

Vector2 control_point(const BezierMap& map, Index node) {
  return map.control_points().segment<2>(2 * node);
}

TEST(Placement, TurnsEveryPointAndMeasuresWhatItMade) {
  const BezierMap map = map_to_place();
  const std::optional<PlacedMap> turned = turned_along(map, kAlong, kMeasured);
  ASSERT_TRUE(turned);
  for (Index n = 0; n < map.space().node_count(); ++n) {
    const Vector2 p = control_point(map, n);
    const Vector2 expected(0.6 * p.x() + 0.8 * p.y(), 0.6 * p.y() - 0.8 * p.x());
    EXPECT_LT((control_point(turned->map, n) - expected).norm(), 1e-15);
  }
  const MapMeasures before = measure_map(map, kMeasured);
  EXPECT_TRUE(turned->measures.locally_injective);
  EXPECT_NEAR(turned->measures.value, before.value, 1e-9);
  EXPECT_EQ(turned_along(map, {1, 0}, kMeasured)->map.control_points(), map.control_points());
}

TEST(Placement, TheUnitSquareHoldsWhatIsTurned) {
  const BezierMap map = map_to_place();
  const std::optional<PlacedMap> placed = into_unit_square(map, kAlong, kMeasured);
  ASSERT_TRUE(placed);
  const auto nodes = placed->map.control_points().reshaped(2, map.space().node_count());
  EXPECT_EQ(nodes.rowwise().minCoeff(), Vector2::Zero());
  EXPECT_EQ(nodes.maxCoeff(), 1);
  EXPECT_NEAR(placed->measures.value, measure_map(map, kMeasured).value, 1e-9);
  const auto& [direction, origin, size] = placed->placement;
  for (Index n = 0; n < map.space().node_count(); ++n) {
    Points2 uv(1, 2);
    uv << control_point(map, n).transpose();
    EXPECT_EQ(placed->placement(uv), control_point(placed->map, n).transpose());
    const Vector2 run = size * control_point(placed->map, n) + origin;
    const Vector2 back(direction.x() * run.x() - direction.y() * run.y(),
                       direction.y() * run.x() + direction.x() * run.y());
    EXPECT_LT((back - control_point(map, n)).norm(), 1e-14);
  }
}

// Cells of a scaffold have copies of the points that they share with the map.
TEST(Placement, CopiesOfPointsStayEqual) {
  const BezierMap map = map_to_place();
  const BezierMesh mesh =
      bezier_mesh(map.degree(), map.mesh().faces(), map.space().cells(), map.control_points());
  const PlacedMap placed = *into_unit_square(map, kAlong, kMeasured);
  const BezierMesh moved = placed.placement(mesh);
  const Cells& cells = map.space().cells();
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index l = 0; l < cells.cols(); ++l)
      EXPECT_EQ(moved.point(f, static_cast<int>(l)), control_point(placed.map, cells(f, l)));
}

TEST(Placement, WhatRoundingTurnsOverIsNoResult) {
  const auto mesh = surface(grid(1, bumpy));
  Vec uv(8);
  uv << 0, 0, 4, 0, 0, 4, 4, 4;  // units in the last place there
  uv.array() += 0x1.cp54;        // the sum of both beyond 2^55, where these are 8
  const BezierMap map = BezierMap::linear(mesh, uv);
  ASSERT_TRUE(measure_map(map, kMeasured).locally_injective);
  EXPECT_TRUE(turned_along(map, {1, 0}, kMeasured));
  EXPECT_FALSE(turned_along(map, kAlong, kMeasured));
}

// A trapezium, the longer of its parallel sides at x = 0.
struct Trapezium {
  Points2 uv{{0, -1}, {5, -0.25}, {5, 0.25}, {0, 1}};
  Cells cells{{0, 1, 2}, {0, 2, 3}};
};

TEST(PrincipalAxes, TheLongSideTowardsItsThinEnd) {
  for (const double angle : {0.0, 0.3, 2.0, -2.5}) {
    Trapezium layout;
    const Vector2 way = Eigen::Rotation2Dd(angle) * Vector2(1, 0);
    layout.uv = turned_along(layout.uv, {way.x(), -way.y()});
    EXPECT_LT((principal_direction(layout.uv, layout.cells) - way).norm(), 1e-12) << angle;
    const Points2 lying = turned_along(layout.uv, way);
    EXPECT_LT((principal_direction(lying, layout.cells) - Vector2(1, 0)).norm(), 1e-12);
  }
}

TEST(PrincipalAxes, WithoutALongSideItStays) {
  Trapezium square;
  square.uv = Points2{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(principal_direction(square.uv, square.cells), Vector2(1, 0));
  square.uv.setZero();
  EXPECT_EQ(principal_direction(square.uv, square.cells), Vector2(1, 0));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
