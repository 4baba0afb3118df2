#include "majorant/parametrization/packing/internal/raster.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "majorant/parametrization/packing/internal/placements.h"

namespace majorant {
namespace {

// A square grid of free and taken cells, with a search for the place of a set of cells.
//
//   CellGrid grid(2048, 10, 500);
//   const CellRuns runs{{0, 5, 9}};
//   grid.take(runs, 100, 200);                               // row 200, columns 105 to 108
//   const auto place = grid.lowest_place(runs, 0, 500, 900);
//
// Every row is stored at several levels: level k says whether one of 2^k cells from here on is
// taken. A run of any length is tested with two words, for 64 columns at a time.

class CellGrid {
 public:
  // The grid has `cells` by `cells` cells. Runs may reach `margin` cells beyond, where all is free,
  // and are at most `longest` cells long where they are tested.
  CellGrid(int cells, int margin, int longest);

  // Takes the cells of the runs, moved by (column, row).
  void take(const CellRuns& runs, int column, int row);

  // Returns the lowest row, then the leftmost column, by which the runs can be moved to meet free
  // cells only; first_row <= row <= last_row, 0 <= column <= last_column. None: nowhere. Runs are
  // tested in order, so those that are most often blocked should come first.
  std::optional<std::pair<int, int>> lowest_place(const CellRuns& runs, int first_row, int last_row,
                                                  int last_column) const;

 private:
  using Word = std::uint64_t;
  const Word* level(int row, int k) const {
    return levels_.data() + (to_size(row) * to_size(level_count_) + to_size(k)) * words_;
  }
  Word* level(int row, int k) {
    return levels_.data() + (to_size(row) * to_size(level_count_) + to_size(k)) * words_;
  }
  void update(int row, int begin, int end);  // derives the other levels from a change of level 0
  int widest(int row) const;
  bool wide_enough(const CellRuns& runs, int row) const;
  bool block(const CellRun& run, int row, std::vector<Word>& blocked) const;

  int cells_, margin_, level_count_;
  std::size_t words_;  // of a row
  std::vector<Word> levels_;
  std::vector<int> widest_;  // by row: the longest run of free cells, with those beyond
};

CellGrid::CellGrid(int cells, int margin, int longest)
    : cells_(cells),
      margin_(margin),
      level_count_(std::bit_width(static_cast<unsigned>(std::min(longest, cells + 2 * margin)))),
      words_(to_size((cells + 2 * margin) / 64 + 3)),
      levels_(to_size(cells) * to_size(level_count_) * words_, 0),
      widest_(to_size(cells), cells + 2 * margin) {}

void CellGrid::take(const CellRuns& runs, int column, int row) {
  for (std::size_t k = 0; k < runs.size();) {
    const int j = runs[k].row + row;
    int begin = cells_ + margin_, end = margin_;
    for (; k < runs.size() && runs[k].row + row == j; ++k) {
      const int from = std::max(runs[k].begin + column, 0) + margin_,
                to = std::min(runs[k].end + column, cells_) + margin_;
      if (j < 0 || j >= cells_) continue;
      for (int i = from; i < to; ++i) level(j, 0)[i / 64] |= Word{1} << (i % 64);
      begin = std::min(begin, from);
      end = std::max(end, to);
    }
    if (begin < end) update(j, begin, end);
  }
}

void CellGrid::update(int row, int begin, int end) {
  for (int k = 1; k < level_count_; ++k) {
    const Word* from = level(row, k - 1);
    Word* to = level(row, k);
    const int ahead = 1 << (k - 1), shift = ahead % 64;
    const std::size_t skip = to_size(ahead / 64);
    const auto word = [&](std::size_t w) { return w < words_ ? from[w] : 0; };
    for (std::size_t w = to_size(std::max(begin - 2 * ahead, 0) / 64); w <= to_size(end / 64);
         ++w) {
      const Word high = shift == 0 ? 0 : word(w + skip + 1) << (64 - shift);
      to[w] = from[w] | word(w + skip) >> shift | high;
    }
  }
  widest_[row] = widest(row);
}

int CellGrid::widest(int row) const {
  int widest = 0, free = 0;
  const int end = cells_ + 2 * margin_;
  for (int i = 0; i < end;) {
    const Word rest = level(row, 0)[i / 64] >> (i % 64);
    const int zeros = std::min({std::countr_zero(rest), 64 - i % 64, end - i});
    i += zeros;
    free += zeros;
    widest = std::max(widest, free);
    if (zeros == 0) {
      i += std::countr_one(rest);
      free = 0;
    }
  }
  return widest;
}

bool CellGrid::wide_enough(const CellRuns& runs, int row) const {
  return std::all_of(runs.begin(), runs.end(), [&](const CellRun& run) {
    const int j = run.row + row;
    return j < 0 || j >= cells_ || run.end - run.begin <= widest_[j];
  });
}

// Adds the columns at which the run meets a taken cell. Returns false if all are blocked.
bool CellGrid::block(const CellRun& run, int row, std::vector<Word>& blocked) const {
  const int k = std::bit_width(static_cast<unsigned>(run.end - run.begin)) - 1;
  const Word* taken = level(row, k);
  Word all = ~Word{0};
  for (const int from : {run.begin, run.end - (1 << k)}) {
    const std::size_t skip = to_size((from + margin_) / 64);
    const int shift = (from + margin_) % 64;
    all = ~Word{0};
    for (std::size_t w = 0; w < blocked.size(); ++w) {
      const Word low = taken[w + skip] >> shift;
      const Word high = shift == 0 ? 0 : taken[w + skip + 1] << (64 - shift);
      blocked[w] |= low | high;
      all &= blocked[w];
    }
  }
  return all != ~Word{0};
}

std::optional<std::pair<int, int>> CellGrid::lowest_place(const CellRuns& runs, int first_row,
                                                          int last_row, int last_column) const {
  if (last_column < 0) return {};
  std::vector<Word> blocked(to_size(last_column / 64 + 1));
  for (int row = first_row; row <= last_row; ++row) {
    if (!wide_enough(runs, row)) continue;
    std::fill(blocked.begin(), blocked.end(), Word{0});
    if (last_column % 64 != 63) blocked.back() = ~Word{0} << (last_column % 64 + 1);
    bool open = true;
    for (auto run = runs.begin(); open && run != runs.end(); ++run)
      if (run->row + row >= 0 && run->row + row < cells_)
        open = block(*run, run->row + row, blocked);
    if (!open) continue;
    const auto free = std::find_if(blocked.begin(), blocked.end(), [](Word w) { return ~w != 0; });
    const int column = static_cast<int>(free - blocked.begin()) * 64 + std::countr_one(*free);
    return std::pair(column, row);
  }
  return {};
}

// The search for a chart starts at the place of the last chart of its size class. Classes are a
// fifth apart in width and height; finer ones cost time and gain less than a hundredth of the side.
constexpr double kClassesPerOctave = 4;

// Orders the runs by bisection, the middle row first: where a chart does not fit, few rows suffice
// to reject it.
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
        longest_(longest() + 2 * margin_),
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

  // Returns the grid of a tile, which is created when the ones before it are full.
  CellGrid& grid(int tile) {
    while (grids_.size() <= to_size(tile)) grids_.emplace_back(cells_, margin_, longest_);
    return grids_[to_size(tile)];
  }

  void put(std::size_t k, const Pose& pose, const CellRuns& runs, int column, int row) {
    strip_.poses[k] = pose;
    strip_.height =
        std::max(strip_.height, pose.low.y() + size_after(job_.charts[k], pose.quarters).y());
    grid(pose.tile).take(runs, column, row);
  }

  // Returns the first row of a tile at which the last chart of that size was placed.
  int& first_row(int tile, const Vector2& size) {
    const auto number = [&](double length) {
      return static_cast<int>(
          std::floor(kClassesPerOctave * std::log2(std::max(length / cell_, 1.0))));
    };
    return first_rows_[{tile, number(size.x()), number(size.y())}];
  }

  bool place(std::size_t k) {
    for (int tile = 0; tile < job_.tiles; ++tile)
      if (place(k, tile)) return true;
    return false;
  }

  bool place(std::size_t k, int tile) {
    const ChartOutline& chart = job_.charts[k];
    std::optional<std::pair<int, int>> best;
    int best_quarters = 0, best_top = cells_ + 2;
    for (int quarters = 0; quarters < chart.quarter_turns; ++quarters) {
      const Vector2 size = size_after(chart, quarters);
      const int height = static_cast<int>(std::ceil(size.y() / cell_)),
                last_column = static_cast<int>(std::floor((width_ - size.x()) / cell_)),
                last_row = std::min(best_top - 1 - height,
                                    static_cast<int>(std::floor((width_ - size.y()) / cell_)));
      const CellRuns around =
          coarse_to_fine(cells_of(chart, quarters, Vector2::Zero(), cell_, gap_));
      int& from = first_row(tile, size);
      const auto found = grid(tile).lowest_place(around, from, last_row, last_column);
      if (!found && !best && job_.tiles > 1) from = last_row + 1;  // full for charts of that size
      if (!found) continue;
      from = found->second;
      best = found;
      best_quarters = quarters;
      best_top = found->second + height;
    }
    if (!best) return false;
    const auto [column, row] = *best;
    put(k, {best_quarters, cell_ * Vector2(column, row), tile},
        cells_of(chart, best_quarters, Vector2::Zero(), cell_, 0), column, row);
    return true;
  }

  const PackingJob& job_;
  int cells_;
  double width_, cell_, gap_;
  int margin_;   // cells around charts
  int longest_;  // of the runs that are tested
  std::deque<CellGrid> grids_;
  std::map<std::tuple<int, int, int>, int> first_rows_;
  Strip strip_;
};

// The margin of every radius, in cells: a million roundings of a grid of 10,000 cells.
constexpr double kMargin = 1e-6;

struct Interval {
  double low = 1, high = 0;  // empty
  void add(double x) {
    if (low > high) low = high = x;
    low = std::min(low, x);
    high = std::max(high, x);
  }
};

// Returns the x coordinates, within y0 <= y <= y1, of all points within `radius` of the segment ab.
// They form a convex set whose ends are on one of the two disks or the two sides.
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

// Cells that are drawn, in units of cells.
class Raster {
 public:
  Raster(const Vector2& low, const Vector2& high)
      : left_(static_cast<int>(std::floor(low.x()))),
        bottom_(static_cast<int>(std::floor(low.y()))),
        columns_(static_cast<int>(std::floor(high.x())) - left_ + 1),
        rows_(static_cast<int>(std::floor(high.y())) - bottom_ + 1),
        cells_(to_size(columns_) * to_size(rows_), 0) {}

  void draw(const Vector2& a, const Vector2& b, double radius) {
    const int first = row_of(std::min(a.y(), b.y()) - radius),
              last = row_of(std::max(a.y(), b.y()) + radius);
    for (int j = first; j <= last; ++j) {
      const double y = bottom_ + j;
      const Interval x = in_row(a, b, radius, y - kMargin, y + 1 + kMargin);
      if (x.low <= x.high) fill(j, std::floor(x.low), std::floor(x.high) + 1);
    }
  }

  // Fills the cells whose centre is inside by parity. Correct for cells that the drawn outline does
  // not meet.
  void fill_inside(const std::vector<std::vector<Vector2>>& loops) {
    std::vector<std::vector<double>> crossings(to_size(rows_));
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
    for (int j = 0; j < rows_; ++j) {
      const char *const first = row(j), *const last = first + columns_;
      const auto next = [last](const char* at, int value) {
        const void* found = std::memchr(at, value, static_cast<std::size_t>(last - at));
        return found ? static_cast<const char*>(found) : last;
      };
      for (const char* begin = next(first, 1); begin != last;) {
        const char* const end = next(begin, 0);
        runs.push_back({bottom_ + j, left_ + static_cast<int>(begin - first),
                        left_ + static_cast<int>(end - first)});
        begin = next(end, 1);
      }
    }
    return runs;
  }

 private:
  const char* row(int j) const { return cells_.data() + to_size(j) * to_size(columns_); }
  int row_of(double y) const {
    return std::clamp(static_cast<int>(std::floor(y)) - bottom_, 0, rows_ - 1);
  }
  void fill(int row, double begin, double end) {
    const int b = static_cast<int>(std::max(begin - left_, 0.0)),
              e = static_cast<int>(std::min(end - left_, double(columns_)));
    if (b < e)
      std::fill_n(cells_.begin() + (to_size(row) * to_size(columns_) + to_size(b)), e - b, 1);
  }

  int left_, bottom_, columns_, rows_;
  std::vector<char> cells_;  // by row
};

}  // namespace

std::optional<Strip> raster_strip(const PackingJob& job, int cells, double width) {
  return RasterPacker(job, cells, width).pack();
}

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
