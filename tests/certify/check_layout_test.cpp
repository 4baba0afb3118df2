// Layouts of several charts, the cost limit of their check, and its stop.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/loop_winding.h"

namespace majorant {
namespace {

using Points = std::vector<Vector2>;

// Returns straight edges of any degree.
std::vector<PlanarCurve> polygon(const Points& points, int degree) {
  std::vector<PlanarCurve> edges;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vector2 &a = points[k], &b = points[(k + 1) % points.size()];
    PlanarCurve edge;
    edge.degree = degree;
    edge.control_points.fill(a);
    for (int i = 0; i < degree; ++i)
      edge.control_points[static_cast<std::size_t>(i)] = a + i * (b - a) / degree;
    edge.control_points[static_cast<std::size_t>(degree)] = b;
    edges.push_back(edge);
  }
  return edges;
}

void add(BoundaryLoops& layout, Index chart, const std::vector<PlanarCurve>& loop) {
  std::vector<Index> half_edges;
  for (std::size_t k = 0; k < loop.size(); ++k)
    half_edges.push_back(static_cast<Index>(3 * (layout.curves.size() + k)));
  layout.charts = std::max(layout.charts, chart + 1);
  layout.add_loop(chart, loop, half_edges);
}

Points square(double x, double y, double half) {
  return {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
}
Points backwards(Points points) {
  std::reverse(points.begin(), points.end());
  return points;
}

struct Loop {
  Index chart;
  Points points;
};
// Expects the result at all degrees up to one, and at other positions and scales.
void expect(ProofStatus result, const std::vector<Loop>& loops, const std::string& what,
            int max_degree = 3) {
  for (int degree = 1; degree <= max_degree; ++degree)
    for (const auto& [scale, offset] : {std::pair{1.0, 0.0}, {0x1p-120, 0.0}, {0x1p-20, 0x1p20}}) {
      BoundaryLoops layout;
      for (const Loop& loop : loops) {
        Points moved;
        for (const Vector2& p : loop.points) moved.push_back(scale * p + Vector2(offset, -offset));
        add(layout, loop.chart, polygon(moved, degree));
      }
      const GlobalInjectivity proof = check_layout(layout);
      EXPECT_EQ(static_cast<int>(proof.result), static_cast<int>(result))
          << what << ", degree " << degree << ", scale " << scale << ": " << proof.reason;
      EXPECT_EQ(proof.pairs_left, 0);
    }
}

GlobalInjectivity proof_of(const std::vector<Loop>& loops) {
  BoundaryLoops layout;
  for (const Loop& loop : loops) add(layout, loop.chart, polygon(loop.points, 1));
  return check_layout(layout);
}

TEST(CheckLayout, OverlapsDifferFromTouchingBoundaries) {
  const Points left = square(0, 0, 1);
  for (const Vector2& p : {Vector2(2, 0), Vector2(2, 0.5), Vector2(2, 2)}) {
    const GlobalInjectivity touching = proof_of({{0, left}, {1, square(p.x(), p.y(), 1)}});
    EXPECT_EQ(touching.result, ProofStatus::Violated) << p.transpose();
    EXPECT_FALSE(touching.covered_twice) << p.transpose();
  }
  // Down to thin wedges, between edges of very different lengths.
  for (const double angle : {1.5, 0.1, 1e-3, 1e-6})
    for (const double length : {1e-3, 1.0, 1e3}) {
      const Vector2 along(std::cos(angle), std::sin(angle));
      const Vector2 across(-along.y(), along.x());
      const Points other{-length * along, length * along, length * (along + across),
                         length * (across - along)};
      const GlobalInjectivity crossing =
          proof_of({{0, {{-1, -1}, {1, -1}, {1, 0}, {-1, 0}}}, {1, other}});
      EXPECT_EQ(crossing.result, ProofStatus::Violated);
      ASSERT_TRUE(crossing.covered_twice) << angle << ' ' << length;
      const Vector2& p = *crossing.covered_twice;
      EXPECT_TRUE(-1 < p.x() && p.x() < 1 && -1 < p.y() && p.y() < 0) << p.transpose();
      EXPECT_GT(p.dot(across), 0);
    }
}

TEST(CheckLayout, ChartsMayLieInHolesAndNotInCharts) {
  const Points big = square(0, 0, 8), hole = backwards(square(0, 0, 4));
  const Points small = square(0.5, 0.25, 1), hole_in_small = backwards(square(0.5, 0.25, 0.5));
  using enum ProofStatus;
  expect(Proven, {{0, big}}, "a square");
  expect(Proven, {{0, big}, {1, square(20, 3, 2)}, {2, square(-20, 3, 2)}}, "beside");
  expect(Proven, {{0, big}, {0, hole}, {1, small}}, "in a hole");
  expect(Proven, {{1, small}, {0, hole}, {0, big}}, "in a hole, the other way round");
  expect(Proven, {{0, big}, {0, hole}, {1, small}, {1, hole_in_small}, {2, square(0.5, 0.25, 0.1)}},
         "in a hole in a hole");
  expect(Violated, {{0, big}, {1, small}}, "inside");
  expect(Violated, {{1, small}, {0, big}}, "inside, the other way round");
  expect(Violated, {{0, big}, {0, hole}, {1, square(6, 0, 1)}}, "inside, beside a hole");
  expect(Violated, {{0, big}, {0, hole}, {1, square(4, 0, 1)}}, "across the rim of a hole");
  expect(Violated, {{0, big}, {0, backwards(square(20, 0, 2))}}, "a hole outside");
  expect(Violated, {{0, big}, {0, square(0, 0, 4)}}, "two rims");
  expect(Violated, {{0, big}, {2, square(20, 0, 2)}}, "a closed chart");
  expect(Violated, {{0, backwards(big)}}, "turned over");
  expect(Violated, {{0, backwards(big)}, {0, backwards(hole)}}, "a ring turned over");
}

TEST(CheckLayout, TouchingIsNotInjective) {
  using enum ProofStatus;
  const Points big = square(0, 0, 8);
  expect(Violated, {{0, big}, {1, {{8, 8}, {12, 9}, {9, 12}}}}, "two copies of a vertex");
  expect(Violated, {{0, big}, {1, square(16, 0, 8)}}, "the sides of a closed cut");
  // A slit in one chart, closed at its tip.
  expect(Violated, {{0, {{0, 0}, {8, 0}, {8, 3}, {4, 4}, {8, 5}, {8, 8}, {4, 4}, {0, 8}}}}, "slit");
  // At interior points, contacts of curves are undecided, also if the curves happen to be straight.
  const std::vector<Loop> vertex{{0, big}, {1, {{8, 1}, {12, 0}, {12, 3}}}};
  const std::vector<Loop> side{{0, big}, {1, {{8, 1}, {12, 0}, {12, 3}, {8, 3}}}};
  for (const auto& loops : {vertex, side}) {
    expect(Violated, loops, "on an edge", 1);
    BoundaryLoops curved;
    for (const Loop& loop : loops) add(curved, loop.chart, polygon(loop.points, 2));
    EXPECT_EQ(check_layout(curved).result, ProofStatus::Undecided);
  }
}

TEST(CheckLayout, LinesAreDecidedExactly) {
  // (1, 1) lies on the diagonal, whose direction is not representable in doubles.
  const Points lower{{0.1, 0.1}, {3.3, -5}, {3.3, 3.3}};
  BoundaryLoops touching, apart, crossing;
  for (BoundaryLoops* layout : {&touching, &apart, &crossing}) add(*layout, 0, polygon(lower, 1));
  const double up = std::nextafter(1.0, 2.0), down = std::nextafter(1.0, 0.0);
  add(touching, 1, polygon({{1, 1}, {2, 4}, {-3, 3}}, 1));
  add(apart, 1, polygon({{1, up}, {2, 4}, {-3, 3}}, 1));
  add(crossing, 1, polygon({{1, down}, {2, 4}, {-3, 3}}, 1));
  EXPECT_EQ(check_layout(touching).result, ProofStatus::Violated);
  EXPECT_EQ(check_layout(apart).result, ProofStatus::Proven);
  EXPECT_EQ(check_layout(crossing).result, ProofStatus::Violated);
  // Numbers whose products underflow.
  for (const double tiny : {0x1p-1000, 0x1p-1074}) {
    BoundaryLoops layout;
    add(layout, 0, polygon({{0, 0}, {1, 0}, {0, 1}}, 1));
    add(layout, 1, polygon({{0, -tiny}, {-1, -1}, {1, -tiny}}, 1));
    EXPECT_EQ(check_layout(layout).result, ProofStatus::Proven);
  }
}

TEST(CheckLayout, InvalidBoundariesAreUndecided) {
  BoundaryLoops gap, short_loop, label, infinite;
  std::vector<PlanarCurve> edges = polygon(square(0, 0, 1), 1);
  PlanarCurve back = edges[0];
  std::swap(back.control_points[0], back.control_points[1]);
  add(short_loop, 0, {edges[0], back});
  add(label, 0, edges);
  label.charts = 0;
  edges[2].control_points[0].x() += 1e-12;
  add(gap, 0, edges);
  for (Vector2* p : {&edges[1].control_points[1], &edges[2].control_points[0]}) p->x() = INFINITY;
  add(infinite, 0, edges);
  for (const BoundaryLoops& layout : {gap, short_loop, label, infinite}) {
    const GlobalInjectivity proof = check_layout(layout);
    EXPECT_EQ(proof.result, ProofStatus::Undecided);
    EXPECT_FALSE(proof.reason.empty());
  }
}

// ---- Cost ----

// Returns two charts with `count` wavy cubics each along a common side, `gap` apart.
BoundaryLoops wiggling_sides(int count, double gap) {
  const auto point = [](double t) { return Vector2(t, 0.2 * std::sin(2.3 * t)); };
  const auto leg = [](double t) { return Vector2(1.0 / 3, 0.46 / 3 * std::cos(2.3 * t)); };
  std::vector<PlanarCurve> upper, lower;
  for (int k = 0; k < count; ++k) {
    const double s = k, t = k + 1;
    PlanarCurve edge{3, {point(s), point(s) + leg(s), point(t) - leg(t), point(t)}};
    upper.push_back(edge);
    std::reverse(edge.control_points.begin(), edge.control_points.begin() + 4);
    for (Vector2& p : edge.control_points) p.y() -= gap;
    lower.insert(lower.begin(), edge);
  }
  BoundaryLoops layout;
  for (auto* side : {&upper, &lower}) {
    const Vector2 a = side->back().back(), b = side->front().front();
    const double y = side == &upper ? 2 : -2;
    std::vector<PlanarCurve> others = polygon({a, {a.x(), y}, {b.x(), y}, b}, 3);
    side->insert(side->end(), others.begin(), others.begin() + 3);
    add(layout, side == &upper ? 0 : 1, *side);
  }
  return layout;
}

TEST(CheckLayout, CurvesAlongEachOtherAreCheap) {
  const std::pair<double, long> cases[] = {{1e-6, 30}, {1e-9, 70}, {1e-12, 200}};
  for (const auto& [gap, subdivisions] : cases) {
    const GlobalInjectivity proof = check_layout(wiggling_sides(100, gap));
    EXPECT_EQ(proof.result, ProofStatus::Proven) << gap;
    EXPECT_LT(proof.subdivisions, 100 * subdivisions) << gap;
    EXPECT_EQ(check_layout(wiggling_sides(100, -gap)).result, ProofStatus::Violated) << gap;
  }
}

// Returns pairs of charts of which one has a parabola as a side, and the other a part of that
// parabola.
BoundaryLoops touching_arches(int count) {
  BoundaryLoops layout;
  for (Index k = 0; k < count; ++k) {
    const double x = 4 * k;
    std::vector<PlanarCurve> above = polygon({{x, 0}, {x + 2, 0}, {x + 2, 3}, {x, 3}}, 2);
    above[0].control_points[1] = Vector2(x + 1, 2);
    std::vector<PlanarCurve> below =
        polygon({{x + 1.5, 0.75}, {x + 0.5, 0.75}, {x + 0.5, 0.125}, {x + 1.5, 0.125}}, 2);
    below[0].control_points[1] = Vector2(x + 1, 1.25);
    add(layout, 2 * k, above);
    add(layout, 2 * k + 1, below);
  }
  return layout;
}

TEST(CheckLayout, UndecidableContactsEndWithTheBudget) {
  const BoundaryLoops layout = touching_arches(64);
  for (const long budget : {0L, 100L, 30000L}) {
    const GlobalInjectivity proof = check_layout(layout, {.max_subdivisions = budget});
    EXPECT_EQ(proof.result, ProofStatus::Undecided);
    EXPECT_LE(proof.subdivisions, budget);
    EXPECT_GT(proof.pairs_left, 10);
    EXPECT_NE(proof.reason.find(std::to_string(proof.pairs_left) + " pairs"), std::string::npos)
        << proof.reason;
  }
  // The default limit allows about the work of ten such pairs.
  const GlobalInjectivity proof = check_layout(layout);
  EXPECT_EQ(proof.result, ProofStatus::Undecided);
  EXPECT_LT(proof.subdivisions, 400000);
  // A small number of pairs is compared completely.
  EXPECT_EQ(check_layout(touching_arches(4)).pairs_left, 0);
}

TEST(CheckLayout, StopsOnRequest) {
  BoundaryLoops squares;
  for (Index k = 0; k < 500; ++k) add(squares, k, polygon(square(4.0 * k, 0.5 * k, 1), 1));
  for (const BoundaryLoops& layout : {wiggling_sides(30, 1e-9), squares, touching_arches(2)}) {
    long requested = 0;
    check_layout(layout, {.stopped = [&] { return ++requested < 0; }});
    ASSERT_GT(requested, 30);
    for (const long last : {1L, 2L, 7L, requested / 2, requested - 1, requested}) {
      long questions = 0;
      const GlobalInjectivity proof =
          check_layout(layout, {.stopped = [&] { return ++questions >= last; }});
      EXPECT_EQ(proof.result, ProofStatus::Undecided);
      EXPECT_EQ(proof.reason.find("stopped"), 0u) << proof.reason;
      EXPECT_EQ(questions, last);
      EXPECT_LE(proof.subdivisions, 100 * last);
    }
  }
}

// A comb with long teeth, all of whose boxes intersect.
TEST(CheckLayout, LongPolygonsOfAnyShape) {
  constexpr int kTeeth = 50000;
  const Vector2 along(std::cos(0.7), std::sin(0.7)), up(-along.y(), along.x());
  Points outline;
  for (int k = kTeeth - 1; k >= 0; --k) {
    outline.push_back((k + 0.75) * along);
    outline.push_back((k + 0.5) * along + 1e5 * up);
  }
  outline.push_back(-100 * up);
  outline.push_back(kTeeth * along - 100 * up);
  BoundaryLoops layout;
  add(layout, 0, polygon(outline, 1));
  const GlobalInjectivity proof = check_layout(layout);
  EXPECT_EQ(proof.result, ProofStatus::Proven);
  EXPECT_LT(proof.pairs_tested, 10 * kTeeth);
  // One tooth crosses its neighbour.
  outline[2 * 1000 + 1] += 1.25 * along;
  BoundaryLoops crossing;
  add(crossing, 0, polygon(outline, 1));
  EXPECT_EQ(check_layout(crossing).result, ProofStatus::Violated);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
