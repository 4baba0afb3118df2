// A square grid of cells that are free or taken, and where a set of cells fits into it.
//
//   CellGrid grid(2048, 10, 500);
//   const CellRuns runs{{0, 5, 9}};
//   grid.take(runs, 100, 200);                               // row 200, columns 105 to 108
//   const auto place = grid.lowest_place(runs, 0, 500, 900);
//
// Every row is kept at several levels, of which level k says whether one of 2^k cells from here on
// is taken: a run of any length is tested with two of them, for 64 columns at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "majorant/parametrization/packing/internal/outline_cells.h"

namespace majorant {

class CellGrid {
 public:
  // Cells by cells; runs may reach `margin` cells beyond, where all is free, and be `longest` cells
  // long where they are tested.
  CellGrid(int cells, int margin, int longest);

  // The runs, moved by (column, row), are taken.
  void take(const CellRuns& runs, int column, int row);

  // The lowest row, then the leftmost column, by which the runs can be moved to meet free cells
  // only; first_row <= row <= last_row, 0 <= column <= last_column. None: nowhere. Runs are tested
  // in their order: those that meet most should come first.
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
  void update(int row, int begin, int end);  // what follows from level 0, changed there
  int widest(int row) const;
  bool wide_enough(const CellRuns& runs, int row) const;
  bool block(const CellRun& run, int row, std::vector<Word>& blocked) const;

  int cells_, margin_, level_count_;
  std::size_t words_;  // of a row
  std::vector<Word> levels_;
  std::vector<int> widest_;  // of each row: the longest run of free cells, those beyond included
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
