// Meshes of Bezier triangles for tests of edge flips: triangulations of random points with random
// diagonals, straight or curved, and their invariants under flips.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "majorant/elements/bernstein.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/maps/bezier_map.h"
#include "mesh/test_meshes.h"

namespace majorant {

inline double triangle_determinant(const Points2& p, Index a, Index b, Index c) {
  return cross(p.row(b) - p.row(a), p.row(c) - p.row(a));
}

inline Cells cells_of(const std::vector<std::array<Index, 3>>& faces) {
  Cells out(static_cast<Index>(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
    out.row(static_cast<Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
  return out;
}

struct PlaneTriangulation {
  Points2 points;
  Cells faces;
};

// Returns the unit square with `count` inserted points, each of which divides its triangle into
// three: long thin triangles, far from Delaunay.
inline PlaneTriangulation inserted_points(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Points2 points(4 + count, 2);
  points.topRows(4) << 0, 0, 1, 0, 1, 1, 0, 1;
  std::vector<std::array<Index, 3>> faces{{0, 1, 2}, {0, 2, 3}};
  for (Index v = 4; v < points.rows(); ++v) {
    points.row(v) << uniform(random), uniform(random);
    const auto holder = std::find_if(faces.begin(), faces.end(), [&](const auto& f) {
      for (std::size_t k = 0; k < 3; ++k)
        if (triangle_determinant(points, f[k], f[(k + 1) % 3], v) < 1e-7) return false;
      return true;
    });
    if (holder == faces.end()) {
      --v;  // too close to an edge: retry
      continue;
    }
    const auto [a, b, c] = *holder;
    *holder = {a, b, v};
    faces.push_back({b, c, v});
    faces.push_back({c, a, v});
  }
  return {points, cells_of(faces)};
}

// Returns a grid of n by n quadrilaterals in the unit square. Inner points are moved at random by
// up to a part of the spacing; diagonals are random.
inline PlaneTriangulation jittered_grid(int n, double part, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-part, part);
  Points2 points((n + 1) * (n + 1), 2);
  const auto vertex = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const bool inner = i > 0 && j > 0 && i < n && j < n;
      const double dx = uniform(random), dy = uniform(random);
      points.row(vertex(i, j)) << (i + (inner ? dx : 0)) / n, (j + (inner ? dy : 0)) / n;
    }
  std::vector<std::array<Index, 3>> faces;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      std::array<Index, 4> q{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1),
                             vertex(i, j + 1)};
      const auto fits = [&](std::size_t s) {  // admissible diagonal at corner s
        return triangle_determinant(points, q[s], q[s + 1], q[s + 2]) > 0 &&
               triangle_determinant(points, q[s], q[s + 2], q[(s + 3) % 4]) > 0;
      };
      std::rotate(q.begin(), q.begin() + (random() % 2), q.end());
      if (!fits(0)) std::rotate(q.begin(), q.begin() + 1, q.end());
      faces.push_back({q[0], q[1], q[2]});
      faces.push_back({q[0], q[2], q[3]});
    }
  return {points, cells_of(faces)};
}

inline bool is_certified(const BezierTriangleSpace& space, VecIn x) {
  for (Index f = 0; f < space.element_count(); ++f)
    if (space.certify(f, x, 5).result != ProofStatus::Proven) return false;
  return true;
}

// Returns triangles of that degree. Control points other than corners are moved by up to `part` of
// 1/n of the shortest edge around them; moves are halved where a triangle folds.
inline BezierMesh curved(const PlaneTriangulation& t, int degree, double part, unsigned seed) {
  const BezierTriangleSpace space(t.faces, static_cast<Index>(t.points.rows()), degree);
  const RowMatrix straight = space.node_positions(t.points);
  Vec size = Vec::Constant(space.node_count(), 1e300);
  for (Index f = 0; f < t.faces.rows(); ++f)
    for (Index l = 0; l < space.cells().cols(); ++l)
      for (int k = 0; k < 3; ++k)
        size[space.cells()(f, l)] =
            std::min(size[space.cells()(f, l)],
                     (t.points.row(t.faces(f, k)) - t.points.row(t.faces(f, (k + 1) % 3))).norm());
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-part, part);
  Vec x(2 * space.node_count()), shift = Vec::Zero(x.size());
  for (Index v = 0; v < space.node_count(); ++v) {
    x.segment<2>(2 * v) = straight.row(v);
    const Vector2 by(uniform(random), uniform(random));
    if (v >= space.vertex_count()) shift.segment<2>(2 * v) = by * size[v] / degree;
  }
  bool folded = true;
  for (int round = 0; folded && round < 60; ++round) {
    folded = false;
    const Vec moved = x + shift;
    for (Index f = 0; f < space.element_count(); ++f) {
      if (space.certify(f, moved, 5).result == ProofStatus::Proven) continue;
      folded = true;
      for (Index l = 0; l < space.cells().cols(); ++l)
        shift.segment<2>(2 * space.cells()(f, l)) *= 0.5;
    }
  }
  x += shift;
  EXPECT_TRUE(is_certified(space, x));
  return bezier_mesh(degree, t.faces, space.cells(), x);
}

inline bool same_bits(const BezierMesh& a, const BezierMesh& b) {
  return a.degree == b.degree && a.faces == b.faces && a.opposite == b.opposite &&
         a.points == b.points;
}

// The mesh as a space with control points; faces have equal bits at shared points.
struct SharedPoints {
  BezierTriangleSpace space;
  Vec x;
  bool continuous = true;
  explicit SharedPoints(const BezierMesh& mesh)
      : space(mesh.faces, mesh.faces.maxCoeff() + 1, mesh.degree),
        x(Vec::Constant(2 * space.node_count(), std::nan(""))) {
    for (Index f = 0; f < mesh.face_count(); ++f)
      for (int l = 0; l < space.nodes_per_element(); ++l) {
        auto node = x.segment<2>(2 * space.cells()(f, l));
        if (!std::isnan(node[0]) && node != mesh.point(f, l)) continuous = false;
        node = mesh.point(f, l);
      }
  }
};

// Expects consistent opposite half-edges, continuity and positive determinants.
inline void expect_sound(const BezierMesh& mesh) {
  ASSERT_EQ(mesh.opposite, opposite_half_edges(mesh.faces));
  const SharedPoints shared(mesh);
  EXPECT_TRUE(shared.continuous);
  EXPECT_TRUE(is_certified(shared.space, shared.x));
}

// Returns the area inside the boundary, from the boundary's control points alone.
inline double enclosed_area(const BezierMesh& mesh) {
  const int n = mesh.degree;
  const TriangleIndices& indices = TriangleIndices::of_degree(n);
  const auto binomial = [](int m, int k) {
    return std::tgamma(m + 1) / (std::tgamma(k + 1) * std::tgamma(m - k + 1));
  };
  double twice = 0;
  for (Index h = 0; h < 3 * mesh.face_count(); ++h) {
    if (mesh.opposite[h] >= 0) continue;
    const std::vector<int>& edge = indices.edge(h % 3);
    for (int r = 0; r <= n; ++r)
      for (int s = 0; s < n; ++s) {  // integral of c x c', exact
        const Vector2 c = mesh.point(h / 3, edge[r]);
        const Vector2 d = mesh.point(h / 3, edge[s + 1]) - mesh.point(h / 3, edge[s]);
        twice += cross(c, d) * n * binomial(n, r) * binomial(n - 1, s) /
                 (binomial(2 * n - 1, r + s) * 2 * n);
      }
  }
  return twice / 2;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
