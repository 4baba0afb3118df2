#include "majorant/framework/comparison/comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace majorant {

double Comparison::best_energy() const {
  double best = std::numeric_limits<double>::infinity();
  for (const MethodRun& run : runs) {
    for (const ComparisonPoint& point : run.points) {
      if (std::isfinite(point.energy)) best = std::min(best, point.energy);
    }
  }
  return best;
}

const ComparisonPoint* first_within(const MethodRun& run, double best, double fraction) {
  if (!std::isfinite(best)) return nullptr;
  const double limit = best + fraction * std::abs(best);
  for (const ComparisonPoint& point : run.points) {
    if (std::isfinite(point.energy) && point.energy <= limit) return &point;
  }
  return nullptr;
}

double excess_energy(double energy, double best) {
  if (!std::isfinite(energy) || !std::isfinite(best)) return std::nan("");
  return best == 0.0 ? energy : (energy - best) / std::abs(best);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
