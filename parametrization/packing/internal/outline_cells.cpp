#include "majorant/parametrization/packing/internal/outline_cells.h"

#include <algorithm>
#include <cmath>

#include "majorant/parametrization/packing/internal/placements.h"

namespace majorant {
namespace {

// Added to every radius, in cells. Origin: a million roundings of a grid of 10,000 cells.
constexpr double kMargin = 1e-6;

struct Interval {
  double low = 1, high = 0;  // empty
  void add(double x) {
    if (low > high) low = high = x;
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

// The x coordinates, within y0 <= y <= y1, of all points within `radius` of the segment ab: a
// convex set, whose ends are on one of the two disks or the two sides.
Interval in_row(const Vector2& a, const Vector2& b, double radius, double y0, double y1) {
  Interval x;
  for (const Vector2* middle : {&a, &b}) {
    const double off = std::abs(std::clamp(middle->y(), y0, y1) - middle->y());
    if (off > radius) continue;
    const double half = std::sqrt(radius * radius - off * off);
    x.add(middle->x() - half);
    x.add(middle->x() + half);
  }
  const double length = (b - a).norm();
  if (!(length > 0)) return x;
  const Vector2 side = radius / length * Vector2(a.y() - b.y(), b.x() - a.x());
  for (const double sign : {1.0, -1.0}) {
    const Vector2 p = a + sign * side, q = b + sign * side;
    if (std::max(p.y(), q.y()) < y0 || std::min(p.y(), q.y()) > y1) continue;
    for (const double y : {y0, y1, p.y(), q.y()}) {
      if (y < y0 || y > y1 || (y - p.y()) * (y - q.y()) > 0) continue;
      if (p.y() == q.y()) {
        x.add(p.x());
        x.add(q.x());
      } else {
        x.add(p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x()));
      }
    }
  }
  return x;
}

// In units of cells.
class Raster {
 public:
  Raster(const Vector2& low, const Vector2& high)
      : left_(static_cast<int>(std::floor(low.x()))),
        bottom_(static_cast<int>(std::floor(low.y()))),
        columns_(static_cast<int>(std::floor(high.x())) - left_ + 1),
        rows_(to_size(static_cast<int>(std::floor(high.y())) - bottom_ + 1)) {
    for (auto& row : rows_) row.resize(to_size(columns_), 0);
  }

  void draw(const Vector2& a, const Vector2& b, double radius) {
    const int first = row_of(std::min(a.y(), b.y()) - radius),
              last = row_of(std::max(a.y(), b.y()) + radius);
    for (int j = first; j <= last; ++j) {
      const double y = bottom_ + j;
      const Interval x = in_row(a, b, radius, y - kMargin, y + 1 + kMargin);
      if (x.low <= x.high) fill(j, std::floor(x.low), std::floor(x.high) + 1);
    }
  }

  // What is inside by parity at the middle of cells: right for those that nothing drawn meets.
  void fill_inside(const std::vector<std::vector<Vector2>>& loops) {
    std::vector<std::vector<double>> crossings(rows_.size());
    for (const std::vector<Vector2>& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vector2 &a = loop[k], &b = loop[(k + 1) % loop.size()];
        const auto [low, high] = std::minmax(a.y(), b.y());
        for (int j = row_of(low); j <= row_of(high); ++j) {
          const double y = bottom_ + j + 0.5;
          if ((a.y() > y) != (b.y() > y))
            crossings[j].push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
        }
      }
    for (std::size_t j = 0; j < crossings.size(); ++j) {
      std::vector<double>& x = crossings[j];
      std::sort(x.begin(), x.end());
      for (std::size_t k = 0; k + 1 < x.size(); k += 2)
        fill(static_cast<int>(j), std::ceil(x[k] - 0.5), std::floor(x[k + 1] - 0.5) + 1);
    }
  }

  CellRuns runs() const {
    CellRuns runs;
    for (std::size_t j = 0; j < rows_.size(); ++j)
      for (int i = 0; i < columns_;) {
        const int begin = i;
        while (i < columns_ && rows_[j][i]) ++i;
        if (i > begin) runs.push_back({bottom_ + static_cast<int>(j), left_ + begin, left_ + i});
        while (i < columns_ && !rows_[j][i]) ++i;
      }
    return runs;
  }

 private:
  int row_of(double y) const {
    return std::clamp(static_cast<int>(std::floor(y)) - bottom_, 0,
                      static_cast<int>(rows_.size()) - 1);
  }
  void fill(int row, double begin, double end) {
    const double b = std::max(begin - left_, 0.0), e = std::min(end - left_, double(columns_));
    for (int i = static_cast<int>(b); i < static_cast<int>(e); ++i) rows_[row][i] = 1;
  }

  int left_, bottom_, columns_;
  std::vector<std::vector<char>> rows_;
};

}  // namespace

CellRuns cells_of(const ChartOutline& chart, int quarters, const Vector2& low, double cell,
                  double distance) {
  std::vector<std::vector<Vector2>> loops = chart.outline.loops;
  for (auto& loop : loops)
    for (Vector2& p : loop) p = (quarter_turned(p, quarters, chart.size) + low) / cell;
  const double radius = (distance + chart.outline.reach) / cell + kMargin;
  const Vector2 margin = Vector2::Constant(radius);
  Raster raster(low / cell - margin, (low + size_after(chart, quarters)) / cell + margin);
  raster.fill_inside(loops);
  for (const auto& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      raster.draw(loop[k], loop[(k + 1) % loop.size()], radius);
  return raster.runs();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
