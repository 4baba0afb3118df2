#include "majorant/parametrization/solve/internal/quadrature_levels.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/partition.h"
#include "majorant/maps/map_part.h"

namespace majorant {
namespace {

// Bisections of the largest error in the search for a threshold: the bits of a float, since a few
// faces more or less do not matter.
constexpr int kBisections = 24;

// Returns the faces with the largest errors, such that the errors of the others add up to at most
// `allowed`.
std::vector<Index> worst_faces(const Vec& error, double allowed) {
  std::vector<Index> order(static_cast<std::size_t>(error.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) { return error[a] > error[b]; });
  double left = error.sum();
  std::vector<Index> worst;
  for (const Index f : order) {
    if (left <= allowed) break;
    left -= error[f];
    worst.push_back(f);
  }
  return worst;
}

// Does the same with the faces of all ranks, without sorting them: returns those above the largest
// threshold, found by bisection, that leaves no more than `allowed`.
std::vector<Index> worst_faces(const Vec& error, double allowed, const Ranks& ranks) {
  const auto left_below = [&](double threshold) {
    return ranks.sum((error.array() <= threshold).select(error.array(), 0).sum());
  };
  double high = ranks.max(error.size() > 0 ? error.maxCoeff() : 0), low = 0;
  std::vector<Index> worst;
  if (left_below(high) <= allowed) return worst;
  for (int k = 0; k < kBisections; ++k) {
    const double middle = (low + high) / 2;
    (left_below(middle) <= allowed ? low : high) = middle;
  }
  for (Index f = 0; f < error.size(); ++f)
    if (error[f] > low) worst.push_back(f);
  return worst;
}

}  // namespace

std::vector<Quadrature> QuadratureLevels::rules() const {
  std::vector<Quadrature> rules = hierarchy_.guarded;
  rules.insert(rules.end(), hierarchy_.plain.begin(), hierarchy_.plain.end());
  return rules;
}

void QuadratureLevels::set(std::vector<RuleId> levels) {
  if (levels.empty()) levels.assign(level_.size(), 0);
  if (levels.size() != level_.size() ||
      !std::all_of(levels.begin(), levels.end(),
                   [&](RuleId level) { return level >= 0 && level <= hierarchy_.top(); }))
    throw InvalidArgument("QuadratureLevels::set: the levels are not those of these faces");
  level_ = std::move(levels);
}

bool QuadratureLevels::refine(const std::vector<Index>& faces) {
  bool refined = false;
  for (const Index f : faces) {
    RuleId& level = level_[f];
    if (level >= hierarchy_.top()) continue;
    ++level;
    refined = true;
  }
  return refined;
}

bool QuadratureLevels::refine_inaccurate(const MapSpecification& spec, const DensityTerms& terms,
                                         VecIn x, double allowed, const StopCheck& stop) {
  if (hierarchy_.top() == 0) return false;
  const auto plain = [&](int above) {
    std::vector<RuleId> rules = level_;
    for (RuleId& rule : rules)
      rule = std::min(rule + above, hierarchy_.top()) + hierarchy_.top() + 1;
    return energy_by_face(spec, terms, rules, x, stop);
  };
  const Vec now = plain(0);
  const Vec error = (plain(1) - now).cwiseAbs();
  if (!spec.part) return refine(worst_faces(error, allowed * now.cwiseAbs().sum()));
  const Ranks& ranks = spec.part->ranks();
  const double energy = ranks.sum(now.cwiseAbs().sum());
  return ranks.any(refine(worst_faces(error, allowed * energy, ranks)));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
