#include "majorant/maps/quadrature_hierarchy.h"

#include <algorithm>
#include <array>

namespace majorant {
namespace {

// The number of times that refined rules halve corners. Chosen, not tuned.
constexpr int kGrading = 2;
// Upper bound on guard points along an edge, so that there are at most 153. Chosen, not tuned.
constexpr int kMaxEdgeGuards = 16;
// The pieces along an edge of the measuring rules. Each rule has four times the points of the one
// before, so that two of them show their accuracy; the fourth has 1,792 points.
constexpr std::array<int, 4> kMeasuringPieces{2, 4, 8, 16};
// The pieces of the last measuring rule, and the number of times that its corners are halved.
constexpr int kFinestPieces = 32, kFinestGrading = 4;

}  // namespace

QuadratureHierarchy optimizer_quadrature(int n, int lattice_points, const QuadratureRules& rules) {
  QuadratureHierarchy hierarchy;
  if (n == 1) {
    hierarchy.guarded = hierarchy.plain = {lattice_rule(1)};
    return hierarchy;
  }
  const int m = first_pieces(n);
  Quadrature first = composite_rule(radon_rule(), m);
  if (lattice_points > 0) {
    int k = 1;
    while (k * (k + 1) / 2 < lattice_points) ++k;
    first = lattice_rule(k);
  }
  hierarchy.plain = {first};
  hierarchy.guarded = {guarded_rule(first, 1, rules.corner_guard)};
  for (int level = 1, pieces = 2; level <= rules.refinements; ++level, pieces *= 2) {
    hierarchy.plain.push_back(corner_graded_rule(radon_rule(), pieces * m, kGrading));
    hierarchy.guarded.push_back(guarded_rule(
        hierarchy.plain.back(), std::min(pieces * n, kMaxEdgeGuards), rules.boundary_guard));
  }
  return hierarchy;
}

std::vector<Quadrature> measuring_rules(int n) {
  if (n == 1) return {lattice_rule(1)};
  std::vector<Quadrature> rules;
  for (const int m : kMeasuringPieces) rules.push_back(composite_rule(radon_rule(), m));
  rules.push_back(corner_graded_rule(radon_rule(), kFinestPieces, kFinestGrading));
  return rules;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
