// Constrained Delaunay triangulations of random, collinear, cocircular and nearly degenerate
// points: their defining properties, and equal faces by both implementations.
#include "majorant/mesh/constrained_delaunay.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "majorant/mesh/exact_predicates.h"
#include "random.h"

namespace majorant {
namespace {

enum class Kind { Square, Line, Grid, Circle, Clusters, Parabola, Scales, Strip, FewPlaces, Last };

// Returns points, some of which may coincide.
std::vector<Vector2> points_of(Kind kind, int count, test::Random& random) {
  std::vector<Vector2> points;
  const int side = 1 + static_cast<int>(std::sqrt(count));
  for (int k = 0; k < count; ++k) {
    const double x = random.uniform(0, 1), y = random.uniform(0, 1);
    const Vector2 direction(std::cos(2 * std::numbers::pi * x), std::sin(2 * std::numbers::pi * x));
    switch (kind) {
      case Kind::Square:
        points.emplace_back(x, y);
        break;
      case Kind::Line:  // rounding moves some points off the line
        points.emplace_back(x, x / 3);
        break;
      case Kind::Grid:
        points.emplace_back(random.integer(0, side), random.integer(0, side));
        break;
      case Kind::Circle:  // nearest doubles of a circle, and Pythagorean points
        points.push_back(k % 2 == 0 ? direction : Vector2(k % 3 == 0 ? 0.6 : 0.28, 0.8));
        if (k % 2 == 1 && k % 3 != 0) points.back().y() = 0.96;
        break;
      case Kind::Clusters:
        points.emplace_back(0.1 * (k % 7) + 1e-3 * x, 1 + 1e-12 * y);
        break;
      case Kind::Parabola:
        points.emplace_back(x, x * x);
        break;
      case Kind::Scales:
        points.push_back(std::pow(10.0, -200 * y) * direction);
        break;
      case Kind::Strip:  // long and thin, so that constraints cross many faces
        points.emplace_back(x, 1e-3 * y);
        break;
      default:
        points.emplace_back(random.integer(0, 4), random.integer(0, 4));
    }
  }
  return points;
}

// Returns edges by their smaller and larger vertex, and whether they are constrained.
template <PlaneTriangulation Delaunay>
std::set<std::tuple<Index, Index, bool>> edges_of(const Delaunay& delaunay) {
  std::set<std::tuple<Index, Index, bool>> edges;
  for (const auto face : delaunay.finite_faces())
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] =
          std::minmax({delaunay.vertex(face, (i + 1) % 3), delaunay.vertex(face, (i + 2) % 3)});
      edges.insert({a, b, delaunay.is_constrained(face, i)});
    }
  return edges;
}

// Checks that neighbors agree, triangles are positive, edges without constraint are Delaunay, and
// faces cover the convex hull. Returns the violated property.
template <PlaneTriangulation Delaunay>
std::string defect_of(const Delaunay& delaunay) {
  std::size_t hull = 0;
  for (const auto face : delaunay.finite_faces()) {
    std::array<Index, 3> v = {delaunay.vertex(face, 0), delaunay.vertex(face, 1),
                              delaunay.vertex(face, 2)};
    const auto at = [&](int i) -> const Vector2& { return delaunay.point(v[to_size(i % 3)]); };
    if (orientation(at(0), at(1), at(2)) <= 0) return "a triangle is not positive";
    for (int i = 0; i < 3; ++i) {
      const auto beyond = delaunay.neighbor(face, i);
      int j = 0;
      while (j < 3 && !(delaunay.neighbor(beyond, j) == face &&
                        delaunay.vertex(beyond, (j + 1) % 3) == v[to_size((i + 2) % 3)]))
        ++j;
      if (j == 3 || delaunay.vertex(beyond, (j + 2) % 3) != v[to_size((i + 1) % 3)])
        return "neighbors do not agree";
      if (delaunay.is_constrained(beyond, j) != delaunay.is_constrained(face, i))
        return "an edge is constrained on one side alone";
      if (!delaunay.is_finite(beyond)) {
        ++hull;
        // The next edge of the hull turns left or is collinear.
        const auto next = delaunay.neighbor(beyond, (j + 2) % 3);
        for (int k = 0; k < 3; ++k)
          if (delaunay.vertex(next, k) != v[to_size((i + 1) % 3)] &&
              delaunay.vertex(next, k) >= 0 &&
              orientation(at(i + 1), at(i + 2), delaunay.point(delaunay.vertex(next, k))) < 0)
            return "the hull is not convex";
      } else if (!delaunay.is_constrained(face, i) &&
                 in_circle(at(0), at(1), at(2), delaunay.point(delaunay.vertex(beyond, j))) > 0) {
        return "an edge is not Delaunay";
      }
    }
  }
  if (delaunay.finite_faces().size() + hull + 2 != 2 * to_size(delaunay.vertex_count()))
    return "faces are missing";
  return "";
}

// Returns whether the pieces of a constraint are constrained edges.
template <PlaneTriangulation Delaunay>
bool has_constraint(const Delaunay& delaunay, Index a, Index b) {
  while (a != b) {
    bool goes_on = false;
    for (const auto face : delaunay.faces_around(a))
      for (int i = 0; i < 3 && !goes_on; ++i) {
        const Index q = delaunay.vertex(face, (i + 2) % 3);
        if (delaunay.vertex(face, (i + 1) % 3) != a || q < 0 || !delaunay.is_constrained(face, i) ||
            !on_segment(delaunay.point(a), delaunay.point(b), delaunay.point(q)))
          continue;
        goes_on = true;
        a = q;
      }
    if (!goes_on) return false;
  }
  return true;
}

// The triangulation of the points with the constraints, in their order, until one is impossible.
template <PlaneTriangulation Delaunay>
struct Attempt {
  Delaunay delaunay;
  std::vector<Index> vertices;
  std::vector<bool> inserted;

  Attempt(const std::vector<Vector2>& points, const std::vector<std::pair<int, int>>& constraints,
          bool one_by_one) {
    if (one_by_one)
      for (const Vector2& p : points) vertices.push_back(delaunay.insert(p));
    else
      vertices = delaunay.insert(points);
    if (delaunay.is_flat()) return;
    for (const auto& [a, b] : constraints) {
      if (vertices[to_size(a)] == vertices[to_size(b)]) continue;
      inserted.push_back(delaunay.insert_constraint(vertices[to_size(a)], vertices[to_size(b)]));
      if (!inserted.back()) break;
    }
  }
};

std::vector<std::pair<int, int>> random_constraints(int points, test::Random& random) {
  std::vector<std::pair<int, int>> constraints;
  for (int k = random.integer(0, 12); k > 0; --k)
    constraints.emplace_back(random.integer(0, points - 1), random.integer(0, points - 1));
  // Some constraints start at the ends of others.
  for (std::size_t k = 1; k < constraints.size(); k += 2)
    constraints[k].first = constraints[k - 1].second;
  return constraints;
}

constexpr int kPointKinds = static_cast<int>(Kind::Last);

TEST(ConstrainedDelaunay, IsValid) {
  test::Random random(1);
  for (int round = 0; round < 2000; ++round) {
    const int count = round % 100 == 0 ? 1000 : random.integer(1, 60);
    const auto points = points_of(static_cast<Kind>(round % kPointKinds), count, random);
    const auto constraints = random_constraints(count, random);
    const Attempt<IncrementalDelaunay> attempt(points, constraints, round % 3 == 0);
    const auto& delaunay = attempt.delaunay;
    for (std::size_t k = 0; k < points.size(); ++k)
      ASSERT_EQ(delaunay.point(attempt.vertices[k]), points[k]) << round;
    if (delaunay.is_flat()) continue;
    ASSERT_EQ(defect_of(delaunay), "") << round;
    std::size_t place = 0;
    for (const auto& [a, b] : constraints) {
      const Index from = attempt.vertices[to_size(a)], to = attempt.vertices[to_size(b)];
      if (place == attempt.inserted.size() || from == to) continue;
      if (attempt.inserted[place++]) {
        ASSERT_TRUE(has_constraint(delaunay, from, to)) << round;
      }
    }
  }
}

// Every order of insertion gives the same faces, also for cocircular points.
TEST(ConstrainedDelaunay, OrderChangesNothing) {
  test::Random random(2);
  for (int round = 0; round < 500; ++round) {
    const auto points = points_of(static_cast<Kind>(round % kPointKinds), 40, random);
    const Attempt<IncrementalDelaunay> together(points, {}, false), apart(points, {}, true);
    ASSERT_EQ(together.delaunay.is_flat(), apart.delaunay.is_flat());
    if (together.delaunay.is_flat()) continue;
    std::set<std::set<std::pair<double, double>>> faces[2];
    for (const auto* attempt : {&together, &apart})
      for (const auto face : attempt->delaunay.finite_faces()) {
        std::set<std::pair<double, double>> corners;
        for (int i = 0; i < 3; ++i) {
          const Vector2& p = attempt->delaunay.point(attempt->delaunay.vertex(face, i));
          corners.insert({p.x(), p.y()});
        }
        faces[attempt == &apart].insert(corners);
      }
    ASSERT_EQ(faces[0], faces[1]) << round;
  }
}

TEST(ConstrainedDelaunay, RefusesConstraintsThatMeet) {
  const std::vector<Vector2> points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}, {4, 4}};
  IncrementalDelaunay delaunay;
  delaunay.insert(points);
  EXPECT_TRUE(delaunay.insert_constraint(0, 5));  // through 4 and 2
  EXPECT_TRUE(delaunay.find_edge(0, 4) && delaunay.find_edge(4, 2) && delaunay.find_edge(2, 5));
  EXPECT_FALSE(delaunay.find_edge(0, 5).has_value());
  EXPECT_TRUE(delaunay.insert_constraint(1, 4));   // touches the constraint
  EXPECT_TRUE(delaunay.insert_constraint(4, 3));   // from the other side
  EXPECT_FALSE(delaunay.insert_constraint(4, 2));  // a part of the constraint
  EXPECT_FALSE(delaunay.insert_constraint(1, 5) && delaunay.insert_constraint(3, 5) &&
               delaunay.insert_constraint(1, 3));
  EXPECT_EQ(defect_of(delaunay), "");
}

// A constraint passes a vertex inside the faces that it replaces, all of whose other neighbors are
// on one side.
TEST(ConstrainedDelaunay, KeepsVerticesWithinTheFacesThatAConstraintCrosses) {
  test::Random random(3);
  for (int round = 0; round < 300; ++round) {
    std::vector<Vector2> points{{0, 0}, {100, 0}};
    for (int k = 0; k < 60; ++k)
      points.emplace_back(random.uniform(1, 99), std::pow(10, random.uniform(-3, 1)) *
                                                     (random.integer(0, 1) == 0 ? -1 : 1));
    std::vector<std::pair<int, int>> constraints;  // short ones on either side
    for (int k = 2; k + 1 < 62; k += 2)
      if ((points[to_size(k)].y() > 0) == (points[to_size(k + 1)].y() > 0) && round % 2 == 0)
        constraints.emplace_back(k, k + 1);
    IncrementalDelaunay delaunay;
    delaunay.insert(points);
    for (const auto& [a, b] : constraints) delaunay.insert_constraint(a, b);
    ASSERT_TRUE(delaunay.insert_constraint(0, 1)) << round;
    ASSERT_TRUE(delaunay.find_edge(0, 1)) << round;
    ASSERT_EQ(defect_of(delaunay), "") << round;
  }
}

TEST(ConstrainedDelaunay, TakesPointsAfterConstraints) {
  test::Random random(4);
  for (int round = 0; round < 200; ++round) {
    const auto points = points_of(round % 2 == 0 ? Kind::Square : Kind::Grid, 30, random);
    IncrementalDelaunay delaunay;
    const std::vector<Index> vertices = delaunay.insert(points);
    if (delaunay.is_flat() || vertices[0] == vertices[1] ||
        !delaunay.insert_constraint(vertices[0], vertices[1]))
      continue;
    for (int k = 0; k < 30; ++k) delaunay.insert({random.uniform(-1, 7), random.uniform(-1, 7)});
    ASSERT_EQ(defect_of(delaunay), "") << round;
    ASSERT_TRUE(has_constraint(delaunay, vertices[0], vertices[1])) << round;
  }
}

TEST(ConstrainedDelaunay, HasTheFacesOfCgal) {
#ifdef MAJORANT_HAS_CGAL
  test::Random random(5);
  int crossings = 0, flat = 0;
  for (int round = 0; round < 10000; ++round) {
    const int count = round % 500 == 0 ? 2000 : random.integer(1, 60);
    const auto points = points_of(static_cast<Kind>(round % kPointKinds), count, random);
    const auto constraints = random_constraints(count, random);
    const Attempt<IncrementalDelaunay> own(points, constraints, round % 3 == 0);
    const Attempt<CgalDelaunay> theirs(points, constraints, round % 3 == 0);
    ASSERT_EQ(own.delaunay.is_flat(), theirs.delaunay.is_flat()) << round;
    ASSERT_EQ(own.delaunay.vertex_count(), theirs.delaunay.vertex_count()) << round;
    ASSERT_EQ(own.inserted, theirs.inserted) << round;
    flat += own.delaunay.is_flat();
    crossings += !own.inserted.empty() && !own.inserted.back();
    if (own.delaunay.is_flat()) continue;
    // Coinciding points may have the number of either.
    std::vector<Index> name(points.size(), -1), their_name(points.size(), -1);
    for (std::size_t k = points.size(); k-- > 0;) {
      name[to_size(own.vertices[k])] = static_cast<Index>(k);
      their_name[to_size(theirs.vertices[k])] = static_cast<Index>(k);
    }
    const auto renamed = [](const auto& edges, const std::vector<Index>& names) {
      std::set<std::tuple<Index, Index, bool>> result;
      for (const auto& [a, b, is_constrained] : edges) {
        const auto [low, high] = std::minmax(names[to_size(a)], names[to_size(b)]);
        result.insert({low, high, is_constrained});
      }
      return result;
    };
    ASSERT_EQ(renamed(edges_of(own.delaunay), name), renamed(edges_of(theirs.delaunay), their_name))
        << round;
  }
  EXPECT_GT(crossings, 1000);
  EXPECT_GT(flat, 30);
#else
  GTEST_SKIP() << "no CGAL, the oracle, in this build (MAJORANT_GPL=OFF)";
#endif
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
