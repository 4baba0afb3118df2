// User-defined elements with their own node orders: products of three segments, and of a triangle
// and a segment, with different factors.
#pragma once

#include <algorithm>
#include <vector>

#include "majorant/elements/bernstein_space.h"

namespace majorant::test {

// Returns the functions in the order of the lattice, with the corners first.
inline std::vector<Exponents> corners_first(const Factors& factors,
                                            const std::vector<Exponents>& functions) {
  const BernsteinBasis basis(factors, functions);
  std::vector<Exponents> out = functions;
  std::stable_partition(out.begin(), out.end(),
                        [&](const Exponents& e) { return basis.is_corner(basis.find(e)); });
  return out;
}

// Coordinates 1-r, r, 1-s, s, 1-t, t. Corners by r, then s, then t.
inline std::vector<Exponents> hexahedron_lattice(const Degrees& n) {
  std::vector<Exponents> out;
  for (int k = 0; k <= n[2]; ++k)
    for (int j = 0; j <= n[1]; ++j)
      for (int i = 0; i <= n[0]; ++i) out.push_back({n[0] - i, i, n[1] - j, j, n[2] - k, k});
  return corners_first({2, 2, 2}, out);
}

inline BernsteinElement hexahedron(int degree) {
  constexpr int m = EdgeBisection::kMidpoint;
  return {.name = "hexahedra",
          .degree = degree,
          .max_degree = 4,
          .factors = {2, 2, 2},
          .lattice = hexahedron_lattice,
          .derivatives = {{1, 0}, {3, 2}, {5, 4}},
          .bisections = {{0, 1, {0, m, 2, 3, 4, 5}, {m, 1, 2, 3, 4, 5}},
                         {2, 3, {0, 1, 2, m, 4, 5}, {0, 1, m, 3, 4, 5}},
                         {4, 5, {0, 1, 2, 3, 4, m}, {0, 1, 2, 3, m, 5}}}};
}

// Barycentric a, b, c of the triangle, then 1-t, t. Corners a, b, c at t = 0, then at t = 1.
inline std::vector<Exponents> wedge_lattice(const Degrees& n) {
  std::vector<Exponents> out;
  for (int k = 0; k <= n[1]; ++k)
    for (int i = n[0]; i >= 0; --i)
      for (int j = n[0] - i; j >= 0; --j) out.push_back({i, j, n[0] - i - j, n[1] - k, k});
  return corners_first({3, 2}, out);
}

// Two newest-vertex bisections of the triangle halve it like one bisection of the segment.
inline BernsteinElement wedge(int degree) {
  constexpr int m = EdgeBisection::kMidpoint;
  return {.name = "wedges",
          .degree = degree,
          .max_degree = 4,
          .factors = {3, 2},
          .lattice = wedge_lattice,
          .derivatives = {{0, 2}, {1, 2}, {4, 3}},
          .bisections = {{1, 2, {m, 0, 1, 3, 4}, {m, 2, 0, 3, 4}},
                         {1, 2, {m, 0, 1, 3, 4}, {m, 2, 0, 3, 4}},
                         {3, 4, {0, 1, 2, 3, m}, {0, 1, 2, m, 4}}}};
}

// Returns the same cell with the segment first, so that other directions have more coefficients.
inline std::vector<Exponents> upright_wedge_lattice(const Degrees& n) {
  std::vector<Exponents> out;
  for (const Exponents& e : wedge_lattice({n[1], n[0]}))
    out.push_back({e[3], e[4], e[0], e[1], e[2]});
  return out;
}

inline BernsteinElement upright_wedge(int degree) {
  constexpr int m = EdgeBisection::kMidpoint;
  return {.name = "upright wedges",
          .degree = degree,
          .max_degree = 4,
          .factors = {2, 3},
          .lattice = upright_wedge_lattice,
          .derivatives = {{1, 0}, {2, 4}, {3, 4}},
          .bisections = {{3, 4, {0, 1, m, 2, 3}, {0, 1, m, 4, 2}},
                         {3, 4, {0, 1, m, 2, 3}, {0, 1, m, 4, 2}},
                         {0, 1, {0, m, 2, 3, 4}, {m, 1, 2, 3, 4}}}};
}

template <BernsteinElement (*describe)(int)>
class ProductSpace final : public BernsteinSpace {
 public:
  ProductSpace(const Cells& cells, Index vertex_count, int degree)
      : BernsteinSpace(describe(degree), cells, vertex_count) {}
};
using UprightWedgeSpace = ProductSpace<upright_wedge>;

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
