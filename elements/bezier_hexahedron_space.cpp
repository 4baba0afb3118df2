#include <algorithm>

#include "majorant/elements/bernstein_space.h"

namespace majorant {
namespace {

// Returns the nodes of VTK_BEZIER_HEXAHEDRON of VTK 9.1 as exponents of 1-r, r, 1-s, s, 1-t, t. The
// order is: corners; the edges in r and s at t = 0, then at t = 1; the edges in t; the faces r = 0,
// r = 1, s = 0, s = 1, t = 0, t = 1; the interior. Every edge runs in the direction of its
// coordinate, faces and interior row by row.
std::vector<Exponents> hexahedron_lattice(const Degrees& degrees) {
  constexpr std::array<std::array<int, 2>, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const int p = degrees[0], q = degrees[1], o = degrees[2];
  std::vector<Exponents> out;
  const auto push = [&](int i, int j, int k) {
    const Exponents e{p - i, i, q - j, j, o - k, k};
    if (std::find(out.begin(), out.end(), e) == out.end()) out.push_back(e);  // degrees may be 0
  };
  for (const int k : {0, o})
    for (const auto& [i, j] : kCorners) push(i * p, j * q, k);
  for (const int k : {0, o}) {
    for (int i = 1; i < p; ++i) push(i, 0, k);
    for (int j = 1; j < q; ++j) push(p, j, k);
    for (int i = 1; i < p; ++i) push(i, q, k);
    for (int j = 1; j < q; ++j) push(0, j, k);
  }
  for (const auto& [i, j] : kCorners)
    for (int k = 1; k < o; ++k) push(i * p, j * q, k);
  for (const int i : {0, p})
    for (int k = 1; k < o; ++k)
      for (int j = 1; j < q; ++j) push(i, j, k);
  for (const int j : {0, q})
    for (int k = 1; k < o; ++k)
      for (int i = 1; i < p; ++i) push(i, j, k);
  for (const int k : {0, o})
    for (int j = 1; j < q; ++j)
      for (int i = 1; i < p; ++i) push(i, j, k);
  for (int k = 1; k < o; ++k)
    for (int j = 1; j < q; ++j)
      for (int i = 1; i < p; ++i) push(i, j, k);
  return out;
}

// Describes a hexahedron, which is bisected in r, s and t in turn.
BernsteinElement hexahedron(int degree) {
  constexpr int m = EdgeBisection::kMidpoint;
  return {.name = "BezierHexahedronSpace",
          .degree = degree,
          .max_degree = BezierHexahedronSpace::kMaxDegree,
          .factors = {2, 2, 2},
          .lattice = hexahedron_lattice,
          .derivatives = {{1, 0}, {3, 2}, {5, 4}},
          .bisections = {{0, 1, {0, m, 2, 3, 4, 5}, {m, 1, 2, 3, 4, 5}},
                         {2, 3, {0, 1, 2, m, 4, 5}, {0, 1, m, 3, 4, 5}},
                         {4, 5, {0, 1, 2, 3, 4, m}, {0, 1, 2, 3, m, 5}}}};
}

}  // namespace

BezierHexahedronSpace::BezierHexahedronSpace(const Cells& cells, Index vertex_count, int degree)
    : BernsteinSpace(hexahedron(degree), cells, vertex_count) {}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
