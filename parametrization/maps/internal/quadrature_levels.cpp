#include "majorant/parametrization/maps/internal/quadrature_levels.h"

#include <algorithm>
#include <numeric>

namespace majorant {

std::vector<Quadrature> QuadratureLevels::rules() const {
  std::vector<Quadrature> rules = ladder_.guarded;
  rules.insert(rules.end(), ladder_.plain.begin(), ladder_.plain.end());
  return rules;
}

bool QuadratureLevels::refine(const std::vector<Index>& faces) {
  bool refined = false;
  for (const Index f : faces) {
    RuleId& level = level_[at(f)];
    if (level >= ladder_.top()) continue;
    ++level;
    refined = true;
  }
  return refined;
}

bool QuadratureLevels::refine_inaccurate(const MapSpecification& spec, const DensityTerms& terms,
                                         VecIn x, double allowed, const StopCheck& stop) {
  if (ladder_.top() == 0) return false;
  const auto plain = [&](int above) {
    std::vector<RuleId> rules = level_;
    for (RuleId& rule : rules) rule = std::min(rule + above, ladder_.top()) + ladder_.top() + 1;
    return energy_by_face(spec, terms, rules, x, stop);
  };
  const Vec now = plain(0);
  const Vec error = (plain(1) - now).cwiseAbs();
  std::vector<Index> order(static_cast<std::size_t>(error.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return error[a] > error[b]; });
  double left = error.sum();
  std::vector<Index> worst;
  for (const Index f : order) {
    if (left <= allowed * now.cwiseAbs().sum()) break;
    left -= error[f];
    worst.push_back(f);
  }
  return refine(worst);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
