// The boxes around a point: all of those that contain it, each once, and others by no more than
// single precision, wherever the boxes lie and however large they are.
#include "majorant/certify/internal/stabbing_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace majorant {
namespace {

std::vector<Box2> random_boxes(int count, double extent, const Vector2& origin, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0, 1);
  std::vector<Box2> boxes;
  for (int k = 0; k < count; ++k) {
    const Vector2 low(part(random), part(random));
    const double size = k % 7 == 0 ? 0 : k % 11 == 0 ? 0.5 : 2 / std::sqrt(count);
    const Vector2 sides(size * part(random), size * part(random));
    boxes.push_back({origin + extent * low, origin + extent * (low + sides)});
  }
  return boxes;
}

void expect_all(const std::vector<Box2>& boxes, double extent, const Vector2& origin) {
  const StabbingTree tree(boxes);
  ASSERT_EQ(tree.size(), static_cast<Index>(boxes.size()));
  std::vector<Index> numbers;
  for (Index place = 0; place < tree.size(); ++place) numbers.push_back(tree.box_at(place));
  std::sort(numbers.begin(), numbers.end());
  for (Index i = 0; i < tree.size(); ++i) ASSERT_EQ(numbers[to_size(i)], i);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> part(-0.1, 1.6);
  for (int k = 0; k < 500; ++k) {
    Vector2 p = origin + extent * Vector2(part(random), part(random));
    if (k % 3 == 0 && !boxes.empty()) p = boxes[to_size(k) % boxes.size()].low;
    if (k % 5 == 0 && !boxes.empty()) p.x() = boxes[to_size(k) % boxes.size()].high.x();
    std::vector<Index> found;
    tree.visit(p, [&](Index place) { found.push_back(tree.box_at(place)); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
    const double slack = 1e-6 * extent;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const bool is_found = std::binary_search(found.begin(), found.end(), static_cast<Index>(i));
      const bool contains = boxes[i].meets({p, p});
      const bool is_near = boxes[i].meets({p - Vector2(slack, slack), p + Vector2(slack, slack)});
      EXPECT_TRUE(is_found || !contains) << i << " of " << boxes.size();
      EXPECT_TRUE(is_near || !is_found) << i << " of " << boxes.size();
    }
  }
}

TEST(StabbingTree, FindsAllThatContainAPoint) {
  for (const int count : {0, 1, 3, 4, 5, 16, 17, 63, 64, 65, 300, 1500})
    expect_all(random_boxes(count, 1, {0, 0}, 2), 1, {0, 0});
}

// Single precision would not tell these apart from where they lie, nor hold how large they are.
TEST(StabbingTree, FarAwayLargeAndSmall) {
  expect_all(random_boxes(400, 1, {1e7, -3e7}, 3), 1, {1e7, -3e7});
  expect_all(random_boxes(400, 1e200, {0, 0}, 4), 1e200, {0, 0});
  expect_all(random_boxes(400, 1e-200, {0, 0}, 5), 1e-200, {0, 0});
}

TEST(StabbingTree, BoxesOnALineAndAtAPoint) {
  std::vector<Box2> boxes;
  for (int k = 0; k < 50; ++k) boxes.push_back({Vector2(k, 2), Vector2(k + 1.5, 2)});
  const StabbingTree line(boxes);
  std::vector<Index> found;
  line.visit({7.25, 2}, [&](Index place) { found.push_back(line.box_at(place)); });
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<Index>{6, 7}));
  const StabbingTree same(std::vector<Box2>(9, {Vector2(1, 2), Vector2(1, 2)}));
  int count = 0;
  same.visit({1, 2}, [&](Index) { ++count; });
  EXPECT_EQ(count, 9);
  same.visit({1, 2.5}, [&](Index) { ++count; });
  EXPECT_EQ(count, 9);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
