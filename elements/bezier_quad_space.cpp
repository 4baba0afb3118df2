#include <algorithm>

#include "majorant/elements/bernstein_space.h"

namespace majorant {
namespace {

// Returns the nodes of VTK_BEZIER_QUADRILATERAL as exponents of 1-s, s, 1-t, t: corners
// counterclockwise, edges in the direction of s or t, then the interior row by row.
std::vector<Exponents> quad_lattice(const Degrees& degrees) {
  const int p = degrees[0], q = degrees[1];
  std::vector<Exponents> out;
  const auto push = [&](int i, int j) {
    const Exponents e{p - i, i, q - j, j};
    if (std::find(out.begin(), out.end(), e) == out.end()) out.push_back(e);  // p or q may be 0
  };
  for (const auto& [i, j] : {std::array{0, 0}, {p, 0}, {p, q}, {0, q}}) push(i, j);
  for (int i = 1; i < p; ++i) push(i, 0);
  for (int j = 1; j < q; ++j) push(p, j);
  for (int i = 1; i < p; ++i) push(i, q);
  for (int j = 1; j < q; ++j) push(0, j);
  for (int j = 1; j < q; ++j)
    for (int i = 1; i < p; ++i) push(i, j);
  return out;
}

// Describes a quadrilateral, which is bisected in s and t in turn.
BernsteinElement quad(int degree) {
  constexpr int m = EdgeBisection::kMidpoint;
  return {.name = "BezierQuadSpace",
          .degree = degree,
          .max_degree = BezierQuadSpace::kMaxDegree,
          .factors = {2, 2},
          .lattice = quad_lattice,
          .derivatives = {{1, 0}, {3, 2}},
          .bisections = {{0, 1, {0, m, 2, 3}, {m, 1, 2, 3}}, {2, 3, {0, 1, 2, m}, {0, 1, m, 3}}}};
}

}  // namespace

BezierQuadSpace::BezierQuadSpace(const Cells& cells, Index vertex_count, int degree)
    : BernsteinSpace(quad(degree), cells, vertex_count) {}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
