#include <algorithm>

#include "majorant/elements/bernstein_space.h"

namespace majorant {
namespace {

// Returns the nodes of VTK_BEZIER_WEDGE as exponents of the triangle's barycentric coordinates,
// then of 1-t, t. Corners 0, 1, 2 at t = 0 come first, then those at t = 1. The edges 01, 12,
// 20 follow at t = 0, then at t = 1, then the edges in t. Next are the insides of the triangles
// t = 0 and t = 1, and of the squares on the edges 01, 12 and 20, row by row. The interior is last.
std::vector<Exponents> wedge_lattice(const Degrees& degrees) {
  const int n = degrees[0], o = degrees[1];
  std::vector<Exponents> out;
  const auto push = [&](int a, int b, int c, int k) {
    const Exponents e{a, b, c, o - k, k};
    if (std::find(out.begin(), out.end(), e) == out.end()) out.push_back(e);  // degrees may be 0
  };
  const auto along = [&](int edge, int s, int k) {
    std::array<int, 3> e{};
    e[to_size(edge)] = n - s;
    e[to_size((edge + 1) % 3)] = s;
    push(e[0], e[1], e[2], k);
  };
  const auto inside = [&](int k) {
    for (int c = 1; c < n; ++c)
      for (int b = 1; b + c < n; ++b) push(n - b - c, b, c, k);
  };
  for (const int k : {0, o})
    for (int corner = 0; corner < 3; ++corner) along(corner, 0, k);
  for (const int k : {0, o})
    for (int edge = 0; edge < 3; ++edge)
      for (int s = 1; s < n; ++s) along(edge, s, k);
  for (int corner = 0; corner < 3; ++corner)
    for (int k = 1; k < o; ++k) along(corner, 0, k);
  for (const int k : {0, o}) inside(k);
  for (int edge = 0; edge < 3; ++edge)
    for (int k = 1; k < o; ++k)
      for (int s = 1; s < n; ++s) along(edge, s, k);
  for (int k = 1; k < o; ++k) inside(k);
  return out;
}

// Describes a wedge. Two cuts of the triangle, by its newest vertex, halve it as one cut does the
// segment.
BernsteinElement wedge(int degree) {
  constexpr int m = EdgeBisection::kMidpoint;
  return {.name = "BezierWedgeSpace",
          .degree = degree,
          .max_degree = BezierWedgeSpace::kMaxDegree,
          .factors = {3, 2},
          .lattice = wedge_lattice,
          .derivatives = {{1, 0}, {2, 0}, {4, 3}},
          .bisections = {{1, 2, {m, 0, 1, 3, 4}, {m, 2, 0, 3, 4}},
                         {1, 2, {m, 0, 1, 3, 4}, {m, 2, 0, 3, 4}},
                         {3, 4, {0, 1, 2, 3, m}, {0, 1, 2, m, 4}}}};
}

}  // namespace

BezierWedgeSpace::BezierWedgeSpace(const Cells& cells, Index vertex_count, int degree)
    : BernsteinSpace(wedge(degree), cells, vertex_count) {}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
