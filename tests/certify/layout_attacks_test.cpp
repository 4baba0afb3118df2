// Layouts that nearly overlap, against exact elimination: results Proven and Violated must be
// correct, and few cases may be undecided.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>

#include "certify/exact_curves.h"
#include "majorant/certify/boundary_loops.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/loop_winding.h"

namespace majorant {
namespace {

constexpr int kCases = 36;  // of each family

using Points = std::vector<Vector2>;

// Returns edges of a degree along a closed polygon, bent sideways by `bend` of their length.
// Control points of straight ones are at exact positions if these are representable.
std::vector<PlanarCurve> edges_along(const Points& polygon, int degree,
                                     const std::function<double(std::size_t)>& bend) {
  std::vector<PlanarCurve> edges;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()], d = b - a;
    PlanarCurve edge;
    edge.degree = degree;
    edge.control_points.fill(a);
    for (int i = 0; i <= degree; ++i) {
      const double t = static_cast<double>(i) / degree;
      edge.control_points[static_cast<std::size_t>(i)] =
          a + t * d + (i > 0 && i < degree ? bend(k) : 0) * Vector2(-d.y(), d.x());
    }
    edge.control_points[static_cast<std::size_t>(degree)] = b;
    edges.push_back(edge);
  }
  return edges;
}

void add_chart(BoundaryLoops& layout, Index chart, const std::vector<PlanarCurve>& loop) {
  std::vector<Index> labels;
  for (std::size_t k = 0; k < loop.size(); ++k)
    labels.push_back(static_cast<Index>(layout.curves.size() + k));
  layout.charts = std::max(layout.charts, chart + 1);
  layout.add_loop(chart, loop, labels);
}

// Scales, rotates and translates the layout with rounding; common ends stay common.
void move(BoundaryLoops& layout, double scale, double angle, double offset) {
  for (PlanarCurve& c : layout.curves)
    for (Vector2& p : c.control_points) {
      const double x = std::cos(angle) * p.x() - std::sin(angle) * p.y();
      const double y = std::sin(angle) * p.x() + std::cos(angle) * p.y();
      p = scale * Vector2(x + offset, y - 2 * offset);
    }
}

enum class Truth { Simple, Touching, Unknown };

Truth truth_of(const BoundaryLoops& layout) {
  const std::vector<Index> next = layout.next();
  bool unknown = false;
  for (std::size_t i = 0; i < layout.curves.size(); ++i)
    for (std::size_t j = i + 1; j < layout.curves.size(); ++j) {
      const PlanarCurve &a = layout.curves[i], &b = layout.curves[j];
      if (!box_of(a).meets(box_of(b))) continue;
      const bool after = next[i] == static_cast<Index>(j),
                 before = next[j] == static_cast<Index>(i);
      const int count = after    ? exact::common_points(a, b, exact::Ends::WithoutCommon)
                        : before ? exact::common_points(b, a, exact::Ends::WithoutCommon)
                                 : exact::common_points(a, b, exact::Ends::All);
      if (count > 0) return Truth::Touching;
      unknown |= count < 0;
    }
  return unknown ? Truth::Unknown : Truth::Simple;
}

struct Verdicts {
  int proven = 0, violated = 0, undecided = 0, unknown = 0;
};

// The nesting is correct if no two curves intersect.
void judge(const BoundaryLoops& layout, Verdicts& tally, const std::string& what) {
  ASSERT_EQ(layout.defect(), "") << what;
  const GlobalInjectivity proof = check_layout(layout);
  const Truth truth = truth_of(layout);
  if (proof.result == ProofStatus::Proven) {
    EXPECT_NE(truth, Truth::Touching) << what;
  } else if (proof.result == ProofStatus::Violated) {
    EXPECT_NE(truth, Truth::Simple) << what;
  }
  tally.unknown += truth == Truth::Unknown;
  ++(proof.result == ProofStatus::Proven     ? tally.proven
     : proof.result == ProofStatus::Violated ? tally.violated
                                             : tally.undecided);
}

void record(const Verdicts& tally) {
  testing::Test::RecordProperty("proven", tally.proven);
  testing::Test::RecordProperty("violated", tally.violated);
  testing::Test::RecordProperty("undecided", tally.undecided);
  testing::Test::RecordProperty("unknown", tally.unknown);
}

class Random {
 public:
  explicit Random(unsigned seed) : random_(seed) {}
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  // Returns 0 or +-2^-k.
  double gap(int least, int most) {
    const int sense = integer(-1, 1);
    return sense * std::ldexp(1.0, -integer(least, most));
  }
  void move(BoundaryLoops& layout) {
    if (integer(0, 1) == 0) return;
    majorant::move(layout, std::ldexp(1.0, integer(-300, 300)), uniform(0, 6), gap(-30, 0));
  }

 private:
  std::mt19937 random_;
};

double straight(std::size_t) { return 0; }

// A ring with a slit whose sides are `gap` apart: two edges, a vertex and an edge, two vertices.
TEST(LayoutAttacks, RingsThatAlmostClose) {
  Random random(1);
  Verdicts tally;
  for (int trial = 0; trial < kCases; ++trial) {
    const int degree = 1 + trial % 3, kind = trial / 3 % 3;
    const double gap = trial % 2 == 0 ? random.gap(20, 60) : random.gap(30, 1000);
    const double below = kind == 0 ? -gap : -0.25, shift = kind == 2 ? 0.125 : 0;
    Points ring{{1 + shift, kind == 2 ? 0.25 : 0}, {2, 0}};
    for (const double angle : {1.0, 2.0, 3.0, 4.0, 5.0})
      ring.emplace_back(2 * std::cos(angle), 2 * std::sin(angle));
    ring.emplace_back(2, -gap);
    ring.emplace_back(1, below);
    for (const double angle : {5.0, 4.0, 3.0, 2.0, 1.0})
      ring.emplace_back(std::cos(angle), std::sin(angle));
    const std::size_t slit = 7;
    BoundaryLoops layout;
    add_chart(layout, 0, edges_along(ring, degree, [&](std::size_t k) {
                return k == 0 || k == slit ? 0.0 : k < slit ? -0.1 : 0.1;
              }));
    random.move(layout);
    judge(layout, tally, "ring " + std::to_string(trial));
  }
  record(tally);
  EXPECT_GT(tally.proven, kCases / 9);
  EXPECT_GT(tally.violated, kCases / 4);
  EXPECT_LT(tally.undecided, kCases / 4);
}

// A chart with a parabola (of any degree) as its lower side above one with a straight upper side.
TEST(LayoutAttacks, ParabolasOverStraightEdges) {
  Random random(2);
  Verdicts tally;
  for (int trial = 0; trial < kCases; ++trial) {
    const int degree = 2 + trial % 4;
    const double gap = random.gap(4, 59), height = random.uniform(0.1, 2);
    BoundaryLoops layout;
    add_chart(layout, 0, edges_along({{-3, 0}, {0, -2}, {3, 0}}, degree, straight));
    // y = height x^2 + gap over [-1, 1] has these Bernstein coefficients.
    PlanarCurve side;
    side.degree = degree;
    side.control_points.fill({0, 0});
    for (int k = 0; k <= degree; ++k) {
      const double t = static_cast<double>(k) / degree;
      const double square = k * (k - 1) / (degree * (degree - 1.0));  // of t^2
      side.control_points[static_cast<std::size_t>(k)] =
          Vector2(2 * t - 1, height * (4 * square - 4 * t + 1) + gap);
    }
    std::vector<PlanarCurve> upper =
        edges_along({side.front(), side.back(), {0, height + 3}}, degree, straight);
    upper[0] = side;
    add_chart(layout, 1, upper);
    random.move(layout);
    judge(layout, tally, "parabola " + std::to_string(trial));
  }
  record(tally);
  EXPECT_GT(tally.proven, kCases / 6);
  EXPECT_GT(tally.violated, kCases / 6);
  EXPECT_LT(tally.undecided, kCases / 2);  // touching ones
}

// Strips of constant width along random paths.
TEST(LayoutAttacks, Ribbons) {
  Random random(3);
  Verdicts tally;
  for (int trial = 0; trial < kCases; ++trial) {
    const int degree = 1 + trial % 3, steps = random.integer(8, 24);
    const double width = random.uniform(0.05, 0.3);
    Points left, right;
    Vector2 place(0, 0);
    double heading = 0, turn = 0;
    for (int k = 0; k <= steps; ++k) {
      const Vector2 along(std::cos(heading), std::sin(heading)), up(-along.y(), along.x());
      left.push_back(place + width * up);
      right.push_back(place - width * up);
      turn = 0.8 * turn + random.uniform(-0.5, 0.5);
      heading += turn;
      place += Vector2(std::cos(heading), std::sin(heading));
    }
    Points outline = right;
    outline.insert(outline.end(), left.rbegin(), left.rend());
    const double bend = random.uniform(-0.1, 0.1);
    BoundaryLoops layout;
    add_chart(layout, 0, edges_along(outline, degree, [&](std::size_t) { return bend; }));
    random.move(layout);
    judge(layout, tally, "ribbon " + std::to_string(trial));
  }
  record(tally);
  EXPECT_GT(tally.proven, kCases / 6);
  EXPECT_GT(tally.violated, kCases / 6);
  EXPECT_LT(tally.undecided, kCases / 20 + 1);
}

// Rings and fans of one turn or more; the hole moves towards the rim.
TEST(LayoutAttacks, AnnuliAndFans) {
  Random random(4);
  Verdicts tally;
  for (int trial = 0; trial < kCases; ++trial) {
    const int degree = 1 + trial % 3, count = 6 + trial % 5, turns = trial % 7 == 0 ? 2 : 1;
    const auto circle = [&](double radius, const Vector2& center, double sense) {
      Points points;
      for (int k = 0; k < count; ++k) {
        const double angle = sense * turns * 2 * std::numbers::pi * k / count;
        points.push_back(center + radius * Vector2(std::cos(angle), std::sin(angle)));
      }
      return points;
    };
    // The first vertices of both circles touch at the displacement 1/2.
    const Vector2 center(trial % 2 == 0 ? random.uniform(0, 0.6) : 0.5 + random.gap(3, 54), 0);
    BoundaryLoops layout;
    add_chart(layout, 0,
              edges_along(circle(1, {0, 0}, 1), degree, [](std::size_t) { return -0.05; }));
    if (trial % 3 != 2)
      add_chart(layout, 0,
                edges_along(circle(0.5, center, -1), degree, [](std::size_t) { return 0.05; }));
    random.move(layout);
    judge(layout, tally, "annulus " + std::to_string(trial));
  }
  record(tally);
  EXPECT_GT(tally.proven, kCases / 4);
  EXPECT_GT(tally.violated, kCases / 6);
  EXPECT_LT(tally.undecided, kCases / 20 + 1);
}

// Adjacent wavy curves as sides of two charts, at distances of all magnitudes.
TEST(LayoutAttacks, CurvesAlongEachOther) {
  Random random(5);
  Verdicts tally;
  for (int trial = 0; trial < kCases; ++trial) {
    const int degree = 2 + trial % 2;
    const double gap = random.gap(8, 40), slope = trial % 3 == 0 ? random.uniform(-2, 2) : 0;
    PlanarCurve side, other;
    side.degree = other.degree = degree;
    side.control_points.fill({0, 0});
    other.control_points.fill({0, 0});
    for (int k = 0; k <= degree; ++k) {
      const double t = static_cast<double>(k) / degree;
      const auto i = static_cast<std::size_t>(k);
      side.control_points[i] = {t, random.uniform(-0.1, 0.1)};
      // Reverses the curve and moves it.
      other.control_points[static_cast<std::size_t>(degree - k)] =
          side.control_points[i] + Vector2(0, gap * (1 + slope * t));
    }
    BoundaryLoops layout;
    std::vector<PlanarCurve> upper =
        edges_along({side.front(), side.back(), {0.5, 1}}, degree, straight);
    upper[0] = side;
    std::vector<PlanarCurve> lower =
        edges_along({other.front(), other.back(), {0.5, -1}}, degree, straight);
    lower[0] = other;
    add_chart(layout, 0, upper);
    add_chart(layout, 1, lower);
    random.move(layout);
    judge(layout, tally, "along " + std::to_string(trial));
  }
  record(tally);
  EXPECT_GT(tally.proven, kCases / 6);
  EXPECT_GT(tally.violated, kCases / 6);
  EXPECT_LT(tally.undecided, kCases / 10);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
