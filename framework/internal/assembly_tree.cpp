#include "majorant/framework/internal/assembly_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

std::ptrdiff_t padded(std::ptrdiff_t rows) {
  return (rows + FrontKernels::kTile - 1) / FrontKernels::kTile * FrontKernels::kTile;
}

// Returns the unknowns in the order of their blocks. starts: the first unknown of each block.
std::vector<Index> ordered_unknowns(const SparsePattern& pattern, const std::vector<Index>& blocks,
                                    std::vector<Index>& starts) {
  std::vector<Index> position(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) position[blocks[k]] = static_cast<Index>(k);
  starts.assign(blocks.size() + 1, 0);
  for (const Index b : pattern.block_of) ++starts[to_size(position[b]) + 1];
  for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
  std::vector<Index> order(to_size(pattern.size)), next(starts);
  for (Index i = 0; i < pattern.size; ++i) order[next[position[pattern.block_of[i]]]++] = i;
  return order;
}

}  // namespace

ColumnSlabs AssemblyTree::Front::part() const { return {padded(rows), columns}; }

ColumnSlabs AssemblyTree::Front::update() const { return {padded(rows - columns), rows - columns}; }

double AssemblyTree::Front::operations() const {
  double sum = 0;
  for (Index c = 0; c < columns; ++c) sum += 0.5 * (rows - c) * static_cast<double>(rows - c);
  return sum;
}

AssemblyTree::AssemblyTree(const SparsePattern& pattern, const BlockElimination& elimination) {
  std::vector<Index> starts;
  order_ = ordered_unknowns(pattern, elimination.order, starts);
  const std::vector<Index> front_of = make_fronts(elimination, starts);
  find_parents(front_of);
  place_entries(pattern, front_of);
}

Index AssemblyTree::front_of(Index position) const {
  const auto after = std::upper_bound(fronts_.begin(), fronts_.end() - 1, position,
                                      [](Index p, const Front& f) { return p < f.first; });
  return static_cast<Index>(after - fronts_.begin()) - 1;
}

std::span<const Index> AssemblyTree::children(Index f) const {
  return {children_.data() + child_starts_[f], children_.data() + child_starts_[f + 1]};
}

std::span<const Index> AssemblyTree::rows_below(Index f) const {
  return {rows_below_.data() + front(f).below, rows_below_.data() + front(f + 1).below};
}

std::span<const AssemblyTree::Entry> AssemblyTree::entries(Index f) const {
  return {entries_.data() + front(f).entries, entries_.data() + front(f + 1).entries};
}

std::vector<Index> AssemblyTree::make_fronts(const BlockElimination& elimination,
                                             const std::vector<Index>& starts) {
  std::vector<Index> front_of(order_.size());
  const std::size_t supernodes = elimination.supernode_starts.size() - 1;
  fronts_.reserve(supernodes + 1);
  for (std::size_t g = 0; g < supernodes; ++g) {
    const Index last_block = elimination.supernode_starts[g + 1];
    Front front{};
    front.first = starts[elimination.supernode_starts[g]];
    front.columns = starts[last_block] - front.first;
    front.begin = factor_size_;
    front.below = rows_below_.size();
    for (std::size_t k = elimination.structure_starts[g]; k < elimination.structure_starts[g + 1];
         ++k) {
      const Index block = elimination.structure[k];
      if (block < last_block) continue;
      for (Index i = starts[block]; i < starts[block + 1]; ++i) rows_below_.push_back(i);
    }
    const auto below = static_cast<Index>(rows_below_.size() - front.below);
    front.rows = front.columns + below;
    const std::size_t size = front.part().size();
    if (size > std::numeric_limits<std::uint32_t>::max())
      throw Error(ErrorKind::Unsupported,
                  fmt::format("direct solver: {} unknowns that are eliminated together touch {}, "
                              "more than a factor holds; use an iterative solver",
                              front.columns, front.rows));
    factor_size_ += size;
    for (Index c = 0; c < front.columns; ++c) {
      front_of[front.first + c] = static_cast<Index>(g);
      nonzeros_ += front.rows - c;
    }
    operations_ += front.operations();
    fronts_.push_back(front);
  }
  Front end{};
  end.begin = factor_size_;
  end.below = rows_below_.size();
  fronts_.push_back(end);
  return front_of;
}

void AssemblyTree::find_parents(const std::vector<Index>& front_of) {
  const auto count = static_cast<Index>(fronts_.size()) - 1;
  rows_of_parent_.resize(rows_below_.size());
  child_starts_.assign(to_size(count) + 2, 0);
  for (Index f = 0; f < count; ++f) {
    Front& front = fronts_[f];
    front.parent = front.rows > front.columns ? front_of[rows_below_[front.below]] : -1;
    if (front.parent < 0) continue;
    ++child_starts_[to_size(front.parent) + 2];
    const Front& parent = fronts_[front.parent];
    const std::span<const Index> theirs = rows_below(front.parent);
    std::size_t next = 0;
    for (std::size_t k = front.below; k < fronts_[f + 1].below; ++k) {
      const Index row = rows_below_[k];
      if (row < parent.first + parent.columns) {
        rows_of_parent_[k] = row - parent.first;
        continue;
      }
      while (theirs[next] < row) ++next;
      assert(theirs[next] == row);
      rows_of_parent_[k] = parent.columns + static_cast<Index>(next);
    }
  }
  for (std::size_t k = 1; k < child_starts_.size(); ++k) child_starts_[k] += child_starts_[k - 1];
  children_.resize(to_size(child_starts_.back()));
  for (Index f = 0; f < count; ++f)
    if (const Index parent = front(f).parent; parent >= 0)
      children_[child_starts_[parent + 1]++] = f;
  child_starts_.pop_back();
}

// A counting sort: counts the entries of each front, then places each entry.
void AssemblyTree::place_entries(const SparsePattern& pattern, const std::vector<Index>& front_of) {
  std::vector<Index> position(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) position[order_[k]] = static_cast<Index>(k);
  const std::size_t count = fronts_.size() - 1;
  std::vector<std::size_t> starts(count + 2, 0);
  const auto visit = [&](const auto& use) {
    for (Index c = 0; c < pattern.size; ++c)
      for (Index k = pattern.column_starts[c]; k < pattern.column_starts[c + 1]; ++k) {
        const auto [column, row] = std::minmax(position[c], position[pattern.rows[k]]);
        use(k, column, row);
      }
  };
  visit([&](Index, Index column, Index) { ++starts[to_size(front_of[column]) + 2]; });
  for (std::size_t f = 2; f < starts.size(); ++f) starts[f] += starts[f - 1];
  entries_.resize(pattern.rows.size());
  std::vector<Index> columns(entries_.size());
  // The place of an entry is its row until its front is processed.
  visit([&](Index k, Index column, Index row) {
    const std::size_t at = starts[to_size(front_of[column]) + 1]++;
    entries_[at] = {k, static_cast<std::uint32_t>(row)};
    columns[at] = column;
  });
  std::vector<Index> local(order_.size());
  for (std::size_t f = 0; f < count; ++f) {
    Front& front = fronts_[f];
    front.entries = starts[f];
    for (Index c = 0; c < front.columns; ++c) local[front.first + c] = c;
    const ColumnSlabs part = front.part();
    Index next = front.columns;
    for (const Index row : rows_below(static_cast<Index>(f))) local[row] = next++;
    for (std::size_t k = starts[f]; k < starts[f + 1]; ++k) {
      entries_[k].place = static_cast<std::uint32_t>(part.column(columns[k] - front.first) +
                                                     local[entries_[k].place]);
    }
  }
  fronts_[count].entries = entries_.size();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
