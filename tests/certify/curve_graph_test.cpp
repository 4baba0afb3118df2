// Enclosures of heights over a graph, against exact arithmetic.
#include "majorant/certify/internal/curve_graph.h"

#include <gtest/gtest.h>

#include <random>

#include "certify/exact_curves.h"

namespace majorant::curve_piece {
namespace {

using exact::Polynomial;
using exact::Rational;

struct Point {
  Rational x, y;
};

// Returns the curve at t in the graph's coordinates, relative to the graph.
Point exact_place(const PlanarCurve& curve, const Vector2& origin, const Graph<double>& graph,
                  const Rational& t) {
  const Rational px = exact::value(exact::coordinate(curve, 0), t) - Rational(origin.x());
  const Rational py = exact::value(exact::coordinate(curve, 1), t) - Rational(origin.y());
  const Rational dx = px - Rational(graph.origin.x), dy = py - Rational(graph.origin.y);
  const Rational ax(graph.axis.x), ay(graph.axis.y), x = ax * dx + ay * dy;
  Rational g = 0;
  for (std::size_t k = kGraphDegree + 1; k-- > 0;) g = g * x + Rational(graph.coefficients[k]);
  return {x, ax * dy - ay * dx - g};
}

bool contains(const Interval<double>& range, const Rational& value) {
  return Rational(range.low) <= value && value <= Rational(range.high);
}

TEST(CurveGraph, HeightsAreEnclosed) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  int narrow = 0;
  for (int trial = 0; trial < 100; ++trial) {
    PlanarCurve curve;
    curve.degree = 1 + trial % PlanarCurve::kMaxDegree;
    const double scale = std::ldexp(1.0, trial % 5 == 0 ? -200 : trial % 7), offset = trial % 3;
    for (int k = 0; k <= curve.degree; ++k)
      curve.control_points[static_cast<std::size_t>(k)] =
          scale * Vector2(k + offset, 0.3 * normal(random) - 100 * offset);
    const Vector2 origin = trial % 2 == 0 ? curve.front() : Vector2(0, 0);
    const Piece<double> whole(curve, origin);
    const auto [first, second] = split(whole);
    Graph<double> graph = graph_between(first, trial % 2 == 0 ? first : second);
    if (trial % 4 == 3)
      for (double& c : graph.coefficients) c += 0.1 * normal(random);
    const Heights<double> seen = heights(first, graph);
    if (!std::isfinite(seen.all.low)) continue;
    ++narrow;
    const Rational end = Rational(15) / 32;  // where pieces are divided
    for (int k = 0; k <= 8; ++k) {
      const Point place = exact_place(curve, origin, graph, end * k / 8);
      EXPECT_TRUE(contains(seen.x, place.x)) << trial;
      EXPECT_TRUE(contains(seen.all, place.y)) << trial;
      if (k == 0) {
        EXPECT_TRUE(contains(seen.front_x, place.x) && contains(seen.front, place.y)) << trial;
      }
      if (k == 8) {
        EXPECT_TRUE(contains(seen.back_x, place.x) && contains(seen.back, place.y)) << trial;
      }
    }
    EXPECT_LT(seen.front.high - seen.front.low, 1e-10) << trial;
  }
  EXPECT_GT(narrow, 75);
}

TEST(CurveGraph, ParallelCurvesAreOnBothSides) {
  for (const double gap : {1e-3, 1e-9, 1e-13}) {
    PlanarCurve a{3, {Vector2(0, 0), Vector2(1, 0.02), Vector2(2, -0.01), Vector2(3, 0)}};
    PlanarCurve b = a;
    for (Vector2& p : b.control_points) p.y() += gap;
    const Piece<double> of_a(a, a.front()), of_b(b, a.front());
    const auto part = [](const Piece<double>& p) { return split(split(p).first).second; };
    const Graph<double> graph = graph_between(part(of_a), part(of_b));
    EXPECT_LT(heights(part(of_a), graph).all.high, heights(part(of_b), graph).all.low) << gap;
  }
}

TEST(CurveGraph, DegenerateGraphsEncloseNothing) {
  const PlanarCurve point{1, {Vector2(1, 1), Vector2(1, 1)}},
      line{1, {Vector2(0, 0), Vector2(1, 0)}};
  const PlanarCurve far{1, {Vector2(50, 0), Vector2(51, 0)}};
  const auto piece = [](const PlanarCurve& c) { return Piece<double>(c, Vector2(0, 0)); };
  const Graph<double> of_point = graph_between(piece(point), piece(point));
  EXPECT_EQ(heights(piece(line), of_point).all.low, -INFINITY);
  const Graph<double> of_line = graph_between(piece(line), piece(line));
  EXPECT_EQ(heights(piece(far), of_line).all.high, INFINITY);
}

}  // namespace
}  // namespace majorant::curve_piece

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
