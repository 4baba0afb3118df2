// Polygons for tests of scaffolds, and the properties of every scaffold (scaffold_triangulation.h).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "majorant/maps/bezier_map.h"
#include "majorant/parametrization/scaffold/internal/scaffold_triangulation.h"
#include "mesh/test_meshes.h"
#include "rational.h"
#include "support.h"

namespace majorant {

using Loops = std::vector<Points2>;

inline Points2 polygon(const std::vector<Vector2>& points) {
  Points2 result(static_cast<Index>(points.size()), 2);
  for (Index k = 0; k < result.rows(); ++k) result.row(k) = points[k].transpose();
  return result;
}
// Returns a circle, counterclockwise.
inline Points2 circle(Index count, double radius = 1, const Vector2& centre = Vector2::Zero()) {
  Points2 result(count, 2);
  for (Index k = 0; k < count; ++k) {
    const double angle = 2 * kPi * k / count;
    result.row(k) << centre.x() + radius * std::cos(angle), centre.y() + radius * std::sin(angle);
  }
  return result;
}
inline Points2 reversed(const Points2& loop) { return loop.colwise().reverse(); }
inline Points2 square(double size = 1) {
  return polygon({{0, 0}, {size, 0}, {size, size}, {0, size}});
}

// Returns a band along an Archimedean spiral. The gap between its windings is `gap` of their
// distance. Pieces at its ends are about as long as those of its inner winding.
inline Points2 spiral(Index count, double turns, double gap) {
  std::vector<Vector2> points;
  const auto add = [&](double s, double offset) {
    const double angle = 2 * kPi * turns * s, radius = 1 + turns * s + offset * (1 - gap) / 2;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  };
  const Index pieces = static_cast<Index>(std::ceil(count / (2 * kPi * turns)));
  for (Index k = 0; k < count; ++k) add(k / (count - 1.0), 1);
  for (Index k = 1; k < pieces; ++k) add(1, 1 - 2.0 * k / pieces);
  for (Index k = 0; k < count; ++k) add(1 - k / (count - 1.0), -1);
  for (Index k = 1; k < pieces; ++k) add(0, 2.0 * k / pieces - 1);
  return polygon(points);
}

// Returns a star with random radii between low and high.
inline Points2 random_star(test::Random& random, Index count, double low, double high) {
  const double start = random.uniform(0, 2 * kPi);
  Points2 points(count, 2);
  for (Index k = 0; k < count; ++k) {
    const double angle = start + 2 * kPi * (k + random.uniform(-0.45, 0.45)) / count;
    const double radius = random.uniform(low, high);
    points.row(k) << radius * std::cos(angle), radius * std::sin(angle);
  }
  return points;
}
// Returns one to three nested stars (depth 0 to 2): the outline, a hole and a piece inside the
// hole.
inline Loops random_stars(test::Random& random, int depth) {
  Loops loops = {random_star(random, random.integer(16, 200), 0.7, 1)};
  if (depth > 0) loops.push_back(reversed(random_star(random, random.integer(16, 90), 0.4, 0.6)));
  if (depth > 1) loops.push_back(random_star(random, random.integer(16, 40), 0.1, 0.3));
  return loops;
}

// Returns the sign of the area of a triangle, exact.
inline int orientation(const Points2& p, Index a, Index b, Index c) {
  const auto difference = [&](Index v, Index w, int i) {
    return test::Rational(p(w, i)) - test::Rational(p(v, i));
  };
  const test::Rational area =
      difference(a, b, 0) * difference(a, c, 1) - difference(a, c, 0) * difference(a, b, 1);
  return area.sign();
}

// Relative to the first point, so that the sum does not cancel far from the origin.
inline double area_of(const Points2& p, const std::vector<Index>& loop) {
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

inline double smallest_angle(const Points2& p, const Cells& faces, Index f) {
  double least = kPi;
  for (int k = 0; k < 3; ++k) {
    const Vector2 o = p.row(faces(f, k)), a = p.row(faces(f, (k + 1) % 3)),
                  b = p.row(faces(f, (k + 2) % 3));
    least = std::min(
        least, std::acos(std::clamp((a - o).normalized().dot((b - o).normalized()), -1.0, 1.0)));
  }
  return least * 180 / kPi;
}

inline std::vector<Index> numbers(Index first, Index count) {
  std::vector<Index> result(to_size(count));
  std::iota(result.begin(), result.end(), first);
  return result;
}
// Returns the vertices of each loop.
inline std::vector<std::vector<Index>> loop_vertices(const Loops& loops) {
  std::vector<std::vector<Index>> result;
  Index first = 0;
  for (const Points2& loop : loops) {
    result.push_back(numbers(first, static_cast<Index>(loop.rows())));
    first += static_cast<Index>(loop.rows());
  }
  return result;
}
inline Index edge_count(const Loops& loops) {
  Index count = 0;
  for (const Points2& loop : loops) count += static_cast<Index>(loop.rows());
  return count;
}

using Edges = std::set<std::pair<Index, Index>>;

// Returns the scaffold's boundary: reversed loops, and the frame.
inline Edges expected_boundary(const ScaffoldTriangulation& scaffold, const Loops& loops) {
  Edges edges;
  for (const std::vector<Index>& loop : loop_vertices(loops))
    for (std::size_t k = 0; k < loop.size(); ++k)
      edges.insert({loop[(k + 1) % loop.size()], loop[k]});
  const std::vector<Index>& frame = scaffold.frame;
  for (std::size_t k = 0; k < frame.size(); ++k)
    edges.insert({frame[k], frame[(k + 1) % frame.size()]});
  return edges;
}

// Expects each boundary edge once and unsplit, no other boundary, and no unused vertex. The Euler
// characteristic is that of the frame minus the pieces of the image plus its holes.
// opposite_half_edges throws on edges that are not manifold.
inline void expect_topology(const ScaffoldTriangulation& scaffold, const Loops& loops) {
  const Cells& faces = scaffold.faces;
  const std::vector<Index> opposite = opposite_half_edges(faces);
  Edges boundary;
  Index edges = 0;
  for (Index h = 0; h < static_cast<Index>(opposite.size()); ++h) {
    if (opposite[h] < 0) boundary.insert({faces(h / 3, h % 3), faces(h / 3, (h + 1) % 3)});
    if (opposite[h] < h) ++edges;
  }
  EXPECT_EQ(boundary, expected_boundary(scaffold, loops));
  Index characteristic = 1;
  for (const std::vector<Index>& loop : loop_vertices(loops))
    characteristic += area_of(scaffold.positions, loop) > 0 ? -1 : 1;
  EXPECT_EQ(scaffold.positions.rows() - edges + faces.rows(), characteristic);
  std::set<Index> used;
  for (const Index v : faces.reshaped()) used.insert(v);
  EXPECT_EQ(static_cast<Index>(used.size()), scaffold.positions.rows());
}

// Expects all properties that the header states for every input.
inline void expect_valid(const ScaffoldTriangulation& scaffold, const Loops& loops,
                         const std::string& name) {
  SCOPED_TRACE(name);
  const Points2& p = scaffold.positions;
  long double area = 0;
  for (const std::vector<Index>& loop : loop_vertices(loops)) area += area_of(p, loop);
  Index first = 0;
  for (const Points2& loop : loops) {
    ASSERT_EQ(p.middleRows(first, loop.rows()), loop);
    first += static_cast<Index>(loop.rows());
  }
  for (Index f = 0; f < scaffold.faces.rows(); ++f) {
    const Index a = scaffold.faces(f, 0), b = scaffold.faces(f, 1), c = scaffold.faces(f, 2);
    ASSERT_EQ(orientation(p, a, b, c), 1) << f;
    area += area_of(p, {a, b, c});
  }
  const std::vector<Index>& frame = scaffold.frame;
  for (std::size_t k = 0; k < frame.size(); ++k)
    EXPECT_GE(
        orientation(p, frame[k], frame[(k + 1) % frame.size()], frame[(k + 2) % frame.size()]), 0);
  EXPECT_NEAR(static_cast<double>(area) / area_of(p, frame), 1, 1e-12);
  expect_topology(scaffold, loops);
}

// Smallest angles in degrees: of all triangles, and of those without a corner on the image.
struct Angles {
  double all = 180, away = 180;
};
inline Angles smallest_angles(const ScaffoldTriangulation& scaffold) {
  Angles angles;
  for (Index f = 0; f < scaffold.faces.rows(); ++f) {
    const double angle = smallest_angle(scaffold.positions, scaffold.faces, f);
    angles.all = std::min(angles.all, angle);
    if (scaffold.faces.row(f).minCoeff() >= scaffold.frame[0])
      angles.away = std::min(angles.away, angle);
  }
  return angles;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
