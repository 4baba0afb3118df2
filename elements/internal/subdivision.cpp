#include "majorant/elements/internal/subdivision.h"

#include <algorithm>

#include "majorant/framework/error.h"

namespace majorant {

Subdivision::Subdivision(const BernsteinBasis& basis, const std::vector<EdgeBisection>& steps)
    : count_(basis.count()) {
  for (int k = 0; k < count_; ++k)
    if (basis.is_corner(k)) corners_.push_back(k);
  for (const EdgeBisection& s : steps) plans_.push_back(plan(basis, s));
}

Subdivision::Plan Subdivision::plan(const BernsteinBasis& basis, const EdgeBisection& step) {
  const auto a = to_size(step.a), b = to_size(step.b);
  // Coefficient of a child whose midpoint has exponent l and whose remaining end of the edge has
  // exponent `rest`.
  const auto child = [&](const std::vector<int>& slots, int end, Exponents parent, int l,
                         int rest) {
    parent[end] = rest;
    Exponents e{};
    for (std::size_t s = 0; s < slots.size(); ++s)
      e[s] = slots[s] == EdgeBisection::kMidpoint ? l : parent[slots[s]];
    return basis.find(e);
  };
  Plan out;
  for (int k = 0; k < basis.count(); ++k) {
    Exponents e = basis.exponents(k);
    if (e[b] != 0) continue;  // one line for each function at end a
    const int n = e[a];
    if (n > kMaxDegree) throw InvalidArgument("Subdivision: degree above 31");
    out.levels = std::max(out.levels, n);
    out.lines.push_back(n);
    for (int l = 0; l <= n; ++l) {
      e[a] = n - l;
      e[b] = l;
      out.lines.push_back(basis.find(e));
    }
    for (int l = 0; l <= n; ++l) out.lines.push_back(child(step.first, step.a, e, l, n - l));
    for (int l = 0; l <= n; ++l) out.lines.push_back(child(step.second, step.b, e, l, n - l));
  }
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
