#include "majorant/parametrization/packing/pack.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "expected_error.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/exact_predicates.h"
#include "parametrization/packing/chart_cases.h"

namespace majorant {
namespace {

using test::Random;

void expect_packed(const std::vector<BezierMap>& charts, const PackOptions& options, int samples,
                   const std::string& name) {
  test::expect_valid(charts, pack(charts, options), options, samples, name);
}

TEST(Pack, one_chart_is_turned_into_its_box) {
  const BezierMap chart = test::polygon_chart(test::turned(test::rectangle(2, 1), 0.3, {5, 7}));
  const Packing packing = pack({chart});
  test::expect_valid({chart}, packing, {}, 1, "rectangle");
  const double border = 4.0 / 1024 * packing.side;
  EXPECT_NEAR(packing.side - 2 * border, 2, 1e-12);
  EXPECT_NEAR(packing.fill * packing.side * packing.side, 2, 1e-12);
  const auto nodes = packing.charts[0].control_points().reshaped(2, 4);
  EXPECT_NEAR(nodes.minCoeff(), packing.origin.minCoeff() + border, 1e-12);
}

TEST(Pack, charts_lie_as_they_are_without_quarter_turns) {
  const std::vector<BezierMap> charts(5, test::polygon_chart(test::rectangle(3, 1)));
  const auto upright = [](const Packing& packing) {
    int count = 0;
    for (const BezierMap& chart : packing.charts) {
      const auto nodes = chart.control_points().reshaped(2, 4);
      const Vector2 size = nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff();
      count += size.y() > size.x();
    }
    return count;
  };
  const PackOptions options{.quarter_turns = false};
  const Packing lying = pack(charts, options), any = pack(charts);
  test::expect_valid(charts, lying, options, 1, "without turns");
  EXPECT_TRUE(upright(lying) == 0 || upright(lying) == 5) << upright(lying);
  EXPECT_TRUE(upright(any) > 0 && upright(any) < 5) << upright(any);
  EXPECT_LT(any.side, lying.side);
}

TEST(Pack, polygons_keep_their_distance) {
  Random random(1);
  std::vector<BezierMap> convex, ells, combs, polygons, sizes;
  for (int k = 0; k < 12; ++k) {
    convex.push_back(test::polygon_chart(test::regular(3 + k, random.uniform(0.5, 2))));
    ells.push_back(test::polygon_chart(
        test::turned(test::ell(random.uniform(1, 3), 0.4), random.uniform(0, 6))));
    if (k < 4) combs.push_back(test::polygon_chart(test::comb(3 + k % 4, 4)));
  }
  for (int k = 0; k < 300; ++k) {
    polygons.push_back(test::polygon_chart(test::random_polygon(random, random.uniform(0.1, 1))));
    if (k < 60)
      sizes.push_back(
          test::polygon_chart(test::random_polygon(random, std::pow(10, -3 * (k / 59.0)))));
  }
  expect_packed(convex, {}, 1, "convex");
  expect_packed(ells, {}, 1, "L-shapes");
  expect_packed(combs, {.padding_pixels = 0}, 1, "combs, no padding");
  expect_packed(polygons, {}, 1, "polygons");
  expect_packed(sizes, {.padding_pixels = 2, .resolution = 256}, 1, "sizes");
}

TEST(Pack, a_thousand_triangles) {
  Random random(2);
  std::vector<BezierMap> triangles;
  for (int k = 0; k < 1000; ++k)
    triangles.push_back(test::polygon_chart(
        test::regular(3, random.uniform(0.5, 1), Vector2::Zero(), random.uniform(0, 6))));
  expect_packed(triangles, {.padding_pixels = 2}, 1, "triangles");
}

TEST(Pack, curved_charts_keep_their_distance) {
  std::vector<BezierMap> charts;
  for (int k = 0; k < 9; ++k) charts.push_back(test::wavy_chart(5 + k, 1 + 0.1 * k, 0.2, k));
  expect_packed(charts, {}, 40, "waves");
}

TEST(Pack, a_small_chart_may_lie_in_a_ring) {
  const std::vector<BezierMap> charts{test::ring_chart(24, 0.8, 1),
                                      test::polygon_chart(test::regular(7, 0.5))};
  const Packing packing = pack(charts);
  test::expect_valid(charts, packing, {}, 1, "ring");
  EXPECT_LT(packing.side, 2.04);  // beside it: 2.5 or more
}

TEST(Pack, fixed_charts_stay) {
  Random random(3);
  std::vector<BezierMap> charts;
  for (int k = 0; k < 12; ++k)
    charts.push_back(test::polygon_chart(
        test::turned(test::random_polygon(random, 1), 0, Vector2(7 + 3 * k, -2))));
  PackOptions options;
  options.fixed.assign(charts.size(), 0);
  options.fixed[2] = options.fixed[4] = 1;  // at distance 6
  expect_packed(charts, options, 1, "fixed");
}

TEST(Pack, any_unit_of_length_gives_the_same_layout) {
  Random random(4);
  std::vector<BezierMap> charts, tiny;
  for (int k = 0; k < 8; ++k) {
    charts.push_back(test::polygon_chart(test::random_polygon(random, 1)));
    const double scale = std::ldexp(1, -480);
    tiny.push_back(charts[k].with(charts[k].shared_space(), scale * charts[k].control_points()));
  }
  const Packing packing = pack(charts), small = pack(tiny);
  EXPECT_EQ(std::ldexp(small.side, 480), packing.side);
  EXPECT_EQ(small.fill, packing.fill);
  for (std::size_t k = 0; k < charts.size(); ++k)
    EXPECT_EQ(packing.charts[k].control_points(), pack(charts).charts[k].control_points());
}

TEST(Pack, tiles_have_borders_of_their_own) {
  Random random(11);
  std::vector<BezierMap> charts, curved;
  for (int k = 0; k < 60; ++k) {
    charts.push_back(test::polygon_chart(test::random_polygon(random, random.uniform(0.3, 1))));
    if (k < 8) curved.push_back(test::wavy_chart(6, random.uniform(0.5, 1), 0.2, k));
  }
  const Packing one = pack(charts);
  for (const int tiles : {2, 5, 13}) {
    const PackOptions options{.padding_pixels = 5, .resolution = 512, .tiles = tiles};
    const Packing packing = pack(charts, options);
    test::expect_valid(charts, packing, options, 1, "tiles");
    const std::set<int> used(packing.tiles.begin(), packing.tiles.end());
    EXPECT_EQ(*used.begin(), 0);
    EXPECT_EQ(*used.rbegin() + 1, static_cast<int>(used.size()));
    EXPECT_GT(static_cast<int>(used.size()), tiles / 2);
    EXPECT_LT(packing.side, 1.2 * one.side / std::sqrt(tiles));
    EXPECT_GE(packing.border, 5.0 / 512 * packing.side * (1 - 1e-12));
  }
  expect_packed(curved, {.padding_pixels = 0, .tiles = 3}, 16, "curved, no padding");
}

TEST(Pack, a_square_of_given_side) {
  Random random(12);
  std::vector<BezierMap> charts;
  for (int k = 0; k < 20; ++k)
    charts.push_back(test::polygon_chart(test::random_polygon(random, 1)));
  const double least = pack(charts).side;
  for (const double side : {1.05 * least, 3 * least, 57 * least}) {
    const PackOptions options{.side = side};
    const Packing packing = pack(charts, options);
    EXPECT_EQ(packing.side, side);
    test::expect_valid(charts, packing, options, 1, "given side");
  }
  for (const double part : {0.8, 1e-3, 1e-9, 1e-200})  // rasters of such charts need no memory
    expect_contains(
        error_message(ErrorKind::Unsupported, [&] { pack(charts, {.side = part * least}); }),
        {"times the side"});
  EXPECT_THROW(pack(charts, {.side = 0.0}), InvalidArgument);
  EXPECT_THROW(pack(charts, {.tiles = 0}), InvalidArgument);
  EXPECT_THROW(pack(charts, {.tiles = kMaxTiles + 1}), InvalidArgument);
  PackOptions held{.tiles = 2};
  held.fixed.assign(charts.size(), 1);
  EXPECT_THROW(pack(charts, held), InvalidArgument);
}

// The surface of these charts is the plane z = 0, in which they lie.
TEST(Pack, a_direction_of_the_surface_points_upwards) {
  Random random(13);
  std::vector<BezierMap> charts;
  for (int k = 0; k < 12; ++k)
    charts.push_back(test::polygon_chart(test::random_polygon(random, 1)));
  for (const double angle : {0.0, 0.4, 2.5, -1.0}) {
    const Vector2 along(std::cos(angle), std::sin(angle));
    const PackOptions options{.up = Vector3(3 * along.x(), 3 * along.y(), 0.7)};
    const Packing packing = pack(charts, options);
    test::expect_valid(charts, packing, options, 1, "upright");
    for (const LayoutMotion& motion : packing.placements) {
      const Points2 up = LayoutMotion{motion.direction}(Points2(along.transpose()));
      EXPECT_NEAR(up(0, 0), 0, 1e-8);
      EXPECT_NEAR(up(0, 1), 1, 1e-8);
    }
  }
  // A perpendicular direction has no effect: charts are turned for small boxes.
  const Packing across = pack(charts, {.up = Vector3(0, 0, 1)}), plain = pack(charts);
  EXPECT_EQ(across.side, plain.side);
}

// More charts than are nested.
TEST(Pack, the_same_charts_are_packed_the_same_way) {
  Random random(9);
  std::vector<BezierMap> charts;
  for (int k = 0; k < 45; ++k)
    charts.push_back(test::polygon_chart(test::random_polygon(random, random.uniform(0.3, 1))));
  const Packing one = pack(charts);
  EXPECT_EQ(one.method, PackMethod::Raster);
  for (int again = 0; again < 3; ++again) {
    const Packing other = pack(charts);
    EXPECT_EQ(one.side, other.side);
    for (std::size_t k = 0; k < charts.size(); ++k)
      EXPECT_EQ(one.charts[k].control_points(), other.charts[k].control_points());
  }
}

TEST(Pack, shelves_of_boxes_are_an_estimate) {
  const std::vector<Vector2> sizes{{3, 1}, {2, 1.5}, {1, 1}, {0.5, 0.2}};
  std::vector<BezierMap> charts;
  for (const Vector2& size : sizes)
    charts.push_back(test::polygon_chart(test::rectangle(size.x(), size.y())));
  const double estimate = side_of_shelves(sizes), side = pack(charts).side;
  EXPECT_GE(estimate, side * (1 - 1e-4));
  EXPECT_LE(estimate, 1.25 * side);
  EXPECT_NEAR(side_of_shelves({{2, 1}}), pack({charts[0]}).side * 2 / 3, 1e-4);
  EXPECT_EQ(side_of_shelves({{1, 1}, {1, 1}}, {.padding_pixels = 600}),
            std::numeric_limits<double>::infinity());
}

// The smallest box of a cross of five squares has an angle of 45 degrees.
TEST(Pack, straight_charts_lie_along_the_sides) {
  const test::Corners cross{{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2},
                            {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
  for (const double angle : {0.0, 0.2, 0.7, 1.5, 3.0}) {
    const Packing packing = pack({test::polygon_chart(test::turned(cross, angle, {4, 5}))});
    const auto uv = packing.charts[0].control_uv();
    EXPECT_NEAR((uv.colwise().maxCoeff() - uv.colwise().minCoeff()).maxCoeff(), 3, 1e-9) << angle;
  }
}

// A triangle so thin that rounding makes it degenerate in most rotations.
TEST(Pack, what_rounding_turns_over_is_turned_otherwise) {
  const double thin = std::ldexp(1, -60);
  const BezierMap triangle = test::polygon_chart(test::regular(3, 1));
  Vec x(6);
  x << 0, 0, 1, thin, 2, 3 * thin;
  const std::vector<BezierMap> charts{triangle.with(triangle.shared_space(), x),
                                      test::polygon_chart(test::regular(5, 1, Vector2(3, 3)))};
  expect_packed(charts, {}, 1, "thin");
  const Vec uv = pack(charts).charts[0].control_points();
  EXPECT_GT(orientation(Vector2(uv.head<2>()), Vector2(uv.segment<2>(2)), Vector2(uv.tail<2>())),
            0);
}

TEST(Pack, padding_that_leaves_no_room_is_refused) {
  const std::vector<BezierMap> charts(5, test::polygon_chart(test::regular(3, 1)));
  const std::string message = error_message(
      ErrorKind::Unsupported, [&] { pack(charts, {.padding_pixels = 1024, .resolution = 1024}); });
  expect_contains(message, {"5 charts", "padding"});
  EXPECT_THROW(pack(charts, {.padding_pixels = -1}), InvalidArgument);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
