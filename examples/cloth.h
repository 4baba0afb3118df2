// The cloth of cloth.cpp and bench/cloth_ceres.cpp: a unit square of n by n squares of two
// triangles, two of its sides pushed together by a tenth, bulging a little.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "meshes.h"

struct Cloth {
  majorant::RowMatrix flat;           // #P by 3, at rest
  majorant::RowMatrix start;          // #P by 3
  std::vector<majorant::Index> held;  // points of the two sides, at their places of the start
  majorant::Cells edges;              // #E by 2
  majorant::Cells hinges;  // of each inner edge its ends, then the corners opposite to it
};

inline Cloth cloth(int n) {
  ExampleMesh m{majorant::RowMatrix((n + 1) * (n + 1), 3), {2 * n * n, 3}};
  Cloth c;
  for (int j = 0; j <= n; ++j)
    for (int i = 0, k; i <= n; ++i) {
      m.points.row(k = j * (n + 1) + i) << double(i) / n, double(j) / n, 0;
      if (i == 0 || i == n) c.held.push_back(k);
      if (i == n || j == n) continue;
      m.cells.row(2 * (j * n + i)) << k, k + 1, k + n + 2;
      m.cells.row(2 * (j * n + i) + 1) << k, k + n + 2, k + n + 1;
    }
  c.flat = c.start = m.points;
  c.start.col(0) = 0.05 + 0.9 * m.points.col(0).array();
  c.start.col(2) = 0.1 * (std::numbers::pi * m.points.col(0).array()).sin();
  c.edges = edges_of(m.cells);
  std::map<std::pair<int, int>, int> opposite;  // of directed edges
  for (const auto& t : m.cells.rowwise())
    for (int k = 0; k < 3; ++k) opposite[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  c.hinges.resize(c.edges.rows(), 4);
  majorant::Index count = 0;
  for (const auto& [edge, left] : opposite)
    if (edge.first < edge.second)
      if (const auto right = opposite.find({edge.second, edge.first}); right != opposite.end())
        c.hinges.row(count++) << edge.first, edge.second, left, right->second;
  c.hinges.conservativeResize(count, 4);
  return c;
}

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
