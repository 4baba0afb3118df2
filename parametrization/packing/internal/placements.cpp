#include "majorant/parametrization/packing/internal/placements.h"

#include <algorithm>
#include <cmath>

namespace majorant {
namespace {

// The tolerance of sums of sizes, relative to the side: some thousand roundings.
constexpr double kSlack = 1e-12;

// Returns a side at which no packer succeeds: its area is too small, or it is shorter than a chart.
double too_small(const PackingJob& job) {
  double side = std::sqrt(job.area / job.tiles);
  for (std::size_t k = 0; k < job.charts.size(); ++k) {
    const Vector2& size = job.charts[k].size;
    side = std::max(side, job.fixed[k] ? (*job.fixed[k] + size).maxCoeff() : size.maxCoeff());
  }
  return side * (1 - kSlack);
}

}  // namespace

std::optional<Placements> smallest_square(const PackingJob& job, const StripPacker& strip,
                                          const SquareSearch& search) {
  constexpr double kLargest = 1e3;  // at a fill of 1e-6 the gaps fill the square
  std::optional<Placements> best;
  const auto fits = [&](double side) {
    job.stop.poll();
    std::optional<Strip> packed = strip(side);
    if (!packed || packed->height > side) return false;
    if (!best || side < best->side) best = Placements{std::move(packed->poses), side};
    return true;
  };
  const double least = too_small(job);
  double low = least, high = std::max(search.guess, least);
  if (fits(high)) {
    for (low = high / search.factor; low > least && fits(low); low /= search.factor) high = low;
    low = std::max(low, least);
  } else {
    do {
      low = high;
      high *= search.factor;
      if (high > std::min(search.most, kLargest * least)) return {};
    } while (!fits(high));
  }
  for (int k = 0; k < search.tries && low < high; ++k) {
    const double middle = std::sqrt(low * high);
    (fits(middle) ? high : low) = middle;
  }
  return best;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
