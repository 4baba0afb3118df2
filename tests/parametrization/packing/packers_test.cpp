// Each packer, and its input.
#include <gtest/gtest.h>

#include <cmath>

#include "majorant/parametrization/packing/internal/nesting.h"
#include "majorant/parametrization/packing/internal/outer_polygon.h"
#include "majorant/parametrization/packing/internal/raster.h"
#include "majorant/parametrization/packing/internal/skyline.h"
#include "parametrization/packing/chart_cases.h"

namespace majorant {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

using test::Corners;
using test::Random;

std::vector<BezierMap> mixed_charts() {
  Random random(5);
  std::vector<BezierMap> charts{test::ring_chart(16, 0.7, 1), test::wavy_chart(7, 1, 0.25, 1)};
  for (int k = 0; k < 20; ++k)
    charts.push_back(test::polygon_chart(test::random_polygon(random, random.uniform(0.2, 1))));
  return charts;
}

// Returns positions of charts, from the packer's own numbers.
std::vector<std::vector<Corners>> placed(const PackingJob& job, const Strip& strip) {
  std::vector<std::vector<Corners>> all;
  for (std::size_t k = 0; k < job.charts.size(); ++k) {
    all.push_back(job.charts[k].outline.loops);
    for (Corners& loop : all.back())
      for (Vector2& p : loop)
        p = quarter_turned(p, strip.poses[k].quarters, job.charts[k].size) + strip.poses[k].low;
  }
  return all;
}

TEST(Packers, each_keeps_the_gap_inside_of_its_strip) {
  const std::vector<BezierMap> charts = mixed_charts();
  const PackingJob job =
      packing_job(charts, std::vector<AllowedRotations>(charts.size()), 4.0 / 1024);
  const double width = 1.6 * std::sqrt(job.area);
  std::vector<std::optional<Strip>> strips{skyline_strip(job, width),
                                           raster_strip(job, 512, width)};
#ifdef MAJORANT_NO_GPL
  EXPECT_FALSE(nested_strip(job, width).has_value());
#else
  strips.push_back(nested_strip(job, width));
#endif
  for (const std::optional<Strip>& strip : strips) {
    ASSERT_TRUE(strip);
    const auto all = placed(job, *strip);
    double least = width;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t j = 0; j < all.size(); ++j)
        for (const Corners& a : all[i])
          for (const Corners& b : all[j])
            for (const Vector2& p : a) {
              EXPECT_TRUE(p.minCoeff() >= -1e-9 && p.x() <= width + 1e-9 &&
                          p.y() <= strip->height + 1e-9);
              if (i == j) continue;
              EXPECT_FALSE(test::inside(all[j], p));
              for (const Vector2& q : b) least = std::min(least, (p - q).norm());
            }
    EXPECT_GE(least, job.gap * width);
  }
}

TEST(Packers, the_smallest_box_is_found) {
  Random random(6);
  for (int k = 0; k < 50; ++k) {
    const BezierMap chart = test::polygon_chart(test::random_polygon(random, 1));
    const ChartOutline outline = chart_outline(chart, 1, 1e-3);
    double least = 1e300;
    for (int step = 0; step < 2000; ++step) {
      const Corners points =
          test::turned(test::sampled_boundary(chart, 1)[0], step * std::numbers::pi / 2000);
      Vector2 low = points[0], high = low;
      for (const Vector2& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
      least = std::min(least, (high - low).prod());
    }
    EXPECT_LE(outline.size.prod(), least * (1 + 2e-6));
    EXPECT_GE(outline.size.x(), outline.size.y());
  }
}

TEST(Packers, polygons_around_outlines_contain_them) {
  Random random(7);
  for (int k = 0; k < 60; ++k) {
    Corners polygon = test::regular(60, 1);
    for (Vector2& p : polygon) p *= random.uniform(0.5, 1);
    const Corners around = outer_polygon(polygon, 12);
    EXPECT_LE(around.size(), 30u);
    double area = 0;
    for (std::size_t i = 0; i < around.size(); ++i)
      area += cross(around[i], around[(i + 1) % around.size()]) / 2;
    EXPECT_LT(area, 4);
    for (const Vector2& p : polygon) EXPECT_TRUE(test::inside({around}, p * (1 - 1e-12)));
  }
}

TEST(Packers, outer_polygons_of_convex_ones_have_as_many_corners_as_asked_for) {
  Corners round;
  for (int k = 0; k < 60; ++k)
    round.emplace_back(std::cos(k * 6 * kDegree), std::sin(k * 6 * kDegree));
  const Corners around = outer_polygon(round, 12);
  EXPECT_EQ(around.size(), 12u);
  for (const Vector2& p : round) EXPECT_TRUE(test::inside({around}, p * (1 - 1e-12)));
}

// Points at the requested distance from the curve lie in the cells.
TEST(Packers, cells_cover_curves_and_what_is_around_them) {
  const BezierMap chart = test::wavy_chart(6, 1, 0.25, 0.5);
  const ChartOutline outline = chart_outline(chart, 1, 1e-2);
  EXPECT_GT(outline.outline.reach, 0);
  Eigen::Matrix2d R;
  R << outline.cosine, -outline.sine, outline.sine, outline.cosine;
  const double cell = 0.05, distance = 0.11;
  const Corners boundary = test::sampled_boundary(chart, 60)[0];
  for (int quarters = 0; quarters < 4; ++quarters) {
    const CellRuns runs = cells_of(outline, quarters, Vector2(0.3, 0.2), cell, distance);
    for (const Vector2& on : boundary)
      for (int k = 0; k < 16; ++k) {
        const Vector2 p = quarter_turned(R * on - outline.low, quarters, outline.size) +
                          Vector2(0.3, 0.2) +
                          distance * Vector2(std::cos(k * 0.4), std::sin(k * 0.4));
        const int row = static_cast<int>(std::floor(p.y() / cell)),
                  column = static_cast<int>(std::floor(p.x() / cell));
        EXPECT_TRUE(std::any_of(runs.begin(), runs.end(), [&](const CellRun& run) {
          return run.row == row && run.begin <= column && column < run.end;
        }));
      }
  }
}

TEST(Packers, pack_is_never_worse_than_shelves) {
  const std::vector<BezierMap> charts = mixed_charts();
  const double inner = 1024 - 2 * 4;  // pixels within the border
  const PackingJob job =
      packing_job(charts, std::vector<AllowedRotations>(charts.size()), 4 / inner * (1 + 1e-5));
  const auto shelves = smallest_square(job, [&](double width) { return skyline_strip(job, width); },
                                       {1.5 * std::sqrt(job.area), 1.25, 14});
  ASSERT_TRUE(shelves);
  const double side = shelves->side * 1024 / inner;
  EXPECT_GE(pack(charts).fill, job.area / (side * side) * (1 - 1e-12));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
