// Scaffolds around polygons: they fill what the image leaves of the frame, keep the boundary as it
// is, and have good triangles where the boundary lets them.
#include "majorant/parametrization/scaffold_triangulation.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "majorant/parametrization/bezier_mesh.h"
#include "parametrization/parametrization_test_helpers.h"

namespace majorant {
namespace {

using Loops = std::vector<Points2>;

Points2 polygon(const std::vector<Vector2>& points) {
  Points2 result(static_cast<Index>(points.size()), 2);
  for (Index k = 0; k < result.rows(); ++k) result.row(k) = points[at(k)].transpose();
  return result;
}
// Counterclockwise; radius by angle.
Points2 star(Index count, const Vector2& centre, const std::function<double(double)>& radius) {
  Points2 result(count, 2);
  for (Index k = 0; k < count; ++k) {
    const double angle = 2 * kPi * k / count, r = radius(angle);
    result.row(k) << centre.x() + r * std::cos(angle), centre.y() + r * std::sin(angle);
  }
  return result;
}
Points2 circle(Index count, double radius = 1, const Vector2& centre = Vector2::Zero()) {
  return star(count, centre, [&](double) { return radius; });
}
Points2 reversed(const Points2& loop) { return loop.colwise().reverse(); }
Points2 square(double size = 1) { return polygon({{0, 0}, {size, 0}, {size, size}, {0, size}}); }

// A band along an Archimedean spiral; the gap between its windings is `gap` of their distance.
Points2 spiral(Index count, double turns, double gap) {
  std::vector<Vector2> points;
  const auto side = [&](double offset, bool back) {
    for (Index k = 0; k < count; ++k) {
      const double s = static_cast<double>(back ? count - 1 - k : k) / (count - 1);
      const double angle = 2 * kPi * turns * s, radius = 1 + turns * s + offset;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
  };
  side((1 - gap) / 2, false);
  side(-(1 - gap) / 2, true);
  return polygon(points);
}

// Sign of the area of a triangle; exact while coordinates, scaled by a power of two, have 53 bits
// that 113 bits of products hold; double rounding aside, good for every test here.
int orientation(const Points2& p, Index a, Index b, Index c) {
  const auto x = [&](Index v) { return static_cast<__float128>(p(v, 0)); };
  const auto y = [&](Index v) { return static_cast<__float128>(p(v, 1)); };
  const __float128 area = (x(b) - x(a)) * (y(c) - y(a)) - (x(c) - x(a)) * (y(b) - y(a));
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

// Relative to the first point: the sum does not cancel far from the origin.
double area_of(const Points2& p, const std::vector<Index>& loop) {
  long double area = 0;
  const auto relative = [&](Index v, int c) {
    return static_cast<long double>(p(v, c)) - p(loop[0], c);
  };
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Index a = loop[k], b = loop[(k + 1) % loop.size()];
    area += relative(a, 0) * relative(b, 1) - relative(a, 1) * relative(b, 0);
  }
  return static_cast<double>(area / 2);
}

double smallest_angle(const Points2& p, const Cells& faces, Index f) {
  double least = kPi;
  for (int k = 0; k < 3; ++k) {
    const Vector2 o = p.row(faces(f, k)), a = p.row(faces(f, (k + 1) % 3)),
                  b = p.row(faces(f, (k + 2) % 3));
    least = std::min(least, std::acos(std::clamp((a - o).normalized().dot((b - o).normalized()),
                                                 -1.0, 1.0)));
  }
  return least * 180 / kPi;
}

std::vector<Index> numbers(Index first, Index count) {
  std::vector<Index> result(at(count));
  for (Index k = 0; k < count; ++k) result[at(k)] = first + k;
  return result;
}

// Every statement of the header that holds for all input.
void expect_valid(const ScaffoldTriangulation& scaffold, const Loops& loops, const std::string& name) {
  SCOPED_TRACE(name);
  const Points2& p = scaffold.positions;
  const Index face_count = static_cast<Index>(scaffold.faces.rows());
  Index boundary = 0;
  for (const Points2& loop : loops) {
    ASSERT_EQ(p.middleRows(boundary, loop.rows()), loop);
    boundary += static_cast<Index>(loop.rows());
  }
  long double total = 0;
  std::vector<char> used(at(static_cast<Index>(p.rows())), 0);
  for (Index f = 0; f < face_count; ++f) {
    const std::vector<Index> corners = {scaffold.faces(f, 0), scaffold.faces(f, 1),
                                        scaffold.faces(f, 2)};
    ASSERT_EQ(orientation(p, corners[0], corners[1], corners[2]), 1) << f;
    total += area_of(p, corners);
    for (const Index v : corners) used[at(v)] = 1;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);

  // The scaffold's boundary is made of the loops, from the other side, and of the frame: nothing is
  // split, nothing is missing. opposite_half_edges throws on edges that are not manifold.
  std::set<std::pair<Index, Index>> expected, found;
  double image = 0;
  Index first = 0;
  for (const Points2& loop : loops) {
    const Index count = static_cast<Index>(loop.rows());
    for (Index k = 0; k < count; ++k) expected.insert({first + (k + 1) % count, first + k});
    image += area_of(p, numbers(first, count));
    first += count;
  }
  const std::vector<Index>& frame = scaffold.frame;
  for (std::size_t k = 0; k < frame.size(); ++k) {
    const Index a = frame[k], b = frame[(k + 1) % frame.size()], c = frame[(k + 2) % frame.size()];
    expected.insert({a, b});
    EXPECT_GE(orientation(p, a, b, c), 0);
  }
  const std::vector<Index> opposite = opposite_half_edges(scaffold.faces);
  Index edges = 0;
  for (Index h = 0; h < 3 * face_count; ++h) {
    if (opposite[at(h)] < 0)
      found.insert({scaffold.faces(h / 3, h % 3), scaffold.faces(h / 3, (h + 1) % 3)});
    if (opposite[at(h)] < h) ++edges;
  }
  EXPECT_EQ(found, expected);
  // Frame, minus the pieces of the image, plus its holes.
  Index holes = 0, pieces = 0;
  first = 0;
  for (const Points2& loop : loops) {
    const Index count = static_cast<Index>(loop.rows());
    ++(area_of(p, numbers(first, count)) > 0 ? pieces : holes);
    first += count;
  }
  EXPECT_EQ(p.rows() - edges + face_count, 1 - pieces + holes);
  const double whole = area_of(p, frame);
  EXPECT_NEAR((static_cast<double>(total) + image) / whole, 1, 1e-12);
}

TEST(Scaffold, OfASquare) {
  const ScaffoldTriangulation scaffold = triangulate_scaffold({square()});
  expect_valid(scaffold, {square()}, "square");
  const Points2& p = scaffold.positions;
  EXPECT_EQ(scaffold.frame[0], 4);
  EXPECT_EQ(Vector2(p.row(4)), Vector2(-1, -1));
  EXPECT_EQ(p.colwise().maxCoeff(), Eigen::RowVector2d(2, 2));
  EXPECT_LE(scaffold.faces.rows(), 60);
  for (Index f = 0; f < scaffold.faces.rows(); ++f)
    EXPECT_GE(smallest_angle(p, scaffold.faces, f), 19.4);
}

TEST(Scaffold, OfCirclesGrowsWithTheBoundary) {
  for (const Index count : {3, 4, 5, 7, 10, 30, 100, 300, 1000, 5000}) {
    const Loops loops = {circle(count)};
    const auto start = std::chrono::steady_clock::now();
    const ScaffoldTriangulation scaffold = triangulate_scaffold(loops);
    const double ms =
        1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    expect_valid(scaffold, loops, std::to_string(count));
    double least = 180;
    for (Index f = 0; f < scaffold.faces.rows(); ++f)
      least = std::min(least, smallest_angle(scaffold.positions, scaffold.faces, f));
    std::printf("%d: faces %d ms %g angle %g\n", count, (int)scaffold.faces.rows(), ms, least);
  }
  const Loops loops = {spiral(100,3,0.1)};
    const ScaffoldTriangulation scaffold = triangulate_scaffold(loops);
    expect_valid(scaffold, loops, "spiral");
    std::printf("faces %d\n", (int)scaffold.faces.rows());
}

}  // namespace
}  // namespace majorant
