// The tree of boxes against a loop over all boxes: random boxes, points, boxes on a line, copies of
// one, empty trees, coordinates that are large, small, infinite or NaN.
#include "majorant/mesh/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "random.h"

namespace majorant {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <int D>
std::vector<Box<D>> random_boxes(test::Random& random, int count, const std::string& kind) {
  using Point = typename Box<D>::Point;
  std::vector<Box<D>> boxes;
  for (int k = 0; k < count; ++k) {
    Point low, sides;
    for (int d = 0; d < D; ++d) {
      low[d] = random.uniform(0, 1);
      sides[d] = random.uniform(0, k % 11 == 0 ? 0.5 : 2.0 / std::pow(count, 1.0 / D));
    }
    if (kind == "points" || k % 7 == 0) sides.setZero();
    if (kind == "collinear") low.tail(D - 1).setConstant(0.25), sides.tail(D - 1).setZero();
    if (kind == "copies") low.setConstant(0.5), sides.setConstant(0.1);
    if (kind == "grid") low = (8 * low).array().floor() / 8, sides.setConstant(0.125);
    const double extent = kind == "large" ? 1e200 : kind == "small" ? 1e-200 : 1;
    const double origin = kind == "far" ? 3e7 : 0;
    boxes.push_back({(extent * low).array() + origin, (extent * (low + sides)).array() + origin});
    if (kind == "infinite" && k % 5 == 0) boxes.back().high.setConstant(kInfinity);
    if (kind == "infinite" && k % 3 == 0) boxes.back().low.setConstant(-kInfinity);
    if (kind == "no numbers" && k % 3 == 0) boxes.back().low[k % D] = NAN;
  }
  return boxes;
}

// Returns a corner of a box, or any point around all of them.
template <int D>
typename Box<D>::Point random_point_near(test::Random& random, const std::vector<Box<D>>& boxes,
                                         int k) {
  typename Box<D>::Point p;
  for (int d = 0; d < D; ++d) p[d] = random.uniform(-0.1, 1.6);
  if (boxes.empty()) return p;
  const Box<D>& box = boxes[to_size(k) % boxes.size()];
  if (k % 3 == 0) p = box.low;
  if (k % 5 == 0) p[0] = box.high[0];
  return p;
}

template <int D>
void expect_pairs(const std::vector<Box<D>>& boxes, const BoxTree<D>& tree) {
  std::vector<std::pair<Index, Index>> expected, found;
  const auto count = static_cast<Index>(boxes.size());
  for (Index i = 0; i < count; ++i)
    for (Index j = i + 1; j < count; ++j)
      if (boxes[to_size(i)].meets(boxes[to_size(j)])) expected.emplace_back(i, j);
  tree.visit_pairs([&](Index i, Index j) {
    found.emplace_back(i, j);
    return true;
  });
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
  std::size_t calls = 0;
  tree.visit_pairs([&](Index, Index) { return ++calls < 3; });
  EXPECT_EQ(calls, std::min<std::size_t>(3, expected.size()));
}

template <int D>
void expect_meeting(const std::vector<Box<D>>& boxes, const BoxTree<D>& tree,
                    test::Random& random) {
  for (int k = 0; k < 200; ++k) {
    Box<D> box;
    box.low = random_point_near(random, boxes, k);
    box.high = k % 2 == 0 ? box.low : box.low.cwiseMax(random_point_near(random, boxes, k + 1));
    if (k % 9 == 0) box.high[0] = kInfinity;
    std::vector<Index> expected, found, by_place;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (boxes[i].meets(box)) expected.push_back(static_cast<Index>(i));
    tree.visit_meeting(box, [&](Index i) { found.push_back(i); });
    tree.visit_places_meeting(box, [&](Index place) { by_place.push_back(tree.box_at(place)); });
    std::sort(found.begin(), found.end());
    std::sort(by_place.begin(), by_place.end());
    EXPECT_EQ(found, expected);
    EXPECT_EQ(by_place, expected);
  }
}

// Expects one visit of each box within the distance, and, up to rounding, no visit of others. With
// a shrinking distance, the nearest box is visited.
template <int D>
void expect_near(const std::vector<Box<D>>& boxes, const BoxTree<D>& tree, test::Random& random) {
  for (int k = 0; k < 200; ++k) {
    const auto p = random_point_near(random, boxes, k);
    const double square = k % 4 == 0 ? kInfinity : random.uniform(0, 0.1);
    std::vector<Index> expected, found;
    double least = kInfinity;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      least = std::min(least, boxes[i].squared_distance(p));
      if (boxes[i].squared_distance(p) <= square * (1 + 1e-14))
        expected.push_back(static_cast<Index>(i));
    }
    tree.visit_near(p, square, [&](Index i) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
    double shrinking = kInfinity;
    std::size_t calls = 0;
    tree.visit_near(p, shrinking, [&](Index i) {
      ++calls;
      shrinking = std::min(shrinking, boxes[to_size(i)].squared_distance(p));
    });
    EXPECT_EQ(shrinking, least);
    EXPECT_LE(calls, boxes.size());
  }
}

// Returns whether the ray intersects the box enlarged by `reach` on each side.
template <int D>
bool passes(const Ray<D>& ray, const Box<D>& box, double reach, double slack) {
  double enter = 0, leave = ray.last;
  for (int d = 0; d < D; ++d) {
    const double low = box.low[d] - reach - slack - ray.from[d];
    const double high = box.high[d] + reach + slack - ray.from[d];
    if (ray.along[d] == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    enter = std::max(enter, std::min(low / ray.along[d], high / ray.along[d]));
    leave = std::min(leave, std::max(low / ray.along[d], high / ray.along[d]));
  }
  return enter <= leave;
}

template <int D>
void expect_along(const std::vector<Box<D>>& boxes, const BoxTree<D>& tree, test::Random& random) {
  for (int k = 0; k < 200; ++k) {
    Ray<D> ray{random_point_near(random, boxes, k), {}};
    ray.along = random_point_near(random, boxes, k + 1) - ray.from;
    if (k % 4 == 0) ray.along[k % D] = 0;
    if (k % 7 == 0) ray.along.setZero();
    if (k % 2 == 0) ray.last = 1;
    const double reach = k % 6 == 0 ? 0.05 : 0;
    std::vector<char> is_found(boxes.size(), 0);
    tree.visit_along(ray, reach, [&](Index i) { return is_found[to_size(i)] = 1, true; });
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      EXPECT_TRUE(is_found[i] || !passes(ray, boxes[i], reach, -1e-12)) << k << " " << i;
      EXPECT_TRUE(!is_found[i] || passes(ray, boxes[i], reach, 1e-12)) << k << " " << i;
    }
    int calls = 0;
    tree.visit_along(ray, reach, [&](Index) { return ++calls < 2; });
    EXPECT_LE(calls, 2);
  }
}

template <int D>
void expect_all(const std::string& kind) {
  SCOPED_TRACE(kind);
  test::Random random(7);
  for (const int count : {0, 1, 3, 4, 5, 16, 17, 63, 64, 65, 300}) {
    SCOPED_TRACE(count);
    const std::vector<Box<D>> boxes = random_boxes<D>(random, count, kind);
    const BoxTree<D> tree(boxes);
    ASSERT_EQ(tree.size(), count);
    std::vector<Index> numbers;
    for (Index place = 0; place < tree.size(); ++place) numbers.push_back(tree.box_at(place));
    std::sort(numbers.begin(), numbers.end());
    for (Index i = 0; i < tree.size(); ++i) ASSERT_EQ(numbers[to_size(i)], i);
    expect_pairs(boxes, tree);
    expect_meeting(boxes, tree, random);
    const bool is_of_size_one = kind == "random" || kind == "points" || kind == "collinear" ||
                                kind == "copies" || kind == "grid";
    if (!is_of_size_one) continue;
    expect_near(boxes, tree, random);
    expect_along(boxes, tree, random);
  }
}

constexpr std::array<const char*, 10> kKinds = {"random",   "points",    "collinear", "copies",
                                                "grid",     "large",     "small",     "far",
                                                "infinite", "no numbers"};

TEST(BoxTree, AgreesWithAllBoxesOfThePlane) {
  for (const char* kind : kKinds) expect_all<2>(kind);
}

TEST(BoxTree, AgreesWithAllBoxesOfSpace) {
  for (const char* kind : kKinds) expect_all<3>(kind);
}

TEST(BoxTree, BoxesOnALineAndAtAPoint) {
  std::vector<Box2> boxes;
  for (int k = 0; k < 50; ++k) boxes.push_back({Vector2(k, 2), Vector2(k + 1.5, 2)});
  const BoxTree<2> line(boxes);
  std::vector<Index> found;
  line.visit_meeting({{7.25, 2}, {7.25, 2}}, [&](Index i) { found.push_back(i); });
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<Index>{6, 7}));
  const BoxTree<2> same(std::vector<Box2>(9, {Vector2(1, 2), Vector2(1, 2)}));
  int count = 0;
  same.visit_meeting({{1, 2}, {1, 2}}, [&](Index) { ++count; });
  EXPECT_EQ(count, 9);
  same.visit_meeting({{1, 2.5}, {1, 2.5}}, [&](Index) { ++count; });
  EXPECT_EQ(count, 9);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
