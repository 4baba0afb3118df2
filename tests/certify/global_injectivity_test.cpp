// Results for whole maps: ribbons that overlap, touch or nearly touch, annuli, several charts.
#include "majorant/certify/global_injectivity.h"

#include <gtest/gtest.h>

#include <chrono>
#include <numbers>

#include "certify/exact_curves.h"
#include "maps/test_maps.h"
#include "mesh/surfaces_of_any_genus.h"

namespace majorant {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

Vector2 flat_place(const Vector3& p) { return {p.x(), p.y()}; }

BezierMap flattened(const PolygonMesh& polygons) {
  const auto mesh = surface(polygons);
  return BezierMap::linear(mesh, uv_of(*mesh, flat_place));
}

BezierMap moved(const BezierMap& map, const std::function<Vector2(const Vector2&)>& f) {
  Vec x = map.control_points();
  for (Index k = 0; k < x.size(); k += 2) x.segment<2>(k) = f(x.segment<2>(k));
  return map.with(map.shared_space(), x);
}

// Returns a ramp of `steps` by 2 quads from angle 0 to turns * 2 pi, at radii first(turn) to
// second(turn), projected along z.
using Radius = std::function<double(double)>;
BezierMap ramp(int steps, double turns, const Radius& first, const Radius& second) {
  std::vector<Vector3> positions;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= 2; ++j) {
      const double turn = turns * i / steps, angle = kTurn * (turn - std::floor(turn));
      const double r = j == 0   ? first(turn)
                       : j == 2 ? second(turn)
                                : (first(turn) + second(turn)) / 2;
      positions.push_back({r * std::cos(angle), r * std::sin(angle), turn});
    }
  std::vector<std::vector<Index>> faces;
  for (Index i = 0; i < steps; ++i)
    for (Index j = 0; j < 2; ++j) {
      const Index a = 3 * i + j;
      faces.push_back({a, a + 1, a + 4});
      faces.push_back({a, a + 4, a + 3});
    }
  return flattened(polygon_mesh(positions, faces));
}

double one(double) { return 1; }
double two(double) { return 2; }

void expect(const BezierMap& map, ProofStatus result, const std::string& what) {
  for (int degree = 1; degree <= 3; ++degree) {
    const GlobalInjectivity proof = check_boundary(elevated_to(map, degree));
    EXPECT_EQ(static_cast<int>(proof.result), static_cast<int>(result)) << what << ' ' << degree;
    EXPECT_EQ(proof.result == ProofStatus::Proven, proof.contacts.empty() && proof.reason.empty());
    for (const BoundaryContact& c : proof.contacts) {
      EXPECT_LT(map.mesh().opposite(c.half_edge_a), 0);
      EXPECT_LT(map.mesh().opposite(c.half_edge_b), 0);
    }
  }
}

TEST(GlobalInjectivity, DisksInThePlane) {
  expect(flattened(grid(6)), ProofStatus::Proven, "grid");
  expect(flattened(one_triangle()), ProofStatus::Proven, "triangle");
  const auto cap = generated("cap");
  expect(BezierMap::linear(cap, uv_of(*cap, flat_place)), ProofStatus::Proven, "cap");
  for (unsigned seed = 0; seed < 20; ++seed) {
    const BezierMap map = shaken(elevated_to(flattened(grid(6)), 3), 0.02, seed);
    EXPECT_EQ(check_boundary(map).result, ProofStatus::Proven) << seed;
  }
  EXPECT_GE(check_boundary(elevated_to(flattened(grid(6)), 2)).pairs_tested, 24);
}

TEST(GlobalInjectivity, RampsThatGoRoundMoreThanOnceOverlap) {
  for (const double turns : {0.3, 0.9, 0.999, 1 - 1e-9})
    expect(ramp(60, turns, one, two), ProofStatus::Proven, "short ramp");
  for (const double turns : {1 + 1e-9, 1.001, 1.2, 2.5})
    expect(ramp(60, turns, one, two), ProofStatus::Violated, "long ramp");
  // The end edge crosses the sides of the first turn at a moderate distance.
  const BezierMap map = ramp(60, 1.2, one, two);
  const GlobalInjectivity proof = check_boundary(map);
  ASSERT_FALSE(proof.contacts.empty());
  for (const BoundaryContact& c : proof.contacts) {
    EXPECT_EQ(c.apart, ProofStatus::Violated);
    EXPECT_GT(c.where.norm(), 0.98);
    EXPECT_LT(c.where.norm(), 2.02);
    EXPECT_LE(c.half_edge_a, c.half_edge_b);
  }
}

TEST(GlobalInjectivity, Spirals) {
  const auto pitch = [](double p) { return [p](double turn) { return 1 + p * turn; }; };
  const auto outer = [](double p) { return [p](double turn) { return 2 + p * turn; }; };
  for (const double gap : {1e-3, 1e-9, 1e-12})
    expect(ramp(128, 4, pitch(1 + gap), outer(1 + gap)), ProofStatus::Proven, "spiral");
  for (const double gap : {1e-3, 1e-9, 1e-12})
    expect(ramp(128, 4, pitch(1 - gap), outer(1 - gap)), ProofStatus::Violated, "overlap");
  // Turns that touch along their whole length; with 32 steps per turn, radii and angles are exact.
  expect(ramp(128, 4, pitch(1), outer(1)), ProofStatus::Violated, "touching turns");
}

TEST(GlobalInjectivity, SizeAndPlaceDoNotMatter) {
  for (const double scale : {1e-6, 1.0, 1e6, 0x1p-200, 0x1p200})
    for (const double offset : {0.0, 1e6}) {
      const auto f = [&](const Vector2& p) -> Vector2 {
        return scale * (p + offset * Vector2(1, -2));
      };
      expect(moved(ramp(30, 0.95, one, two), f), ProofStatus::Proven, "short ramp");
      expect(moved(ramp(30, 1.05, one, two), f), ProofStatus::Violated, "long ramp");
    }
}

TEST(GlobalInjectivity, SurfacesWithHoles) {
  expect(flattened(grid_without(7, {24})), ProofStatus::Proven, "annulus");
  expect(flattened(grid_without(9, {20, 24, 60})), ProofStatus::Proven, "three holes");
  // z^2 has the winding number 2.
  const auto squared = [](const Vector2& p) -> Vector2 {
    const Vector2 q = p - Vector2(0.5, 0.5);
    return {q.x() * q.x() - q.y() * q.y(), 2 * q.x() * q.y()};
  };
  expect(moved(flattened(grid_without(7, {24})), squared), ProofStatus::Violated, "double cover");
}

TEST(GlobalInjectivity, LoopsMustTurnTheRightWay) {
  const auto mirrored = [](const Vector2& p) -> Vector2 { return {-p.x(), p.y()}; };
  for (const auto& polygons : {grid(4), grid_without(7, {24})}) {
    const BezierMap map = moved(flattened(polygons), mirrored);
    expect(map, ProofStatus::Violated, "mirrored");
    EXPECT_FALSE(check_boundary(map).reason.empty());
  }
  // Without boundary, no map is injective.
  const BezierMap closed = flattened(tetrahedron());
  expect(closed, ProofStatus::Violated, "closed");
}

TEST(GlobalInjectivity, SectorsAtTheBoundary) {
  const auto mesh = surface(cone(7, false));
  for (const double sum : {1.0, 5.0, 6.28, kTurn - 1e-9, kTurn + 1e-9, 6.3, 7.0, 11.0}) {
    Vec uv = Vec::Zero(2 * mesh->vertex_count());
    for (Index v = 1; v < mesh->vertex_count(); ++v)
      uv.segment<2>(2 * v) << std::cos(sum * (v - 1) / 7), std::sin(sum * (v - 1) / 7);
    expect(BezierMap::linear(mesh, uv), sum < kTurn ? ProofStatus::Proven : ProofStatus::Violated,
           std::to_string(sum));
  }
}

// ---- Several charts ----

// Returns the grid, cut along its middle or around a square in its middle, with the second piece
// moved.
BezierMap two_pieces(const std::function<bool(const Vector3&)>& second,
                     const std::function<Vector2(const Vector2&)>& move) {
  const auto whole = surface(grid(8));
  const auto is_second = [&](Index face) {
    Vector3 center = Vector3::Zero();
    for (Index k = 0; k < 3; ++k) center += whole->positions().row(whole->faces()(face, k)) / 3;
    return second(center);
  };
  std::vector<char> cut(to_size(whole->half_edge_count()), 0);
  for (Index h = 0; h < whole->half_edge_count(); ++h)
    cut[h] = whole->opposite(h) >= 0 && is_second(h / 3) != is_second(whole->opposite(h) / 3);
  const auto pieces = std::make_shared<const SurfaceMesh>(whole->cut_along(cut, nullptr));
  EXPECT_EQ(pieces->topology().components, 2);
  Vec uv = uv_of(*pieces, flat_place);
  std::vector<char> done(to_size(pieces->vertex_count()), 0);
  for (Index h = 0; h < pieces->half_edge_count(); ++h) {
    const Index v = pieces->from_vertex(h);
    if (!is_second(h / 3) || done[v]) continue;
    done[v] = 1;
    uv.segment<2>(2 * v) = move(uv.segment<2>(2 * v));
  }
  return BezierMap::linear(pieces, uv);
}

TEST(GlobalInjectivity, ChartsMustNotOverlap) {
  const auto right = [](const Vector3& p) { return p.x() > 0.5; };
  const auto middle = [](const Vector3& p) {
    return std::max(std::abs(p.x() - 0.5), std::abs(p.y() - 0.5)) < 0.25;
  };
  const auto by = [](double dx, double scale) {
    return [=](const Vector2& p) -> Vector2 {
      return scale * (p - Vector2(0.5, 0.5)) + Vector2(0.5 + dx, 0.5);
    };
  };
  expect(two_pieces(right, by(1e-3, 1)), ProofStatus::Proven, "apart");
  expect(two_pieces(right, by(0, 1)), ProofStatus::Violated, "in place, touching");
  expect(two_pieces(right, by(-1e-3, 1)), ProofStatus::Violated, "overlapping");
  expect(two_pieces(right, by(-0.3, 0.1)), ProofStatus::Violated, "inside the other");
  expect(two_pieces(right, by(-1, 5)), ProofStatus::Violated, "crossing the other");
  expect(
      two_pieces(right, [](const Vector2& p) -> Vector2 { return 50 * (p - Vector2(0.75, 0.3)); }),
      ProofStatus::Violated, "around the other");
  expect(two_pieces(middle, by(0, 0.9)), ProofStatus::Proven, "in the hole");
  expect(two_pieces(middle, by(3, 1)), ProofStatus::Proven, "beside");
  expect(two_pieces(middle, by(0, 1)), ProofStatus::Violated, "filling the hole");
  expect(two_pieces(middle, by(0, 1.1)), ProofStatus::Violated, "larger than the hole");
  expect(two_pieces(middle, by(0, 10)), ProofStatus::Violated, "over everything");
  expect(two_pieces(middle, by(0.375, 0.1)), ProofStatus::Violated, "on the ring");
}

// ---- Against brute force ----

// Returns the side of the line from a to b.
int side(const Vector2& a, const Vector2& b, const Vector2& p) {
  using exact::Rational;
  const Rational x = Rational(b.x()) - Rational(a.x()), y = Rational(b.y()) - Rational(a.y());
  return Rational(x * (Rational(p.y()) - Rational(a.y())) - y * (Rational(p.x()) - Rational(a.x())))
      .sign();
}

// Segments in general position: no three of their ends are collinear.
bool cross(const std::array<Vector2, 2>& s, const std::array<Vector2, 2>& t) {
  return side(s[0], s[1], t[0]) != side(s[0], s[1], t[1]) &&
         side(t[0], t[1], s[0]) != side(t[0], t[1], s[1]);
}

// Random polygons as boundaries of fans; most of them intersect themselves.
TEST(GlobalInjectivity, PolygonsAgreeWithBruteForce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  int simple = 0, crossing = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int count = 8 + trial % 20;
    const auto mesh = surface(cone(count, true));
    Vec uv = Vec::Zero(2 * mesh->vertex_count());
    std::vector<Vector2> rim;
    for (int k = 0; k < count; ++k) {
      const double t = kTurn * (k + 1.6 * uniform(random)) / count, r = 0.2 + uniform(random);
      uv.segment<2>(2 * (k + 1)) << r * std::cos(t), r * std::sin(t);
      rim.push_back(uv.segment<2>(2 * (k + 1)));
    }
    bool expected = false;
    const auto segment = [&](int k) { return std::array{rim[k], rim[(k + 1) % count]}; };
    for (int i = 0; i < count; ++i)
      for (int j = i + 2; j < count - (i == 0); ++j) expected |= cross(segment(i), segment(j));
    ++(expected ? crossing : simple);
    expect(BezierMap::linear(mesh, uv), expected ? ProofStatus::Violated : ProofStatus::Proven,
           "polygon " + std::to_string(trial));
  }
  EXPECT_GT(simple, 20);
  EXPECT_GT(crossing, 20);
}

TEST(GlobalInjectivity, BadNumbersAreUndecided) {
  for (const double bad : {double(NAN), double(INFINITY), 1e200}) {
    BezierMap map = elevated_to(flattened(grid(3)), 2);
    Vec x = map.control_points();
    x[2] = bad;
    EXPECT_EQ(check_boundary(map.with(map.shared_space(), x)).result, ProofStatus::Undecided);
  }
  // All points coincide: contacts, but a limited number.
  const BezierMap map = moved(flattened(grid(40)), [](const Vector2&) -> Vector2 {
    return {1, 1};
  });
  const GlobalInjectivity proof = check_boundary(map);
  EXPECT_EQ(proof.result, ProofStatus::Violated);
  EXPECT_LE(proof.contacts.size(), 100u);
}

// 10^5 boundary edges: a search over all pairs would be too slow.
TEST(GlobalInjectivity, LongBoundariesTakeSeconds) {
  const auto inner = [](double turn) { return 1 + turn; };
  const auto outer = [](double turn) { return 1.5 + turn; };
  const BezierMap map = elevated_to(ramp(50000, 20, inner, outer), 3);
  const auto start = std::chrono::steady_clock::now();
  const GlobalInjectivity proof = check_boundary(map);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(proof.result, ProofStatus::Proven);
  EXPECT_LT(proof.pairs_tested, 1000000);
  RecordProperty("milliseconds", static_cast<int>(1000 * seconds.count()));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
