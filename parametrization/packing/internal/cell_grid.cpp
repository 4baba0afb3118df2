#include "majorant/parametrization/packing/internal/cell_grid.h"

#include <algorithm>
#include <bit>

namespace majorant {

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

// Adds the columns at which the run meets a taken cell; false if all are blocked.
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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
