// Contacts of curves against exact elimination, and degenerate cases.
#include "majorant/certify/internal/curve_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "certify/exact_curves.h"

namespace majorant {
namespace {

PlanarCurve curve(const std::vector<Vector2>& points) {
  PlanarCurve c;
  c.degree = static_cast<int>(points.size()) - 1;
  std::copy(points.begin(), points.end(), c.control_points.begin());
  return c;
}

using PointMap = std::function<Vector2(const Vector2&)>;
PlanarCurve mapped(PlanarCurve c, const PointMap& f) {
  for (Vector2& p : c.control_points) p = f(p);
  return c;
}

PlanarCurve reversed(PlanarCurve c) {
  std::reverse(c.control_points.begin(), c.control_points.begin() + c.degree + 1);
  return c;
}

// Exact if the new control points are integers.
PlanarCurve elevated(const PlanarCurve& c) {
  PlanarCurve up;
  up.degree = c.degree + 1;
  for (int k = 0; k <= up.degree; ++k) {
    const Vector2 before = k > 0 ? c.control_points[static_cast<std::size_t>(k - 1)] : c.front();
    const Vector2 here = k <= c.degree ? c.control_points[static_cast<std::size_t>(k)] : c.back();
    up.control_points[static_cast<std::size_t>(k)] =
        (k * before + (up.degree - k) * here) / up.degree;
  }
  return up;
}

Vector2 point(const PlanarCurve& c, double t) {
  std::vector<Vector2> row(c.control_points.begin(), c.control_points.begin() + c.degree + 1);
  for (; row.size() > 1; row.pop_back())
    for (std::size_t k = 0; k + 1 < row.size(); ++k) row[k] = (1 - t) * row[k] + t * row[k + 1];
  return row[0];
}

double distance(const PlanarCurve& c, const Vector2& p) {
  double least = INFINITY;
  for (int k = 0; k <= 2000; ++k) least = std::min(least, (point(c, k / 2000.0) - p).norm());
  return least;
}

// Coordinates on a grid of `cells`, so that touching curves and common ends occur.
class RandomCurves {
 public:
  RandomCurves(unsigned seed, int cells) : random_(seed), coordinate_(0, cells) {}
  Vector2 point() { return Vector2(coordinate_(random_), coordinate_(random_)); }
  PlanarCurve curve(int degree) {
    PlanarCurve c;
    c.degree = degree;
    for (int k = 0; k <= degree; ++k) c.control_points[static_cast<std::size_t>(k)] = point();
    return c;
  }

 private:
  std::mt19937 random_;
  std::uniform_int_distribution<int> coordinate_;
};

struct Tally {
  int none = 0, certain = 0, possible = 0;
  void add(ProofStatus kind) {
    ++(kind == ProofStatus::Proven ? none : kind == ProofStatus::Violated ? certain : possible);
  }
};

void expect_symmetric(const PlanarCurve& a, const PlanarCurve& b, ProofStatus kind) {
  EXPECT_EQ(contact_between(b, a).apart, kind);
  EXPECT_EQ(contact_between(reversed(a), b).apart, kind);
}

TEST(CurveContact, AgreesWithEliminationOnAGrid) {
  for (const int cells : {4, 9, 1000}) {
    RandomCurves random(static_cast<unsigned>(cells), cells);
    Tally tally;
    for (int trial = 0; trial < 1500; ++trial) {
      const PlanarCurve a = random.curve(1 + trial % 2), b = random.curve(1 + trial / 2 % 3);
      const int exact = exact::common_points(a, b, exact::Ends::All);
      if (exact < 0) continue;
      const CurveContact contact = contact_between(a, b);
      tally.add(contact.apart);
      if (contact.apart == ProofStatus::Proven) {
        EXPECT_EQ(exact, 0) << trial;
      }
      if (contact.apart == ProofStatus::Violated) {
        EXPECT_GT(exact, 0) << trial;
        EXPECT_LT(distance(a, contact.where) + distance(b, contact.where), 2e-3 * cells) << trial;
      }
      if (exact == 0) {
        EXPECT_EQ(contact.apart, ProofStatus::Proven) << trial;
      }
    }
    EXPECT_GT(tally.none, 300);
    EXPECT_GT(tally.certain, 300);
    // Contacts without crossing, and crossings at a vertex on the other curve, may be undecided.
    EXPECT_LT(tally.possible, cells == 4 ? 300 : cells == 9 ? 60 : 2) << cells;
  }
}

TEST(CurveContact, SizeAndPlaceDoNotMatter) {
  RandomCurves random(5, 50);
  for (int trial = 0; trial < 40; ++trial) {
    const PlanarCurve a = random.curve(2), b = random.curve(1 + trial % 3);
    const ProofStatus kind = contact_between(a, b).apart;
    if (kind == ProofStatus::Undecided) continue;
    expect_symmetric(a, b, kind);
    for (const double scale : {1e-6, 1e6, 0x1p-100, 0x1p100})
      for (const double offset : {0.0, 1e6}) {
        const PointMap f = [&](const Vector2& p) -> Vector2 {
          return scale * (p + offset * Vector2(1, -3));
        };
        const PlanarCurve c = mapped(a, f), d = mapped(b, f);
        const ProofStatus there = contact_between(c, d).apart;
        const int exact = exact::common_points(c, d, exact::Ends::All);  // of the rounded curves
        if (exact < 0) continue;
        if (there == ProofStatus::Proven) {
          EXPECT_EQ(exact, 0);
        }
        if (there == ProofStatus::Violated) {
          EXPECT_GT(exact, 0);
        }
        EXPECT_NE(there, ProofStatus::Undecided) << trial << ' ' << scale << ' ' << offset;
      }
  }
}

// Degree elevation does not change the results.
TEST(CurveContact, HigherDegreesAgree) {
  RandomCurves random(6, 20);
  const PointMap enlarge = [](const Vector2& p) -> Vector2 { return 3 * 4 * 5 * 6 * 7 * 8 * p; };
  for (int trial = 0; trial < 300; ++trial) {
    PlanarCurve a = mapped(random.curve(2), enlarge), b = mapped(random.curve(2), enlarge);
    const int exact = exact::common_points(a, b, exact::Ends::All);
    if (exact < 0) continue;
    for (; b.degree < PlanarCurve::kMaxDegree; a = elevated(a), b = elevated(b)) {
      const ProofStatus kind = contact_between(a, b).apart;
      EXPECT_EQ(kind == ProofStatus::Proven, exact == 0) << trial << ' ' << a.degree;
      EXPECT_EQ(contact_between(a, elevated(b)).apart == ProofStatus::Proven, exact == 0) << trial;
    }
  }
}

TEST(CurveContact, NeighboursAgreeWithElimination) {
  for (const int cells : {4, 9, 1000}) {
    RandomCurves random(static_cast<unsigned>(100 + cells), cells);
    Tally tally;
    for (int trial = 0; trial < 1500; ++trial) {
      PlanarCurve a = random.curve(1 + trial % 2), b = random.curve(1 + trial / 2 % 3);
      b.control_points[0] = a.back();
      const int exact = exact::common_points(a, b, exact::Ends::WithoutCommon);
      if (exact < 0) continue;
      const ProofStatus kind = contact_of_neighbours(a, b).apart;
      tally.add(kind);
      if (kind == ProofStatus::Proven) {
        EXPECT_EQ(exact, 0) << trial;
      }
      if (kind == ProofStatus::Violated) {
        EXPECT_GT(exact, 0) << trial;
      }
      const ProofStatus backwards = contact_of_neighbours(reversed(b), reversed(a)).apart;
      EXPECT_EQ(backwards == ProofStatus::Proven, kind == ProofStatus::Proven) << trial;
    }
    EXPECT_GT(tally.none, 300);
    EXPECT_GT(tally.certain, 300);
    EXPECT_LT(tally.possible, cells == 4 ? 700 : cells == 9 ? 200 : 10) << cells;
  }
}

TEST(CurveContact, LoopsOfCubics) {
  for (const int cells : {4, 1000}) {
    RandomCurves random(static_cast<unsigned>(200 + cells), cells);
    Tally tally;
    for (int trial = 0; trial < 2000; ++trial) {
      const PlanarCurve c = random.curve(3);
      const int exact = exact::self_intersections(c);
      if (exact < 0) continue;
      const CurveContact contact = contact_with_itself(c);
      tally.add(contact.apart);
      if (contact.apart == ProofStatus::Proven) {
        EXPECT_EQ(exact, 0) << trial;
      }
      if (contact.apart == ProofStatus::Violated) {
        EXPECT_EQ(exact, 1) << trial;
      }
      if (exact == 1 && cells == 1000) {
        EXPECT_EQ(contact.apart, ProofStatus::Violated) << trial;
      }
    }
    EXPECT_GT(tally.none, 1000);
    EXPECT_GT(tally.certain, 100);
    EXPECT_LT(tally.possible, cells == 4 ? 600 : 2) << cells;
  }
}

// ---- One by one ----

const PlanarCurve kArch = curve({{0, 0}, {1, 2}, {2, 0}});  // up to (1, 1)

TEST(CurveContact, TouchingIsNeverProvenApart) {
  const PlanarCurve above = curve({{0, 2}, {1, 0}, {2, 2}});  // tangent at (1, 1)
  const PlanarCurve flat = curve({{0, 1}, {2, 1}}), slanted = curve({{0.5, 1}, {3, 1}});
  for (const PlanarCurve& c : {above, flat, slanted})
    EXPECT_EQ(contact_between(kArch, c).apart, ProofStatus::Undecided);
}

TEST(CurveContact, NearMissesAreDecided) {
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    const PlanarCurve flat = curve({{0, 1 + gap}, {2, 1 + gap}});
    EXPECT_EQ(contact_between(kArch, flat).apart, ProofStatus::Proven) << gap;
    EXPECT_EQ(
        contact_between(
            kArch,
            mapped(flat, [&](const Vector2& p) -> Vector2 { return p - Vector2(0, 2 * gap); }))
            .apart,
        ProofStatus::Violated)
        << gap;
    const PlanarCurve tip = curve({{1, 1 + gap}, {1.5, 4}});  // an end above the arch
    EXPECT_EQ(contact_between(kArch, tip).apart, ProofStatus::Proven) << gap;
  }
  for (const double gap : {1e-3, 1e-6, 1e-8}) {  // parallel
    const PlanarCurve lifted =
        mapped(kArch, [&](const Vector2& p) -> Vector2 { return p + Vector2(0, gap); });
    EXPECT_EQ(contact_between(kArch, lifted).apart, ProofStatus::Proven) << gap;
  }
}

TEST(CurveContact, OverlappingCurves) {
  const PlanarCurve line = curve({{0, 0}, {4, 2}});
  for (const PlanarCurve& other :
       {line, reversed(line), curve({{2, 1}, {6, 3}}), curve({{6, 3}, {2, 1}}),
        curve({{-2, -1}, {6, 3}}), curve({{2, 1}, {3, 7}}), curve({{4, 2}, {9, 9}})})
    EXPECT_EQ(contact_between(line, other).apart, ProofStatus::Violated);
  EXPECT_EQ(contact_between(line, curve({{6, 3}, {8, 4}})).apart,
            ProofStatus::Proven);  // collinear, disjoint
  EXPECT_EQ(contact_between(line, curve({{4.25, 2.125}, {8, 4}})).apart, ProofStatus::Proven);
  EXPECT_EQ(contact_between(kArch, kArch).apart, ProofStatus::Violated);
  EXPECT_EQ(contact_between(kArch, elevated(kArch)).apart, ProofStatus::Violated);
  // The middle half of the arch, whose ends are no control points of the whole.
  const PlanarCurve part = curve({{0.5, 0.75}, {1, 1.25}, {1.5, 0.75}});
  EXPECT_EQ(contact_between(kArch, part).apart, ProofStatus::Undecided);
}

TEST(CurveContact, CommonEnds) {
  const PlanarCurve in = curve({{-2, 0}, {-1, 0}, {0, 0}});
  // Any direction except exactly backwards, straight or curved.
  for (int k = 1; k < 360; ++k) {
    const double t = 3.14159265358979 * (k - 180) / 180;
    const Vector2 d(std::cos(t), std::sin(t)), up(-d.y(), d.x());
    for (const double bend : {-0.1, 0.0, 0.1}) {
      const PlanarCurve out = curve({{0, 0}, 0.01 * d, 0.02 * d + 0.001 * bend * up});
      EXPECT_EQ(contact_of_neighbours(in, out).apart, ProofStatus::Proven) << k << ' ' << bend;
    }
  }
  for (const double angle : {1e-3, 1e-9, 1e-15, 1e-30}) {  // almost backwards
    const PlanarCurve out = curve({{0, 0}, {-0.1, 0.1 * angle}, {-0.2, 0.3 * angle}});
    EXPECT_EQ(contact_of_neighbours(in, out).apart, ProofStatus::Proven) << angle;
    const PlanarCurve over = curve({{0, 0}, {-0.1, 0.1 * angle}, {-0.2, -0.2 * angle}});
    EXPECT_EQ(contact_of_neighbours(in, over).apart, ProofStatus::Violated) << angle;
  }
  // Backwards: along the curve, or leaving it with the same tangent.
  EXPECT_EQ(contact_of_neighbours(in, curve({{0, 0}, {-1, 0}})).apart, ProofStatus::Undecided);
  EXPECT_EQ(contact_of_neighbours(curve({{-2, 0}, {0, 0}}), curve({{0, 0}, {-1, 0}})).apart,
            ProofStatus::Violated);
  EXPECT_EQ(contact_of_neighbours(in, curve({{0, 0}, {-1, 0}, {-2, 1}})).apart,
            ProofStatus::Undecided);
  // A curve that returns to the first one.
  const PlanarCurve back = curve({{0, 0}, {1, 0}, {0, 1}, {-1, -1}});
  EXPECT_EQ(contact_of_neighbours(in, back).apart, ProofStatus::Violated);
  EXPECT_EQ(contact_of_neighbours(in, curve({{0, 0}, {1, 1}, {-2, 0}})).apart,
            ProofStatus::Violated);
  // No tangent at the common end.
  EXPECT_EQ(contact_of_neighbours(in, curve({{0, 0}, {0, 0}, {1, 1}})).apart,
            ProofStatus::Undecided);
}

TEST(CurveContact, SimpleAndSelfIntersectingCurves) {
  EXPECT_EQ(contact_with_itself(kArch).apart, ProofStatus::Proven);
  EXPECT_EQ(contact_with_itself(curve({{0, 0}, {3, 1}})).apart, ProofStatus::Proven);
  EXPECT_EQ(contact_with_itself(curve({{0, 0}, {3, 2}, {-2, 2}, {1, 0}})).apart,
            ProofStatus::Violated);
  // Between a loop and none: a cusp.
  const auto bow = [](double x) { return curve({{0, 0}, {x, 2}, {1 - x, 2}, {1, 0}}); };
  EXPECT_EQ(contact_with_itself(bow(1 - 1e-9)).apart, ProofStatus::Proven);
  EXPECT_EQ(contact_with_itself(bow(1)).apart, ProofStatus::Undecided);
  EXPECT_EQ(contact_with_itself(bow(1 + 1e-9)).apart, ProofStatus::Violated);
  EXPECT_EQ(contact_with_itself(curve({{0, 0}, {1, 1}, {2, 0}, {0, 0}})).apart,
            ProofStatus::Violated);
  EXPECT_EQ(contact_with_itself(curve({{0, 0}, {2, 0}, {1, 0}})).apart, ProofStatus::Undecided);
  EXPECT_EQ(contact_with_itself(curve({{1, 1}, {1, 1}, {1, 1}})).apart, ProofStatus::Violated);
}

TEST(CurveContact, ExtremeNumbersProveNothing) {
  for (const double bad : {double(NAN), double(INFINITY), 1e200}) {
    const PlanarCurve c = curve({{0, 0}, {bad, 1}, {2, 0}});
    EXPECT_EQ(contact_between(c, kArch).apart, ProofStatus::Undecided);
    EXPECT_EQ(contact_between(kArch, c).apart, ProofStatus::Undecided);
    EXPECT_EQ(contact_with_itself(c).apart, ProofStatus::Undecided);
  }
  const PlanarCurve tiny = mapped(kArch, [](const Vector2& p) -> Vector2 { return 1e-200 * p; });
  EXPECT_NE(contact_between(tiny, elevated(tiny)).apart, ProofStatus::Proven);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
