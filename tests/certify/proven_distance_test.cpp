#include "majorant/certify/proven_distance.h"

#include <gtest/gtest.h>

#include "parametrization/packing/chart_cases.h"

namespace majorant {
namespace {

BezierMap square_at(double x, double y, double size = 1) {
  return test::polygon_chart(test::turned(test::rectangle(size, size), 0, {x, y}));
}

TEST(ProvenDistance, of_squares_is_known) {
  EXPECT_NEAR(proven_distance({square_at(0, 0), square_at(1.25, 0)}, 1), 0.25, 1e-13);
  EXPECT_NEAR(proven_distance({square_at(0, 0), square_at(4, 5)}, 10), 5, 1e-13);
  EXPECT_EQ(proven_distance({square_at(0, 0), square_at(1.25, 0)}, 0.125), 0.125);
  EXPECT_EQ(proven_distance({square_at(0, 0)}, 3), 3);
  EXPECT_LE(proven_distance({square_at(0, 0), square_at(1.25, 0)}, 1), 0.25);
}

TEST(ProvenDistance, overlaps_touching_and_nesting_are_none) {
  EXPECT_EQ(proven_distance({square_at(0, 0), square_at(0.5, 0.5)}, 1), 0);
  EXPECT_EQ(proven_distance({square_at(0, 0), square_at(1, 0)}, 1), 0);
  EXPECT_EQ(proven_distance({square_at(0, 0), square_at(0.4, 0.4, 0.2)}, 0.1), 0);
  EXPECT_EQ(proven_distance({square_at(0, 0), square_at(0, 0)}, 0.1), 0);
  const BezierMap ring = test::ring_chart(40, 0.8, 1), inner = square_at(-0.1, -0.1, 0.2);
  EXPECT_EQ(proven_distance({ring, inner}, 0.25), 0.25);  // in its hole
  EXPECT_EQ(proven_distance({ring, square_at(0.85, 0, 0.01)}, 1e-3), 0);
  for (const double phase : {0.5, 1.0, 2.0})  // curves that cross
    EXPECT_EQ(
        proven_distance({test::wavy_chart(5, 1, 0.2, 0), test::wavy_chart(6, 1, 0.2, phase)}, 0.1),
        0);
}

TEST(ProvenDistance, two_fixed_charts_are_left_out) {
  const std::vector<BezierMap> charts{square_at(0, 0), square_at(0.5, 0), square_at(3, 0)};
  EXPECT_EQ(proven_distance(charts, 0.25, {1, 1, 0}), 0.25);
  EXPECT_EQ(proven_distance(charts, 0.25, {1, 0, 0}), 0);
}

// Against dense samples, whose distance is at least that of the curves.
TEST(ProvenDistance, of_curves_is_tight_and_below_that_of_samples) {
  test::Random random(8);
  for (int k = 0; k < 20; ++k) {
    const BezierMap a = test::wavy_chart(5, 1, 0.2, random.uniform(0, 6));
    const BezierMap b = test::wavy_chart(6, 0.5, 0.2, random.uniform(0, 6));
    Vec x = b.control_points();
    for (Index i = 0; i < x.size(); i += 2) x[i] += random.uniform(1.6, 2);
    const BezierMap moved = b.with(b.shared_space(), x);
    const test::Corners of_a = test::sampled_boundary(a, 200)[0],
                        of_b = test::sampled_boundary(moved, 200)[0];
    double sampled = 1e300;
    for (const Vector2& p : of_a)
      for (const Vector2& q : of_b) sampled = std::min(sampled, (p - q).norm());
    const double proven = proven_distance({a, moved}, 10);
    EXPECT_LE(proven, sampled);
    EXPECT_GE(proven, 0.99 * sampled - 5e-4);
  }
}

// Returns a square ring that is open at its right side, where its ends are `gap` apart.
BezierMap open_ring(double gap, double lean = 0) {
  return test::polygon_chart({{0, 0},
                              {4, 0},
                              {4, 2 - gap / 2},
                              {3, 2 - gap / 2 - lean},
                              {2.9, 1},
                              {1, 1},
                              {1, 3},
                              {2.9, 3},
                              {3, 2 + gap / 2 + lean},
                              {4, 2 + gap / 2},
                              {4, 4},
                              {0, 4}});
}

TEST(BorderClearance, is_that_across_the_outside) {
  for (const double gap : {0.5, 1e-3, 1e-9})
    EXPECT_NEAR(border_clearance(open_ring(gap), {.at_least = 1}), gap, 1e-15);
  EXPECT_NEAR(border_clearance(open_ring(0.01, 0.1), {.at_least = 1}), 0.01, 1e-15);
  EXPECT_EQ(border_clearance(open_ring(0.5), {.at_least = 0.25}), 0.25);
  EXPECT_NEAR(border_clearance(test::ring_chart(40, 0.5, 1), {.at_least = 0.1}), 0.1, 1e-15);
}

TEST(BorderClearance, thin_charts_and_wide_corners_have_room) {
  EXPECT_EQ(border_clearance(square_at(0, 0), {.at_least = 1}), 1);
  EXPECT_EQ(border_clearance(test::polygon_chart(test::rectangle(1, 1e-6)), {.at_least = 1}), 1);
  // A notch of 90 degrees in a square.
  const BezierMap notch =
      test::polygon_chart({{0, 0}, {4, 0}, {4, 4}, {2.5, 4}, {2, 3.5}, {1.5, 4}, {0, 4}});
  EXPECT_EQ(border_clearance(notch, {.at_least = 4}), 4);
}

// Panels of a frame and a sill with one side on the frame: they are neighbours at their common
// vertex, and touch at the next corner.
TEST(BorderClearance, a_fold_along_an_edge_is_none) {
  for (const double above : {0.0, 1e-17, 1e-9, 1e-7}) {
    const BezierMap chart = test::chart_of(
        {{0, 0}, {1, 0}, {3, 0}, {3, -1}, {0, -1}, {0, 2}, {1, 2}, {2, 2}, {2, above}},
        {{0, 4, 3, 2, 1}, {0, 1, 6, 5}, {1, 8, 7, 6}});
    EXPECT_NEAR(border_clearance(chart, {.at_least = 1e-6, .way = 1e5}), above, 1e-15);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
