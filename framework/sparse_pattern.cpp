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

Index SparsePattern::slot(Index row, Index column) const {
  if (row < column) std::swap(row, column);
  const auto first = rows.begin() + column_starts[at(column)];
  const auto last = rows.begin() + column_starts[at(column) + 1];
  const auto found = std::lower_bound(first, last, row);
  assert(found != last && *found == row);
  return static_cast<Index>(found - rows.begin());
}

}  // namespace majorant
