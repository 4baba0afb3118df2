// Charts of many shapes, and tests of layouts by brute force, independent of the packers.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "majorant/maps/bezier_map.h"
#include "majorant/parametrization/packing/pack.h"
#include "random.h"
#include "rational.h"

namespace majorant::test {

using Corners = std::vector<Vector2>;

inline BezierMap chart_of(const std::vector<Vector2>& points,
                          const std::vector<std::vector<Index>>& polygons) {
  PolygonMesh mesh;
  for (const Vector2& p : points) mesh.positions.emplace_back(p.x(), p.y(), 0);
  mesh.polygons = polygons;
  auto surface = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_polygons(mesh));
  Vec uv(2 * surface->vertex_count());
  for (Index v = 0; v < surface->vertex_count(); ++v)
    uv.segment<2>(2 * v) = points[surface->input_vertex(v)];
  return BezierMap::linear(surface, uv);
}

// Returns the map of a simple polygon, counterclockwise.
inline BezierMap polygon_chart(const Corners& corners) {
  std::vector<Index> all;
  for (std::size_t k = 0; k < corners.size(); ++k) all.push_back(static_cast<Index>(k));
  return chart_of(corners, {all});
}

inline Corners regular(int sides, double radius, const Vector2& middle = Vector2::Zero(),
                       double turn = 0) {
  Corners corners;
  for (int k = 0; k < sides; ++k) {
    const double angle = turn + 2 * std::numbers::pi * k / sides;
    corners.push_back(middle + radius * Vector2(std::cos(angle), std::sin(angle)));
  }
  return corners;
}

inline Corners turned(Corners corners, double angle, const Vector2& by = Vector2::Zero()) {
  Eigen::Matrix2d R;
  R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  for (Vector2& p : corners) p = R * p + by;
  return corners;
}

inline Corners rectangle(double width, double height) {
  return {{0, 0}, {width, 0}, {width, height}, {0, height}};
}

inline Corners ell(double size, double thickness) {
  return {{0, 0},   {size, 0}, {size, thickness}, {thickness, thickness}, {thickness, size},
          {0, size}};
}

// Returns teeth of width 1 on a bar of height 1, at distance 1.
inline Corners comb(int teeth, double length) {
  Corners corners{{0, 0}, {2.0 * teeth - 1, 0}};
  for (int k = teeth - 1; k >= 0; --k) {
    corners.insert(corners.end(), {{2.0 * k + 1, 1 + length}, {2.0 * k, 1 + length}});
    if (k > 0) corners.insert(corners.end(), {{2.0 * k, 1}, {2.0 * k - 1, 1}});
  }
  return corners;
}

inline BezierMap ring_chart(int sides, double inner, double outer) {
  Corners points = regular(sides, outer);
  for (const Vector2& p : regular(sides, inner)) points.push_back(p);
  std::vector<std::vector<Index>> quads;
  for (Index k = 0; k < sides; ++k)
    quads.push_back({k, (k + 1) % sides, sides + (k + 1) % sides, sides + k});
  return chart_of(points, quads);
}

// Returns a star-shaped polygon with bays, approximately of that size.
inline Corners random_polygon(Random& random, double size) {
  const int sides = random.integer(3, 12);
  Corners corners = regular(sides, size, Vector2::Zero(), random.uniform(0, 6));
  for (Vector2& p : corners) p *= random.uniform(0.4, 1);
  return sides == 3 ? regular(3, size) : corners;
}

// Returns a disk of degree 3 with wavy edges, by a smooth map of the plane.
inline BezierMap wavy_chart(int sides, double radius, double amount, double phase) {
  Corners points = regular(sides, radius);
  points.push_back(Vector2::Zero());
  std::vector<std::vector<Index>> fan;
  for (Index k = 0; k < sides; ++k) fan.push_back({k, (k + 1) % sides, sides});
  BezierMap map = chart_of(points, fan).elevated().elevated();
  Vec x = map.control_points();
  for (Index k = 0; k < x.size(); k += 2) {
    const double u = x[k] / radius, v = x[k + 1] / radius;
    x[k] += radius * amount * std::sin(3 * v + phase);
    x[k + 1] += radius * amount * std::sin(2 * u - phase);
  }
  return map.with(map.shared_space(), x);
}

// Returns `count` points on every boundary edge, in the order of edges and loops.
inline std::vector<Corners> sampled_boundary(const BezierMap& map, int count) {
  const SurfaceMesh& mesh = map.mesh();
  std::vector<Index> leaving(to_size(mesh.vertex_count()), -1);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) < 0) leaving[mesh.from_vertex(h)] = h;
  std::vector<Corners> loops;
  for (const std::vector<Index>& vertices : mesh.boundary_loops()) {
    Corners& loop = loops.emplace_back();
    for (const Index v : vertices)
      for (int k = 0; k < count; ++k) {
        const Index h = leaving[v];
        Barycentric xi = Barycentric::Zero();
        xi[h % 3] = 1 - double(k) / count;
        xi[(h + 1) % 3] = double(k) / count;
        loop.push_back(map.evaluate(h / 3, xi));
      }
  }
  return loops;
}

inline bool inside(const std::vector<Corners>& loops, const Vector2& p) {
  bool odd = false;
  for (const Corners& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vector2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
      if ((a.y() > p.y()) != (b.y() > p.y()))
        odd ^= p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    }
  return odd;
}

// Returns true if the segments ab and cd are at least this far apart, decided exactly.
inline bool apart(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d,
                  const Rational& squared) {
  struct P {
    Rational x, y;
  };
  const auto exact = [](const Vector2& p) { return P{Rational(p.x()), Rational(p.y())}; };
  const auto minus = [](const P& p, const P& q) { return P{p.x - q.x, p.y - q.y}; };
  const auto times = [](const P& p, const P& q) -> Rational { return p.x * q.x + p.y * q.y; };
  const auto area = [](const P& p, const P& q) -> Rational { return p.x * q.y - p.y * q.x; };
  const auto far = [&](const P& p, const P& from, const P& to) {
    const P along = minus(to, from), v = minus(p, from), w = minus(p, to);
    const Rational t = times(along, v), length = times(along, along);
    if (t <= 0) return times(v, v) >= squared;
    if (t >= length) return times(w, w) >= squared;
    const Rational z = area(along, v);
    return z * z >= squared * length;
  };
  const P A = exact(a), B = exact(b), C = exact(c), D = exact(d);
  const Rational s = area(minus(B, A), minus(C, A)), t = area(minus(B, A), minus(D, A)),
                 u = area(minus(D, C), minus(A, C)), v = area(minus(D, C), minus(B, C));
  const bool cross = (s < 0) != (t < 0) && (u < 0) != (v < 0);
  return !cross && far(A, C, D) && far(B, C, D) && far(C, A, B) && far(D, A, B);
}

// Expects all guarantees of pack(), judged by the control points: curves by `samples` points per
// edge, lines (samples = 1) exactly.
inline void expect_valid(const std::vector<BezierMap>& before, const Packing& packing,
                         const PackOptions& options, int samples, const std::string& name) {
  SCOPED_TRACE(name);
  ASSERT_EQ(packing.charts.size(), before.size());
  const double needed = options.padding_pixels / options.resolution * packing.side;
  if (before.size() > 1) {
    EXPECT_GE(packing.distance, needed);
  }
  std::vector<std::vector<Corners>> loops;
  std::vector<std::pair<Vector2, Vector2>> boxes;
  const auto is_fixed = [&](std::size_t k) { return !options.fixed.empty() && options.fixed[k]; };
  for (std::size_t k = 0; k < before.size(); ++k) {
    const BezierMap& chart = packing.charts[k];
    const auto nodes = chart.control_points().reshaped(2, chart.space().node_count());
    for (Index n = 0; n < nodes.cols(); ++n) {
      const Vector2 uv =
          (nodes.col(n) - packing.origin) / packing.side - tile_corner(packing.tiles[k]);
      const double border = options.padding_pixels / options.resolution - 1e-12;
      EXPECT_TRUE(uv.minCoeff() >= border && uv.maxCoeff() <= 1 - border) << "chart " << k;
    }
    if (is_fixed(k)) {
      EXPECT_EQ(chart.control_points(), before[k].control_points());
    }
    // One common scale.
    const auto old = before[k].control_points().reshaped(2, nodes.cols());
    const double size = (old.rowwise().maxCoeff() - old.rowwise().minCoeff()).norm();
    for (Index n = 1; n < nodes.cols(); ++n)
      EXPECT_NEAR((nodes.col(n) - nodes.col(0)).norm(), (old.col(n) - old.col(0)).norm(),
                  1e-14 * (size + packing.side + packing.origin.norm()));
    loops.push_back(sampled_boundary(chart, samples));
    boxes.emplace_back(nodes.rowwise().minCoeff(), nodes.rowwise().maxCoeff());
  }
  const Rational squared = Rational(needed) * Rational(needed);
  for (std::size_t i = 0; i < loops.size(); ++i)
    for (std::size_t j = 0; j < loops.size(); ++j) {
      if (i == j || (is_fixed(i) && is_fixed(j))) continue;
      const Vector2 space =
          (boxes[i].first - boxes[j].second).cwiseMax(boxes[j].first - boxes[i].second);
      if (space.maxCoeff() > needed) continue;
      EXPECT_FALSE(inside(loops[i], loops[j][0][0])) << "chart " << j << " in chart " << i;
      if (i > j) continue;
      for (const Corners& p : loops[i])
        for (const Corners& q : loops[j])
          for (std::size_t k = 0; k < p.size(); ++k)
            for (std::size_t l = 0; l < q.size(); ++l) {
              const Vector2 &a = p[k], &b = p[(k + 1) % p.size()], &c = q[l],
                            &d = q[(l + 1) % q.size()];
              if (samples > 1) {
                ASSERT_GE((a - c).norm(), needed) << "charts " << i << ", " << j;
                continue;
              }
              const double rough = (a - c).norm() - (b - a).norm() - (d - c).norm();
              if (rough > 2 * needed) continue;
              ASSERT_TRUE(apart(a, b, c, d, squared)) << "charts " << i << ", " << j;
            }
    }
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
