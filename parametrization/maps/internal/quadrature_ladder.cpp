#include "majorant/parametrization/maps/internal/quadrature_ladder.h"

#include <algorithm>

namespace majorant {

QuadratureLadder optimizer_ladder(int n, int lattice_points, const QuadratureRules& rules) {
  QuadratureLadder ladder;
  if (n == 1) {
    ladder.guarded = ladder.plain = {lattice_rule(1)};
    return ladder;
  }
  const int m = std::min(n, 4);
  Quadrature first = composite_rule(radon_rule(), m);
  if (lattice_points > 0) {
    int k = 1;
    while (k * (k + 1) / 2 < lattice_points) ++k;
    first = lattice_rule(k);
  }
  ladder.plain = {first};
  ladder.guarded = {guarded_rule(first, 1, rules.corner_guard)};
  for (int level = 1, pieces = 2; level <= rules.refinements; ++level, pieces *= 2) {
    ladder.plain.push_back(corner_graded_rule(radon_rule(), pieces * m, 2));
    ladder.guarded.push_back(
        guarded_rule(ladder.plain.back(), std::min(pieces * n, 16), rules.boundary_guard));
  }
  return ladder;
}

std::vector<Quadrature> measuring_rules(int n) {
  if (n == 1) return {lattice_rule(1)};
  std::vector<Quadrature> rules;
  for (const int m : {2, 4, 8, 16}) rules.push_back(composite_rule(radon_rule(), m));
  rules.push_back(corner_graded_rule(radon_rule(), 32, 4));
  return rules;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
