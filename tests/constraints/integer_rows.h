// The rows of [MC20] Eq. 15 in integers and their rank, independent of the library's elimination.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "majorant/constraints/constraints.h"

namespace majorant {

// A row of integers by unknown.
using IntegerRow = std::map<Index, long>;

// Returns [MC20] Eq. 15 without translations: (c_i - c_{i+1}) - R^k (c'_i - c'_{i+1}) = 0, two rows
// for every control point of every seam edge. R is written out, independent of the library.
inline std::vector<IntegerRow> difference_rows(const BezierTriangleSpace& space,
                                               const Seams& seams) {
  constexpr long kCosine[] = {1, 0, -1, 0}, kSine[] = {0, 1, 0, -1};
  std::vector<IntegerRow> rows;
  for (const SeamEdge& edge : seams.edges()) {
    const std::vector<Index> a = edge_nodes(space, edge.side);
    std::vector<Index> b = edge_nodes(space, edge.opposite);
    std::reverse(b.begin(), b.end());
    const long c = kCosine[edge.turns], s = kSine[edge.turns];
    for (std::size_t i = 0; i + 1 < a.size(); ++i) {
      IntegerRow u, v;
      for (const auto& [p, q, sign] :
           {std::tuple(a[i], b[i], 1L), std::tuple(a[i + 1], b[i + 1], -1L)}) {
        u[2 * p] += sign;
        u[2 * q] -= sign * c;
        u[2 * q + 1] += sign * s;
        v[2 * p + 1] += sign;
        v[2 * q] -= sign * s;
        v[2 * q + 1] -= sign * c;
      }
      rows.push_back(u);
      rows.push_back(v);
    }
  }
  return rows;
}

// Returns the rank modulo a prime of 61 bits, which is at most the rank.
inline Index modular_rank(const std::vector<IntegerRow>& rows) {
  constexpr std::int64_t p = (std::int64_t(1) << 61) - 1;
  __extension__ typedef __int128 Wide;
  const auto times = [](std::int64_t a, std::int64_t b) { return std::int64_t(Wide(a) * b % p); };
  const auto inverse = [&](std::int64_t a) {
    std::int64_t result = 1;
    for (std::int64_t e = p - 2; e; e >>= 1, a = times(a, a))
      if (e & 1) result = times(result, a);
    return result;
  };
  std::map<Index, std::map<Index, std::int64_t>> pivots;  // by first unknown, scaled to 1 there
  for (const IntegerRow& given : rows) {
    std::map<Index, std::int64_t> row;
    for (const auto& [i, c] : given)
      if (c != 0) row[i] = (c % p + p) % p;
    while (!row.empty()) {
      const auto [first, c] = *row.begin();
      const auto pivot = pivots.find(first);
      if (pivot == pivots.end()) {
        const std::int64_t factor = inverse(c);
        for (auto& entry : row) entry.second = times(entry.second, factor);
        pivots.emplace(first, row);
        break;
      }
      for (const auto& [i, d] : pivot->second) {
        std::int64_t& entry = row[i];
        entry = (entry + p - times(c, d)) % p;
        if (entry == 0) row.erase(i);
      }
    }
  }
  return static_cast<Index>(pivots.size());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
