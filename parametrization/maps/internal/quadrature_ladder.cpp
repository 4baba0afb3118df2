#include "majorant/parametrization/maps/internal/quadrature_ladder.h"

#include <algorithm>

namespace majorant {
namespace {

constexpr double kCornerGuard = 1e-3;    // total weight of guard points, level 0
constexpr double kBoundaryGuard = 3e-3;  // and above, where they also cover the edges
constexpr int kClimbs = 4;               // levels above 0, each halves the subtriangles

}  // namespace

QuadratureLadder optimizer_ladder(int n, int lattice_points) {
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
  ladder.guarded = {guarded_rule(first, 1, kCornerGuard)};
  for (int level = 1, pieces = 2; level <= kClimbs; ++level, pieces *= 2) {
    ladder.plain.push_back(corner_graded_rule(radon_rule(), pieces * m, 2));
    ladder.guarded.push_back(
        guarded_rule(ladder.plain.back(), std::min(pieces * n, 16), kBoundaryGuard));
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
