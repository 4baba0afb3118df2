// The symbolic half of a multifrontal Cholesky factorization [DR83]: which unknowns are eliminated
// together, and where every number is stored.
//
//   SparsePattern pattern;
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const AssemblyTree tree(pattern, BlockElimination{{0}, {0, 1}, {0, 1}, {0}});   // of one block
//   double operations = 0;
//   for (const AssemblyTree::Front& front : tree.fronts()) operations += front.operations();
//
// Unknowns are numbered by their position in the order of elimination. Fronts have the same order,
// so children come before parents. The unknowns of a front are its own columns, from `first` on,
// and its rows_below, ascending, which are columns of fronts above; the first of them belongs to
// the parent.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "majorant/framework/internal/column_slabs.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {

// The order in which the blocks of a graph are eliminated, and the supernodes that are eliminated
// together. It is a postorder: a supernode follows directly after the subtree that it depends on.
struct BlockElimination {
  std::vector<Index> order;             // blocks
  std::vector<Index> supernode_starts;  // positions: supernodes of neighbours in that order
  // For each supernode the positions that it touches, ascending, its own positions first.
  std::vector<std::size_t> structure_starts;
  std::vector<Index> structure;
};

class AssemblyTree {
 public:
  struct Front {
    Index first, columns, rows;  // rows: columns and those below
    Index parent;                // -1: none
    std::size_t begin;           // the begin of its part of the factor
    std::size_t below;           // the begin of its rows below, in rows_below
    std::size_t entries;         // the begin of its entries of the matrix
    ColumnSlabs part() const;    // of the factor
    ColumnSlabs update() const;  // the matrix that it adds to its parent
    double operations() const;   // multiply-adds, estimated
  };

  AssemblyTree(const SparsePattern& pattern, const BlockElimination& elimination);

  Index size() const { return static_cast<Index>(order_.size()); }
  const std::vector<Front>& fronts() const { return fronts_; }
  const std::vector<Index>& order() const { return order_; }  // position -> unknown
  // Returns the front that has the unknown at this position among its columns.
  Index front_of(Index position) const;
  // Returns the fronts whose parent is f, ascending.
  std::span<const Index> children(Index f) const;
  std::span<const Index> rows_below(Index f) const;
  // Parallel to rows_below: the row of the parent's front for each row.
  const Index* rows_of_parent(Index f) const { return rows_of_parent_.data() + front(f).below; }
  // The entries of the matrix that front f adds: slots of the pattern, and places in its part of
  // the factor.
  struct Entry {
    Index slot;
    std::uint32_t place;
  };
  std::span<const Entry> entries(Index f) const;

  std::size_t factor_size() const { return factor_size_; }  // of all fronts
  double nonzeros() const { return nonzeros_; }             // of the factor's triangle
  double operations() const { return operations_; }         // multiply-adds, estimated

 private:
  const Front& front(Index f) const { return fronts_[f]; }
  // Returns the front of each position.
  std::vector<Index> make_fronts(const BlockElimination& elimination,
                                 const std::vector<Index>& starts);
  void find_parents(const std::vector<Index>& front_of);
  void place_entries(const SparsePattern& pattern, const std::vector<Index>& front_of);

  std::vector<Front> fronts_;  // and a sentinel at the end
  std::vector<Index> order_;
  std::vector<Index> rows_below_, rows_of_parent_;
  std::vector<Index> child_starts_, children_;
  std::vector<Entry> entries_;
  std::size_t factor_size_ = 0;
  double nonzeros_ = 0, operations_ = 0;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
