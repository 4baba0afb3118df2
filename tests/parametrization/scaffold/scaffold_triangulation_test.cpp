// Scaffolds around polygons: they fill the frame outside the image, keep the boundary, and have
// good triangles where the boundary allows them.
#include "majorant/parametrization/scaffold/internal/scaffold_triangulation.h"

#include <fmt/format.h>

#include "expected_error.h"
#include "majorant/framework/error.h"
#include "parametrization/scaffold/scaffold_checks.h"

namespace majorant {
namespace {

// Returns the smallest angle, in degrees, of a triangle of that ratio of circumradius to shortest
// edge.
double angle_of(double quality) { return std::asin(0.5 / quality) * 180 / kPi; }

// Triangulates and checks the properties of every scaffold, and those for common images: few
// triangles, and angles of at least `away` degrees away from the image.
ScaffoldTriangulation checked(const Loops& loops, const std::string& name, double away = 19) {
  ScaffoldTriangulation scaffold = triangulate_scaffold(loops);
  expect_valid(scaffold, loops, name);
  const Angles angles = smallest_angles(scaffold);
  EXPECT_GE(angles.away, away) << name;
  EXPECT_LE(scaffold.faces.rows(), 5 * edge_count(loops) + 100) << name;
  testing::Test::RecordProperty(
      name, fmt::format("{} edges, {} faces, angles {:.1f}, away {:.1f}", edge_count(loops),
                        scaffold.faces.rows(), angles.all, angles.away));
  return scaffold;
}

TEST(Scaffold, OfASquare) {
  const ScaffoldTriangulation scaffold = checked({square()}, "square");
  EXPECT_EQ(scaffold.frame[0], 4);
  EXPECT_EQ(Vector2(scaffold.positions.row(4)), Vector2(-1, -1));
  EXPECT_EQ(Vector2(scaffold.positions.colwise().maxCoeff()), Vector2(2, 2));
  EXPECT_LE(scaffold.faces.rows(), 60);
  EXPECT_GE(smallest_angles(scaffold).all, angle_of(1.5) - 1e-9);
}

TEST(Scaffold, OfCirclesGrowsWithTheBoundary) {
  for (const Index count : {3, 4, 5, 7, 10, 30, 100, 300, 1000, 5000}) {
    const ScaffoldTriangulation scaffold =
        checked({circle(count)}, "circle " + std::to_string(count));
    EXPECT_GE(smallest_angles(scaffold).all, angle_of(1.5) - 1e-9) << count;
    EXPECT_LE(scaffold.faces.rows(), 4 * count + 20);
  }
}

TEST(Scaffold, FillsHoles) {
  checked({circle(100), reversed(circle(60, 0.7))}, "annulus");
  checked({circle(100), reversed(circle(100, 0.99))}, "thin annulus");
  checked({circle(40), reversed(circle(9, 0.2, {-0.5, 0})), reversed(circle(30, 0.4, {0.4, 0.2})),
           reversed(circle(4, 0.1, {0, -0.7}))},
          "holes");
  checked({circle(40), reversed(circle(30, 0.8)), circle(20, 0.6), reversed(circle(9, 0.3)),
           circle(5, 0.1), circle(12, 1, {3, 0})},
          "pieces in holes");
  // An equilateral hole needs one triangle.
  const ScaffoldTriangulation scaffold =
      checked({circle(30), reversed(circle(3, 0.5))}, "triangle");
  Index inside = 0;
  for (Index f = 0; f < scaffold.faces.rows(); ++f)
    inside += scaffold.faces.row(f).minCoeff() >= 30 && scaffold.faces.row(f).maxCoeff() < 33;
  EXPECT_EQ(inside, 1);
}

TEST(Scaffold, ReachesIntoCorridors) {
  for (const double gap : {0.5, 0.1, 1e-2, 1e-4, 1e-8})
    for (const Index count : {31, 301, 3001})
      checked({spiral(count, 3, gap)}, fmt::format("spiral {} {}", count, gap), 15);
}

// Bounds depend on the ratio of the shortest edge to the frame.
TEST(Scaffold, GrowsFromTheShortestEdge) {
  for (const double tip : {1e-2, 1e-5, 1e-9}) {
    const Loops loops = {polygon({{0, 0}, {1, 0}, {1, 1}, {tip, 1}, {0, 1 - tip}})};
    const ScaffoldTriangulation scaffold = triangulate_scaffold(loops);
    expect_valid(scaffold, loops, std::to_string(tip));
    EXPECT_LE(scaffold.faces.rows(), 100 - 20 * std::log10(tip));
  }
}

TEST(Scaffold, CollinearBoundaryPoints) {
  for (const double slope : {0.0, 0.1, 1.0 / 3})
    for (const Index count : {3, 40}) {
      std::vector<Vector2> points;
      const Vector2 x(1, slope), y(-slope, 1);
      for (const auto& [from, to] : std::vector<std::pair<Vector2, Vector2>>{
               {{0, 0}, x}, {x, x + y}, {x + y, y}, {y, {0, 0}}})
        for (Index k = 0; k < count; ++k)
          points.push_back(from + static_cast<double>(k) / count * (to - from));
      checked({polygon(points)}, fmt::format("slope {} {}", slope, count));
      checked({circle(9, 10), reversed(polygon(points))}, fmt::format("hole {} {}", slope, count));
    }
}

// On jagged boundaries, long edges next to short ones lead to worse triangles.
TEST(Scaffold, RandomStarsInStars) {
  test::Random random(3);
  for (int round = 0; round < 200; ++round)
    checked(random_stars(random, round % 3), "star " + std::to_string(round), 10);
}

TEST(Scaffold, AnySizeAnywhere) {
  test::Random random(4);
  const Loops loops = random_stars(random, 2);
  for (const double scale : {1e-6, 1e-3, 1e3, 1e6, 1e-60, 1e60})
    for (const double offset : {0.0, 1.0, 1e4, -1e8}) {
      Loops moved = loops;
      for (Points2& loop : moved) loop = (loop.array() + offset).matrix() * scale;
      checked(moved, fmt::format("scale {} offset {}", scale, offset), 10);
    }
  // A scale by powers of two changes no triangle.
  const ScaffoldTriangulation scaffold = triangulate_scaffold(loops);
  Loops scaled = loops;
  for (Points2& loop : scaled) loop *= 1024;
  const ScaffoldTriangulation same = triangulate_scaffold(scaled);
  EXPECT_EQ(scaffold.faces, same.faces);
  EXPECT_EQ(Points2(1024 * scaffold.positions), same.positions);
}

// Returns the triangles by the positions of their corners.
std::set<std::set<std::pair<double, double>>> triangles(const ScaffoldTriangulation& scaffold) {
  std::set<std::set<std::pair<double, double>>> result;
  for (const auto& face : scaffold.faces.rowwise()) {
    std::set<std::pair<double, double>> corners;
    for (const Index v : face) corners.insert({scaffold.positions(v, 0), scaffold.positions(v, 1)});
    result.insert(corners);
  }
  return result;
}

TEST(Scaffold, DoesNotDependOnWhereLoopsStart) {
  test::Random random(5);
  for (int round = 0; round < 30; ++round) {
    const Loops loops = round == 0  ? Loops{square()}
                        : round < 3 ? Loops{circle(64), reversed(circle(32, 0.5))}
                                    : random_stars(random, round % 3);
    const ScaffoldTriangulation scaffold = triangulate_scaffold(loops),
                                again = triangulate_scaffold(loops);
    EXPECT_EQ(scaffold.faces, again.faces);
    EXPECT_EQ(scaffold.positions, again.positions);
    Loops turned;
    for (const Points2& loop : loops) {
      const Index count = static_cast<Index>(loop.rows()), shift = random.integer(1, count - 1);
      Points2 other(count, 2);
      other << loop.bottomRows(count - shift), loop.topRows(shift);
      turned.push_back(other);
    }
    EXPECT_EQ(triangles(scaffold), triangles(triangulate_scaffold(turned))) << round;
  }
}

TEST(Scaffold, OptionsSetMarginAndAngles) {
  for (const double margin : {1e-3, 0.05, 0.3, 1.0, 4.0, 100.0})
    for (const double quality : {1.0, 1.2, 1.5, 3.0}) {
      const Loops loops = {circle(30), reversed(circle(20, 0.5))};
      const ScaffoldTriangulation scaffold =
          triangulate_scaffold(loops, {.margin = margin, .quality = quality});
      expect_valid(scaffold, loops, fmt::format("{} {}", margin, quality));
      EXPECT_NEAR(scaffold.positions.col(0).maxCoeff(), 1 + 2 * margin, 0.02 * (1 + margin));
      if (margin >= 0.05) {
        EXPECT_GE(smallest_angles(scaffold).away, std::min(17.0, 0.9 * angle_of(quality)));
      }
      EXPECT_LE(scaffold.faces.rows(), 1000);
    }
  EXPECT_THROW(triangulate_scaffold({square()}, {.margin = 0}), InvalidArgument);
  EXPECT_THROW(triangulate_scaffold({square()}, {.quality = 0.9}), InvalidArgument);
}

void expect_refused(const Loops& loops, const std::string& first, const std::string& second) {
  const std::string message =
      error_message(ErrorKind::Infeasible, [&] { triangulate_scaffold(loops); });
  expect_contains(message, {"edges " + first + " and " + second + " ", "intersect or touch"});
}

TEST(Scaffold, NamesBoundaryEdgesThatMeet) {
  const std::string a = "(0, 1) of loop 0", b = "(1, 2) of loop 0", c = "(2, 3) of loop 0";
  expect_refused({polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}})}, a, c);
  // A corner on an edge, on another corner, on the next edge, on the previous edge.
  expect_refused({polygon({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}})}, a, c);
  expect_refused({polygon({{0, 0}, {1, 0}, {1, 1}, {0, 0}, {-1, 1}})}, a, c);
  expect_refused({polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}})}, a, b);
  expect_refused({polygon({{0, 0}, {2, 0}, {1, 0}, {1, 1}})}, a, b);
  // Area 0.
  expect_refused({polygon({{0, 0}, {0, 0}, {0, 0}})}, a, b);
  expect_refused({polygon({{0, 0}, {1, 1}, {2, 2}})}, a, "(2, 0) of loop 0");
  // Two loops.
  const Points2 hole = polygon({{0.5, 0.2}, {0.2, 0.5}, {1.2, 0.5}});
  expect_refused({square(), hole}, b, "(5, 6) of loop 1");
  expect_refused({square(), square()}, a, "(4, 5) of loop 1");
  expect_refused({square(), polygon({{0.5, 0}, {0.2, 0.5}, {0.8, 0.5}})}, a, "(4, 5) of loop 1");
  // Intersections by one rounding error, or none.
  const double below = std::nextafter(1.0, 0.0), above = std::nextafter(1.0, 2.0);
  const auto notch = [](double y) {
    return Loops{polygon({{0, 0}, {3, 0}, {3, 2}, {1.5, y}, {0, 2}}),
                 polygon({{2, 1}, {2, 0.5}, {1.3, 0.5}, {1, 1}})};
  };
  checked(notch(above), "above", 0);
  expect_refused(notch(1), c, "(8, 5) of loop 1");
  expect_refused(notch(below), c, "(8, 5) of loop 1");
}

// Returns, in integers, whether two edges of a loop intersect where they must not.
bool meets_itself(const Points2& p) {
  const Index count = static_cast<Index>(p.rows());
  const auto side = [&](Index a, Index b, Index c) {
    const Vector2 x = p.row(b) - p.row(a), y = p.row(c) - p.row(a);
    const double area = cross(x, y);
    return area > 0 ? 1 : area < 0 ? -1 : 0;
  };
  const auto holds = [&](Index a, Index b, Index c) {  // whether c is on the edge ab
    return side(a, b, c) == 0 && (p.row(a) - p.row(c)).dot(p.row(b) - p.row(c)) <= 0;
  };
  for (Index a = 0; a < count; ++a)
    for (Index c = 0; c < count; ++c) {
      const Index b = (a + 1) % count, d = (c + 1) % count;
      if (c != a && c != b && holds(a, b, c)) return true;
      if (c == a || c == b || d == a) continue;
      if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0) return true;
    }
  return false;
}

TEST(Scaffold, RefusesExactlyTheLoopsThatMeetThemselves) {
  test::Random random(6);
  int accepted = 0;
  for (int round = 0; round < 3000; ++round) {
    Points2 loop(random.integer(3, 7), 2);
    for (double& x : loop.reshaped()) x = random.integer(0, 5);
    if (meets_itself(loop)) {
      const std::string message =
          error_message(ErrorKind::Infeasible, [&] { triangulate_scaffold({loop}); });
      expect_contains(message, {"intersect or touch"});
      continue;
    }
    if (area_of(loop, numbers(0, static_cast<Index>(loop.rows()))) < 0) loop = reversed(loop);
    expect_valid(triangulate_scaffold({loop}), {loop}, std::to_string(round));
    ++accepted;
  }
  EXPECT_GT(accepted, 300);
}

TEST(Scaffold, RefusesInvalidImages) {
  for (const Loops& loops : {Loops{reversed(square())}, Loops{circle(9), circle(9, 0.5)},
                             Loops{circle(9), reversed(circle(9, 0.5)), reversed(circle(9, 0.2))}})
    expect_contains(error_message(ErrorKind::Infeasible, [&] { triangulate_scaffold(loops); }),
                    {fmt::format("loop {} has the image on its right", loops.size() - 1)});
  Points2 infinite = square();
  infinite(2, 1) = std::numeric_limits<double>::infinity();
  for (const Loops& loops : {Loops{}, Loops{square(), polygon({{0, 0}, {1, 0}})}, Loops{infinite}})
    EXPECT_THROW(triangulate_scaffold(loops), InvalidArgument);
  Points2 far = square(64);
  far.array() += 1e16;
  expect_contains(
      error_message(ErrorKind::Infeasible, [&] { triangulate_scaffold({far}, {.margin = 0.01}); }),
      {"no frame fits", "0.01"});
}

TEST(EnlargedFrame, SurroundsTheOldOne) {
  const ScaffoldTriangulation inner = triangulate_scaffold({circle(50)});
  Points2 frame(static_cast<Index>(inner.frame.size()), 2);
  for (Index k = 0; k < frame.rows(); ++k) frame.row(k) = inner.positions.row(inner.frame[k]);
  const ScaffoldTriangulation ring = enlarge_frame(frame, 0.5);
  expect_valid(ring, {frame}, "ring");
  EXPECT_NEAR(ring.positions.minCoeff(), -6, 0.1);  // 3 radii, and half of 6
  EXPECT_GE(smallest_angles(ring).all, 19);
  EXPECT_LE(ring.faces.rows(), 150);
}

TEST(FrameIsTight, ByDistanceToItsSides) {
  const Points2 frame = polygon({{0, 0}, {5, 0}, {10, 0}, {10, 4}, {0, 4}});  // smaller extent 4
  EXPECT_FALSE(frame_is_tight(frame, polygon({{0.5, 0.5}, {9, 2}}), 0.1));
  EXPECT_TRUE(frame_is_tight(frame, polygon({{0.3, 0.5}, {9, 2}}), 0.1));
  EXPECT_TRUE(frame_is_tight(frame, polygon({{5, 2}, {7, 3.7}}), 0.1));
  EXPECT_TRUE(frame_is_tight(frame, polygon({{5, 2}, {20, 2}}), 0));  // outside
  EXPECT_TRUE(frame_is_tight(frame, polygon({{5, 2}, {std::nan(""), 2}}), 0));
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
