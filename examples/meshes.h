// Points and cells of the examples that make their own: chains, a square, a bar; what is held.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "majorant/constraints/constraints.h"
#include "majorant/framework/types.h"

struct ExampleMesh {
  majorant::RowMatrix points;  // #P by 2 or 3
  majorant::Cells cells;       // #C by corners
};

// All runs of `nodes` points of a polyline, one after the other.
inline majorant::Cells runs_of(majorant::Index nodes, majorant::Index points) {
  majorant::Cells cells(points - nodes + 1, nodes);
  for (majorant::Index e = 0; e < cells.rows(); ++e)
    for (majorant::Index i = 0; i < nodes; ++i) cells(e, i) = e + i;
  return cells;
}

// A polyline in the plane that rises to 0.3 and comes back; its first and last edge lie flat, their
// middles at (0, 0) and (apart, 0).
inline majorant::RowMatrix clamped_polyline(majorant::Index points, double apart) {
  const double edge = 1.0 / (points - 2);
  majorant::RowMatrix line(points, 2);
  for (majorant::Index i = 0; i < points; ++i) {
    const double t = (i - 0.5) * edge;
    line.row(i) << apart * t, 0.15 * (1 - std::cos(2 * std::numbers::pi * t));
  }
  line.topRows(2) << -edge / 2, 0, edge / 2, 0;
  line.bottomRows(2) << apart - edge / 2, 0, apart + edge / 2, 0;
  return line;
}

// [-1, 1]^2 in the plane z = 0: n by n squares of four triangles around a point each.
inline ExampleMesh square(int n) {
  ExampleMesh m{majorant::RowMatrix::Zero((n + 1) * (n + 1) + n * n, 3), {4 * n * n, 3}};
  const auto corner = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0, middle = (n + 1) * (n + 1), t = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      m.points.row(corner(i, j)) << 2.0 * i / n - 1, 2.0 * j / n - 1, 0;
      if (i == n || j == n) continue;
      m.points.row(middle) << (2.0 * i + 1) / n - 1, (2.0 * j + 1) / n - 1, 0;
      const int loop[] = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
      for (int k = 0; k < 4; ++k) m.cells.row(t++) << loop[k], loop[(k + 1) % 4], middle;
      ++middle;
    }
  return m;
}

// Each edge of the triangles once.
inline majorant::Cells edges_of(const majorant::Cells& triangles) {
  std::vector<std::pair<int, int>> edges;
  for (const auto& t : triangles.rowwise())
    for (int k = 0; k < 3; ++k) edges.push_back(std::minmax({t[k], t[(k + 1) % 3]}));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  majorant::Cells cells(static_cast<majorant::Index>(edges.size()), 2);
  for (majorant::Index e = 0; e < cells.rows(); ++e)
    cells.row(e) << edges[static_cast<std::size_t>(e)].first,
        edges[static_cast<std::size_t>(e)].second;
  return cells;
}

// Each vertex of the boundary with each edge of the boundary that it is not on: (vertex, a, b).
inline majorant::Cells boundary_pairs(const majorant::Cells& triangles) {
  std::set<std::pair<int, int>> sides;
  for (const auto& t : triangles.rowwise())
    for (int k = 0; k < 3; ++k)
      if (!sides.erase({t[(k + 1) % 3], t[k]})) sides.insert({t[k], t[(k + 1) % 3]});
  std::vector<int> list;
  for (const auto& [vertex, next] : sides)
    for (const auto& [a, b] : sides)
      if (vertex != a && vertex != b) list.insert(list.end(), {vertex, a, b});
  return Eigen::Map<const majorant::Cells>(list.data(), std::ssize(list) / 3, 3);
}

// [0, length] by [0, width]^2: unit cubes of six tetrahedra each, around a diagonal.
inline ExampleMesh bar(int length, int width) {
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {1, 0, 2}, {2, 1, 0}, {0, 2, 1}};
  ExampleMesh m{{(length + 1) * (width + 1) * (width + 1), 3}, {6 * length * width * width, 4}};
  const auto vertex = [width](const int(&at)[3]) {
    return (at[0] * (width + 1) + at[1]) * (width + 1) + at[2];
  };
  for (int i = 0, t = 0; i <= length; ++i)
    for (int j = 0; j <= width; ++j)
      for (int k = 0; k <= width; ++k) {
        m.points.row(vertex({i, j, k})) << i, j, k;
        if (i == length || j == width || k == width) continue;
        for (const auto& order : kOrders) {
          int at[3] = {i, j, k};
          m.cells(t, 0) = vertex(at);
          for (int c = 1; c < 4; ++c) {
            ++at[order[c - 1]];
            m.cells(t, c) = vertex(at);
          }
          if (&order >= kOrders + 3) std::swap(m.cells(t, 1), m.cells(t, 2));  // odd: turns back
          ++t;
        }
      }
  return m;
}

// The edges of a triangle or a tetrahedron, as columns; the third one of a triangle is 0.
inline Eigen::Matrix3d edges_from_first_corner(const ExampleMesh& m, majorant::Index cell) {
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
  for (majorant::Index k = 1; k < m.cells.cols(); ++k)
    edges.col(k - 1) = m.points.row(m.cells(cell, k)) - m.points.row(m.cells(cell, 0));
  return edges;
}

// The unknowns: coordinates point by point.
inline majorant::Vec unknowns_of(const majorant::RowMatrix& points) {
  return points.reshaped<Eigen::RowMajor>();
}

// All coordinates of these points, where they are.
inline majorant::FixedUnknowns held(const majorant::RowMatrix& points,
                                    const std::vector<majorant::Index>& which) {
  std::vector<majorant::FixedUnknown> unknowns;
  const auto dims = static_cast<majorant::Index>(points.cols());
  for (const majorant::Index p : which)
    for (majorant::Index c = 0; c < dims; ++c) unknowns.push_back({dims * p + c, points(p, c)});
  return majorant::FixedUnknowns(unknowns);
}

// The unit sphere: an octahedron whose faces are cut into four, `levels` times.
inline ExampleMesh octasphere(int levels) {
  using majorant::Index, majorant::Vector3;
  std::vector<Vector3> x{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  std::vector<std::array<Index, 3>> faces;
  for (const Index a : {0, 3})
    for (const Index b : {1, 4})
      for (const Index c : {2, 5})
        faces.push_back((a + b + c) % 2 ? std::array{a, b, c} : std::array{a, c, b});
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<Index, Index>, Index> middles;
    const auto middle = [&](Index a, Index b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), x.size());
      if (is_new) x.push_back((x[a] + x[b]).normalized());
      return at->second;
    };
    std::vector<std::array<Index, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = finer;
  }
  majorant::RowMatrix points(x.size(), 3);
  majorant::Cells cells(faces.size(), 3);
  for (std::size_t i = 0; i < x.size(); ++i) points.row(i) = x[i];
  for (std::size_t f = 0; f < faces.size(); ++f)
    cells.row(f) << faces[f][0], faces[f][1], faces[f][2];
  return {points, cells};
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
