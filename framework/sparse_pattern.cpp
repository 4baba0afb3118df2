#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

void SparsePattern::append_column(const std::vector<Index>& rows_below) {
  for (const Index row : rows_below)
    if (row <= size)
      throw InvalidArgument(
          fmt::format("SparsePattern::append_column: row {} is not below the "
                      "diagonal of column {}",
                      row, size));
  rows.push_back(size++);
  const auto first = rows.insert(rows.end(), rows_below.begin(), rows_below.end());
  std::sort(first, rows.end());
  rows.erase(std::unique(first, rows.end()), rows.end());
  column_starts.push_back(counted("entries of a sparse pattern", rows.size()));
}

void SparsePattern::order_in_blocks(Index block) {
  require_at_least("SparsePattern::order_in_blocks: block", block, 1);
  block_of.clear();
  for (Index i = 0; i < size; ++i) block_of.push_back(i / block);
}

SparsePattern SparsePattern::joined(const SparsePattern& more, std::vector<Index>& places) const {
  if (size > more.size)
    throw InvalidArgument(
        fmt::format("SparsePattern::joined: {} columns, at least {} are needed", more.size, size));
  SparsePattern out;
  out.size = more.size;
  out.block_of = more.block_of;
  out.column_starts.reserve(more.column_starts.size());
  out.rows.reserve(rows.size() + more.rows.size() - to_size(size));
  places.clear();
  places.reserve(rows.size());
  for (Index c = 0; c < more.size; ++c) {
    const Index *theirs = more.rows.data() + more.column_starts[c],
                *their_end = more.rows.data() + more.column_starts[c + 1];
    if (c < size) {
      const Index* end = rows.data() + column_starts[c + 1];
      for (const Index* mine = rows.data() + column_starts[c]; mine != end; ++mine) {
        while (theirs != their_end && *theirs < *mine) out.rows.push_back(*theirs++);
        if (theirs != their_end && *theirs == *mine) ++theirs;
        places.push_back(counted("entries of a sparse pattern", out.rows.size()));
        out.rows.push_back(*mine);
      }
    }
    out.rows.insert(out.rows.end(), theirs, their_end);
    out.column_starts.push_back(counted("entries of a sparse pattern", out.rows.size()));
  }
  return out;
}

void require_valid(const SparsePattern& p) {
  const auto refuse = [](const std::string& what) {
    throw InvalidArgument("sparse pattern: " + what);
  };
  if (p.size < 0 || p.column_starts.size() != to_size(p.size) + 1 || p.column_starts.front() != 0 ||
      p.column_starts.back() != p.nonzeros())
    refuse(fmt::format("{} starts of columns, of {} unknowns and {} entries",
                       p.column_starts.size(), p.size, p.nonzeros()));
  if (p.block_of.size() != to_size(p.size))
    refuse(fmt::format("{} blocks for {} unknowns; order_in_blocks() makes them", p.block_of.size(),
                       p.size));
  for (Index c = 0, block = 0; c < p.size; ++c) {
    const Index first = p.column_starts[c], last = p.column_starts[c + 1];
    bool sound = first < last && last <= p.nonzeros() && p.rows[first] == c;
    for (Index k = first + 1; k < last && sound; ++k)
      sound = p.rows[k] > p.rows[k - 1] && p.rows[k] < p.size;
    if (!sound) refuse(fmt::format("column {} is not its diagonal and sorted rows below it", c));
    const Index next = p.block_of[c];
    if (next != block && (c == 0 || next != block + 1))
      refuse(fmt::format("block {} of unknown {} follows block {}", next, c, block));
    block = next;
  }
}

Index SparsePattern::slot(Index row, Index column) const {
  if (row < column) std::swap(row, column);
  require_index("SparsePattern::slot: column", column, size);
  const auto first = rows.begin() + column_starts[column];
  const auto last = rows.begin() + column_starts[column + 1];
  const auto found = std::lower_bound(first, last, row);
  if (found == last || *found != row)
    throw InvalidArgument(
        fmt::format("SparsePattern::slot: there is no entry ({}, {})", row, column));
  return static_cast<Index>(found - rows.begin());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
