#include "majorant/framework/sparse_pattern.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace majorant {

void SparsePattern::append_column(const std::vector<Index>& rows_below) {
  rows.push_back(size++);
  const auto first = rows.insert(rows.end(), rows_below.begin(), rows_below.end());
  std::sort(first, rows.end());
  rows.erase(std::unique(first, rows.end()), rows.end());
  column_starts.push_back(nonzeros());
}

void SparsePattern::order_in_blocks(Index block) {
  block_of.clear();
  for (Index i = 0; i < size; ++i) block_of.push_back(i / block);
}

SparsePattern SparsePattern::joined(const SparsePattern& more, std::vector<Index>& places) const {
  assert(size <= more.size);
  SparsePattern out;
  out.size = more.size;
  out.block_of = more.block_of;
  out.column_starts.reserve(more.column_starts.size());
  out.rows.reserve(rows.size() + more.rows.size() - at(size));
  places.clear();
  places.reserve(rows.size());
  for (Index c = 0; c < more.size; ++c) {
    const Index *theirs = more.rows.data() + more.column_starts[at(c)],
                *their_end = more.rows.data() + more.column_starts[at(c) + 1];
    if (c < size) {
      const Index* end = rows.data() + column_starts[at(c) + 1];
      for (const Index* mine = rows.data() + column_starts[at(c)]; mine != end; ++mine) {
        while (theirs != their_end && *theirs < *mine) out.rows.push_back(*theirs++);
        if (theirs != their_end && *theirs == *mine) ++theirs;
        places.push_back(out.nonzeros());
        out.rows.push_back(*mine);
      }
    }
    out.rows.insert(out.rows.end(), theirs, their_end);
    out.column_starts.push_back(out.nonzeros());
  }
  return out;
}

Index SparsePattern::slot(Index row, Index column) const {
  if (row < column) std::swap(row, column);
  const auto first = rows.begin() + column_starts[at(column)];
  const auto last = rows.begin() + column_starts[at(column) + 1];
  const auto found = std::lower_bound(first, last, row);
  assert(found != last && *found == row);
  return static_cast<Index>(found - rows.begin());
}

}  // namespace majorant
