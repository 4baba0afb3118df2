#include "majorant/parametrization/packing/internal/raster.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "majorant/parametrization/packing/internal/cell_grid.h"

namespace majorant {
namespace {

// ChartOutlines of the same class are looked for from where the last of them was found. Origin:
// classes a fifth apart in width and height; finer ones cost time for less than a hundredth of the
// side.
constexpr double kClassesPerOctave = 4;

// The middle row first, then those in the middle of what is left: where a chart does not fit, few
// rows say so.
CellRuns coarse_to_fine(const CellRuns& runs) {
  if (runs.empty()) return runs;
  const int first = runs.front().row;
  const auto rank = [&](const CellRun& run) {
    return -std::countr_zero(static_cast<unsigned>(run.row - first + 1));
  };
  CellRuns sorted = runs;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const CellRun& a, const CellRun& b) { return rank(a) < rank(b); });
  return sorted;
}

class RasterPacker {
 public:
  RasterPacker(const PackingJob& job, int cells, double width)
      : job_(job),
        cells_(cells),
        width_(width),
        cell_(width / cells),
        gap_(job.gap * width),
        margin_(static_cast<int>(std::ceil((gap_ + reach()) / cell_)) + 2),
        grid_(cells, margin_, longest() + 2 * margin_),
        strip_{std::vector<Pose>(job.charts.size()), 0} {}

  std::optional<Strip> pack() {
    for (std::size_t k = 0; k < job_.charts.size(); ++k) {
      if (!job_.fixed[k]) continue;
      const Vector2 low = *job_.fixed[k], high = low + job_.charts[k].size;
      if (high.maxCoeff() > width_) return {};
      put(k, {0, low}, cells_of(job_.charts[k], 0, low, cell_, 0), 0, 0);
    }
    for (const std::size_t k : largest_first()) {
      job_.stop.poll();
      if (!place(k)) return {};
    }
    return std::move(strip_);
  }

 private:
  double reach() const {
    double reach = 0;
    for (const ChartOutline& chart : job_.charts) reach = std::max(reach, chart.outline.reach);
    return reach;
  }

  int longest() const {
    double longest = 0;
    for (const ChartOutline& chart : job_.charts)
      longest = std::max(longest, chart.size.maxCoeff());
    return static_cast<int>(std::min(std::ceil(longest / cell_), double(cells_)));
  }

  std::vector<std::size_t> largest_first() const {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < job_.charts.size(); ++k)
      if (!job_.fixed[k]) order.push_back(k);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return job_.charts[a].size.sum() > job_.charts[b].size.sum();
    });
    return order;
  }

  void put(std::size_t k, const Pose& pose, const CellRuns& runs, int column, int row) {
    strip_.poses[k] = pose;
    strip_.height =
        std::max(strip_.height, pose.low.y() + size_after(job_.charts[k], pose.quarters).y());
    grid_.take(runs, column, row);
  }

  // The first row in which charts of that size were found last.
  int& first_row(const Vector2& size) {
    const auto number = [&](double length) {
      return static_cast<int>(
          std::floor(kClassesPerOctave * std::log2(std::max(length / cell_, 1.0))));
    };
    return first_rows_[{number(size.x()), number(size.y())}];
  }

  bool place(std::size_t k) {
    const ChartOutline& chart = job_.charts[k];
    std::optional<std::pair<int, int>> best;
    int best_quarters = 0, best_top = cells_ + 2;
    for (int quarters = 0; quarters < 4; ++quarters) {
      const Vector2 size = size_after(chart, quarters);
      const int height = static_cast<int>(std::ceil(size.y() / cell_)),
                last_column = static_cast<int>(std::floor((width_ - size.x()) / cell_)),
                last_row = std::min(best_top - 1 - height,
                                    static_cast<int>(std::floor((width_ - size.y()) / cell_)));
      const CellRuns around =
          coarse_to_fine(cells_of(chart, quarters, Vector2::Zero(), cell_, gap_));
      int& from = first_row(size);
      const auto found = grid_.lowest_place(around, from, last_row, last_column);
      if (!found) continue;
      from = found->second;
      best = found;
      best_quarters = quarters;
      best_top = found->second + height;
    }
    if (!best) return false;
    const auto [column, row] = *best;
    put(k, {best_quarters, cell_ * Vector2(column, row)},
        cells_of(chart, best_quarters, Vector2::Zero(), cell_, 0), column, row);
    return true;
  }

  const PackingJob& job_;
  int cells_;
  double width_, cell_, gap_;
  int margin_;  // cells around charts
  CellGrid grid_;
  std::map<std::pair<int, int>, int> first_rows_;
  Strip strip_;
};

}  // namespace

std::optional<Strip> raster_strip(const PackingJob& job, int cells, double width) {
  return RasterPacker(job, cells, width).pack();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
