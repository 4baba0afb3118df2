#include "majorant/parametrization/packing/internal/cell_grid.h"

#include <algorithm>
#include <bit>

namespace majorant {

CellGrid::CellGrid(int cells, int margin)
    : cells_(cells),
      margin_(margin),
      level_count_(std::bit_width(static_cast<unsigned>(cells + 2 * margin))),
      words_(at((cells + 2 * margin) / 64 + 3)),
      levels_(at(cells) * at(level_count_) * words_, 0),
      widest_(at(cells), cells + 2 * margin) {}

void CellGrid::take(const CellRuns& runs, int column, int row) {
  int last = -1;
  for (const CellRun& run : runs) {
    const int j = run.row + row;
    if (j < 0 || j >= cells_) continue;
    if (last >= 0 && last != j) update(last);
    last = j;
    const int begin = std::max(run.begin + column, 0), end = std::min(run.end + column, cells_);
    for (int i = begin + margin_; i < end + margin_; ++i)
      level(j, 0)[at(i / 64)] |= Word{1} << (i % 64);
  }
  if (last >= 0) update(last);
}

void CellGrid::update(int row) {
  for (int k = 1; k < level_count_; ++k) {
    const Word* from = level(row, k - 1);
    Word* to = level(row, k);
    const std::size_t skip = at((1 << (k - 1)) / 64);
    const int shift = (1 << (k - 1)) % 64;
    const auto word = [&](std::size_t w) { return w < words_ ? from[w] : 0; };
    for (std::size_t w = 0; w < words_; ++w) {
      const Word high = shift == 0 ? 0 : word(w + skip + 1) << (64 - shift);
      to[w] = from[w] | word(w + skip) >> shift | high;
    }
  }
  int free = 0, widest = 0;
  for (int i = 0; i < cells_ + 2 * margin_; ++i) {
    const bool taken = level(row, 0)[at(i / 64)] >> (i % 64) & 1;
    free = taken ? 0 : free + 1;
    widest = std::max(widest, free);
  }
  widest_[at(row)] = widest;
}

bool CellGrid::wide_enough(const CellRuns& runs, int row) const {
  return std::all_of(runs.begin(), runs.end(), [&](const CellRun& run) {
    const int j = run.row + row;
    return j < 0 || j >= cells_ || run.end - run.begin <= widest_[at(j)];
  });
}

// Adds the columns at which the run meets a taken cell; false if all are blocked.
bool CellGrid::block(const CellRun& run, int row, std::vector<Word>& blocked) const {
  const int k = std::bit_width(static_cast<unsigned>(run.end - run.begin)) - 1;
  const Word* taken = level(row, k);
  Word all = ~Word{0};
  for (const int from : {run.begin, run.end - (1 << k)}) {
    const std::size_t skip = at((from + margin_) / 64);
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
  std::vector<Word> blocked(at(last_column / 64 + 1));
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
