// Layouts with images of faces that are thinner than the spacing of floats.
#include "majorant/io/float_room.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "majorant/mesh/exact_predicates.h"

namespace majorant {
namespace {

MapFile layout(const std::vector<Vector2>& uv, const std::vector<std::array<Index, 3>>& cells) {
  MapFile map;
  map.uv.resize(static_cast<Index>(uv.size()), 2);
  for (std::size_t k = 0; k < uv.size(); ++k) map.uv.row(static_cast<Index>(k)) = uv[k].transpose();
  map.points = Points3::Zero(map.uv.rows(), 3);
  map.points.leftCols(2) = map.uv;
  map.cells.resize(static_cast<Index>(cells.size()), 3);
  for (std::size_t c = 0; c < cells.size(); ++c)
    for (int k = 0; k < 3; ++k) map.cells(static_cast<Index>(c), k) = cells[c][to_size(k)];
  return map;
}

Vector2 as_read(const Vector2& uv) {
  return {static_cast<float>(uv.x()), 1 - static_cast<double>(static_cast<float>(1 - uv.y()))};
}

Index turned_over(const MapFile& map) {
  Index count = 0;
  for (Index c = 0; c < map.cells.rows(); ++c) {
    const auto corner = [&](int k) { return as_read(map.uv.row(map.cells(c, k))); };
    count += orientation(corner(0), corner(1), corner(2)) <= 0;
  }
  return count;
}

// Returns a fan of thin triangles around point 0, between two triangles, near the corner where
// floats have the largest spacing.
MapFile needles(int count, double height) {
  std::vector<Vector2> uv{{0.9, 0.05}, {0.95, 0.051}};
  std::vector<std::array<Index, 3>> cells;
  const Vector2 up = Vector2(-0.001, 0.05).normalized();
  for (int k = 1; k <= count; ++k) {
    uv.emplace_back(Vector2(0.95, 0.051) + k * height * up);
    cells.push_back({0, k, k + 1});
  }
  uv.emplace_back(0.91, 0.09);
  cells.push_back({0, count + 1, count + 2});
  uv.emplace_back(0.93, 0.01);
  cells.push_back({0, count + 3, 1});
  return layout(uv, cells);
}

TEST(FloatRoom, NeedlesGetRoom) {
  for (const int count : {1, 5, 40})
    for (const double height : {1e-8, 1e-11}) {
      const MapFile map = needles(count, height), rounded = with_room_in_floats(map, StoredV::Down);
      EXPECT_GT(turned_over(map), 0);
      EXPECT_EQ(turned_over(rounded), 0) << count << " " << height;
      EXPECT_LT((rounded.uv - map.uv).cwiseAbs().maxCoeff(), 1e-6 * (count + 1));
    }
}

// Rotated by 90 degrees: v is far from 0, where the spacing of floats of v is large.
TEST(FloatRoom, VIsStoredAsItIs) {
  MapFile map = needles(40, 1e-11);
  const Points2 given = map.uv;
  map.uv.col(0) = 1 - given.col(1).array();
  map.uv.col(1) = given.col(0);
  const auto turned = [](MapFile stored) {
    stored.uv = stored.uv.cast<float>().cast<double>();
    Index count = 0;
    for (Index c = 0; c < stored.cells.rows(); ++c) {
      const auto corner = [&](int k) -> Vector2 { return stored.uv.row(stored.cells(c, k)); };
      count += orientation(corner(0), corner(1), corner(2)) <= 0;
    }
    return count;
  };
  EXPECT_GT(turned(map), 0);
  EXPECT_EQ(turned(with_room_in_floats(map, StoredV::Up)), 0);
}

TEST(FloatRoom, APointIsMadeATriangle) {
  const MapFile map = layout(
      {{0.9, 0.1}, {0.9 + 1e-12, 0.1}, {0.9, 0.1 + 1e-12}, {0, 0}, {0.5, 0}, {0.5, 1}, {1, 0.5}},
      {{0, 1, 2}, {3, 4, 5}, {4, 6, 5}});
  EXPECT_EQ(turned_over(map), 1);
  EXPECT_EQ(turned_over(with_room_in_floats(map, StoredV::Down)), 0);
}

TEST(FloatRoom, SidesOfSlitsComeApart) {
  // A square without a wedge from its right side to its middle.
  const Vector2 middle(0.7, 0.31);
  for (const double width : {1e-9, 1e-12}) {
    const MapFile map = layout({{0.5, 0.1},
                                {0.9, 0.1},
                                {0.9, 0.31 - width},
                                middle,
                                {0.9, 0.31 + width},
                                {0.9, 0.5},
                                {0.5, 0.5}},
                               {{0, 1, 3}, {1, 2, 3}, {3, 4, 5}, {3, 5, 6}, {3, 6, 0}});
    EXPECT_EQ(as_read(map.uv.row(2)), as_read(map.uv.row(4)));
    const MapFile rounded = with_room_in_floats(map, StoredV::Down);
    EXPECT_EQ(turned_over(rounded), 0);
    EXPECT_LT(as_read(rounded.uv.row(2)).y(), as_read(rounded.uv.row(4)).y());
  }
}

TEST(FloatRoom, PointsThatFloatsDistinguishStay) {
  const MapFile map = layout({{0.1, 0.1}, {0.3, 0.1}, {0.1, 0.3}}, {{0, 1, 2}});
  EXPECT_EQ(with_room_in_floats(map, StoredV::Down).uv, map.uv);
}

TEST(FloatRoom, OverlappingSheetsStayOverlapping) {
  MapFile map = needles(3, 1e-9);
  const Index points = static_cast<Index>(map.uv.rows()), cells = map.cells.rows();
  Points2 uv(2 * points, 2);
  uv << map.uv, map.uv;
  Cells both(2 * cells, 3);
  both << map.cells, (map.cells.array() + points).matrix();
  map.uv = uv;
  map.cells = both;
  const MapFile rounded = with_room_in_floats(map, StoredV::Down);
  EXPECT_EQ(turned_over(rounded), 0);
  EXPECT_EQ(rounded.uv.topRows(points), rounded.uv.bottomRows(points));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
