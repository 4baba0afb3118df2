// Layouts rotated and translated before their certificate, and their directions.
#include "majorant/certify/moved_layout.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "certify/valley.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/maps/smallest_rectangle.h"
#include "majorant/parametrization/solve/parametrize.h"
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

TEST(Placement, TurnsEveryPointAndMeasuresTheResult) {
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

TEST(Placement, TheUnitSquareHoldsTurnedLayouts) {
  const BezierMap map = map_to_place();
  const std::optional<PlacedMap> placed = into_unit_square(map, kAlong, kMeasured);
  ASSERT_TRUE(placed);
  const auto nodes = placed->map.control_points().reshaped(2, map.space().node_count());
  EXPECT_EQ(nodes.rowwise().minCoeff(), Vector2::Zero());
  EXPECT_EQ(nodes.maxCoeff(), 1);
  EXPECT_NEAR(placed->measures.value, measure_map(map, kMeasured).value, 1e-9);
  const auto& [direction, origin, size, rounding] = placed->placement;
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

TEST(Placement, LayoutsInvertedByRoundingAreRejected) {
  const auto mesh = surface(grid(1, bumpy));
  Vec uv(8);
  uv << 0, 0, 4, 0, 0, 4, 4, 4;  // units in the last place there
  uv.array() += 0x1.cp54;        // the sum of both is above 2^55, where these are 8
  const BezierMap map = BezierMap::linear(mesh, uv);
  ASSERT_TRUE(measure_map(map, kMeasured).locally_injective);
  EXPECT_TRUE(turned_along(map, {1, 0}, kMeasured));
  EXPECT_FALSE(turned_along(map, kAlong, kMeasured));
}

// Returns one face whose least det J is a millionth of the largest: bounds with rounding do not
// decide its sign, exact arithmetic does. A face accepted this way before a motion is accepted
// afterwards.
BezierMap deep_valley() { return test::valley_map(1.0 / 3, 0x1p-21); }

TEST(MovedLayout, CellsUndecidedByBoundsAreDecidedExactly) {
  const BezierMap map = deep_valley();
  ASSERT_FALSE(measure_map(map, kMeasured).locally_injective);  // by bounds alone
  EXPECT_TRUE(has_positive_determinants(map));
  const std::optional<PlacedMap> placed = into_unit_square(map, {1, 0}, kMeasured);
  ASSERT_TRUE(placed);
  EXPECT_TRUE(placed->measures.locally_injective);
  const Vec moved = map.control_points().array() + 1;  // rounds only digits below 2^-52
  EXPECT_TRUE(turned_along(map.with(map.shared_space(), moved), kAlong, kMeasured));
  Vec mirrored = map.control_points();
  for (Index k = 0; k < mirrored.size(); k += 2) mirrored[k] = -mirrored[k];
  EXPECT_FALSE(has_positive_determinants(map.with(map.shared_space(), mirrored)));
}

// A large translation makes small cells degenerate by rounding; a division by a power of two
// without translation is exact.
TEST(MovedLayout, TheUnitSquareWithoutATranslation) {
  const auto mesh = surface(grid(1, bumpy));
  Vec uv(8);
  uv << 0x1p-70, 0x1p-70, 0x1.8p-70, 0x1p-70, 0x1p-70, 0x1.8p-70, 1, 1;
  const BezierMap map = BezierMap::linear(mesh, uv);
  ASSERT_TRUE(has_positive_determinants(map));
  const Vector2 low(1.0 / 3, 1.0 / 3);  // of a square that is larger than its charts
  EXPECT_FALSE(moved_layout({map}, {{{1, 0}, low, 1}}));
  const std::optional<MovedLayout> moved =
      moved_layout({map}, unit_square_motions({1, 0}, low, 0.6));
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->motion.origin, Vector2::Zero());
  EXPECT_EQ(moved->maps.front().control_points(), map.control_points());
}

// Also at size 1, where the division is exact and only the rotation rounds.
TEST(MovedLayout, TheLeastCoordinatesBecomeZeroExactly) {
  const Points2 uv = Points2::Random(200, 2);
  for (int k = 1; k < 50; ++k) {
    const Vector2 direction(std::cos(0.1 * k), std::sin(0.1 * k));
    const Vector2 low = LayoutMotion{direction}(uv).colwise().minCoeff();
    for (const double side : {0.75, 1.0, 3.0})
      for (const LayoutMotion& motion : unit_square_motions(direction, low, side)) {
        if (motion.origin != low) continue;
        EXPECT_EQ(motion(uv).colwise().minCoeff(), Vector2::Zero().transpose()) << motion.size;
      }
  }
}

TEST(MovedLayout, MeetsItsRequirements) {
  const BezierMap map = map_to_place();
  const BezierMap beside = LayoutMotion{{1, 0}, {-8, 0}, 1}(map);
  EXPECT_TRUE(moved_layout({map, beside}, {{}}, {.distance = 4}));
  EXPECT_FALSE(moved_layout({map, beside}, {{}}, {.distance = 16}));
  EXPECT_TRUE(moved_layout({map, beside}, {{}}, {.distance = 16, .fixed = {1, 1}}));
  EXPECT_FALSE(moved_layout({map, map}, {{}}, {.distance = 16, .fixed = {1, 1}}));
  EXPECT_EQ(moved_layout({map, beside}, {{{1, 0}, {0, 0}, 2}}, {true, 4})->motion.size, 2);
}

Points2 along(const Points2& uv, const Vector2& direction) { return LayoutMotion{direction}(uv); }

// A rectangle and a point that no cell uses.
struct Sheet {
  Points2 uv{{0, 0}, {5, 0}, {5, 2}, {0, 2}, {50, 90}};
  Cells cells{{0, 1, 2}, {0, 2, 3}};
};

TEST(LayoutDirection, TheLongerSideOfTheSmallestRectangle) {
  for (const double scale : {1.0, 1e-300, 1e300})
    for (const double angle : {0.0, 0.3, 0.8, 1.5, -1.5}) {
      Sheet sheet;
      const Vector2 way = Eigen::Rotation2Dd(angle) * Vector2(1, 0);
      sheet.uv = scale * along(sheet.uv, {way.x(), -way.y()});
      EXPECT_LT((layout_direction(sheet.uv, sheet.cells) - way).norm(), 1e-12) << angle << scale;
      const Points2 lying = along(sheet.uv, way);
      EXPECT_EQ(layout_direction(lying, sheet.cells), Vector2(1, 0)) << angle << scale;
    }
}

// All directions are principal axes of a square.
TEST(LayoutDirection, ATurnedSquareBecomesUpright) {
  Sheet square;
  square.uv.topRows(4) = Points2{{1, 0}, {2, 1}, {1, 2}, {0, 1}};
  const Points2 lying = along(square.uv, layout_direction(square.uv, square.cells));
  const Vector2 size =
      lying.topRows(4).colwise().maxCoeff() - lying.topRows(4).colwise().minCoeff();
  EXPECT_NEAR(size.x(), std::sqrt(2), 1e-14);
  EXPECT_NEAR(size.y(), std::sqrt(2), 1e-14);
}

TEST(LayoutDirection, WithoutALongerSideItStays) {
  Sheet sheet;
  sheet.uv.topRows(4) = Points2{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(layout_direction(sheet.uv, sheet.cells), Vector2(1, 0));
  sheet.uv.setZero();
  EXPECT_EQ(layout_direction(sheet.uv, sheet.cells), Vector2(1, 0));
  EXPECT_EQ(layout_direction(sheet.uv, Cells(0, 3)), Vector2(1, 0));
}

// Vertical layouts become horizontal, also those on a line.
TEST(LayoutDirection, AVerticalLineBecomesHorizontal) {
  Sheet sheet;
  sheet.uv.topRows(4) = Points2{{0, 0}, {0, 1}, {0, 3}, {0, 2}};
  EXPECT_EQ(layout_direction(sheet.uv, sheet.cells), Vector2(0, 1));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
