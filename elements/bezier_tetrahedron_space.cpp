#include "majorant/elements/bernstein.h"
#include "majorant/elements/bernstein_space.h"

namespace majorant {
namespace {

// Appends the nodes of VTK_BEZIER_TETRAHEDRON: corners, edges, faces (each a triangle of degree
// n-3), then the interior, a tetrahedron of degree n-4. `shift` is added to every exponent.
void append_vtk_order(int n, int shift, std::vector<Exponents>& out) {
  constexpr int kEdges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  constexpr int kFaces[4][3] = {{0, 1, 3}, {2, 3, 1}, {0, 3, 2}, {0, 2, 1}};
  const Exponents base{shift, shift, shift, shift};
  if (n == 0) out.push_back(base);
  if (n < 1) return;
  const auto push = [&](std::array<std::array<int, 2>, 3> terms) {
    Exponents e = base;
    for (const auto& [coordinate, exponent] : terms) e[coordinate] += exponent;
    out.push_back(e);
  };
  for (int c = 0; c < 4; ++c) push({{{c, n}}});
  for (const auto& [a, b] : kEdges)
    for (int s = 1; s < n; ++s) push({{{a, n - s}, {b, s}}});
  if (n >= 3) {
    const TriangleIndices& inner = TriangleIndices::of_degree(n - 3);
    for (const auto& [a, b, c] : kFaces)
      for (int l = 0; l < inner.count(); ++l) {
        const auto [i, j, k] = inner.multi(l);
        push({{{a, i + 1}, {b, j + 1}, {c, k + 1}}});
      }
  }
  append_vtk_order(n - 4, shift + 1, out);
}

std::vector<Exponents> tetrahedron_lattice(const Degrees& degrees) {
  std::vector<Exponents> out;
  append_vtk_order(degrees[0], 0, out);
  return out;
}

// Describes a tetrahedron with Kuhn bisection [Mau95]: edges (v0, v3), (v0, v2), (v0, v1) in turn.
BernsteinElement tetrahedron(int degree) {
  constexpr int m = EdgeBisection::kMidpoint;
  return {.name = "BezierTetrahedronSpace",
          .degree = degree,
          .max_degree = BezierTetrahedronSpace::kMaxDegree,
          .factors = {4},
          .lattice = tetrahedron_lattice,
          .derivatives = {{1, 0}, {2, 0}, {3, 0}},
          .bisections = {{0, 3, {0, 1, 2, m}, {1, 2, 3, m}},
                         {0, 2, {0, 1, m, 3}, {1, 2, m, 3}},
                         {0, 1, {0, m, 2, 3}, {1, m, 2, 3}}}};
}

}  // namespace

BezierTetrahedronSpace::BezierTetrahedronSpace(const Cells& cells, Index vertex_count, int degree)
    : BernsteinSpace(tetrahedron(degree), cells, vertex_count) {}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
