// Matrices of a grid of nodes, with a strip of rows on every rank, for tests of solvers on any
// number of ranks.
#pragma once

#include <functional>
#include <memory>

#include "apps/mpi/processes.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/partition.h"

namespace majorant::test {

// Returns the ranks of the test program, which starts MPI and PETSc.
inline const std::shared_ptr<const Ranks>& ranks() {
  static const Processes processes({});
  return processes.ranks();
}

// The matrix of the sum of edge weights times squared differences, plus `mass` at all nodes. There
// are `width` nodes per row, and `width` rows on every rank.
class StripMatrix {
 public:
  // The weight of the edge from node (i, j) to the right or up; j counts over all ranks.
  using Weight = std::function<double(Index i, Index j, bool up)>;

  StripMatrix(Index width, const Weight& weight, double mass) : width_(width) {
    const Index rank = ranks()->rank(), last = ranks()->count() - 1;
    const Index rows = width + (rank < last ? 1 : 0);  // the next rank's first row is copied
    for (Index j = 0; j < rows; ++j)
      for (Index i = 0; i < width; ++i) {
        std::vector<Index> below;
        if (i + 1 < width) below.push_back(node(i + 1, j));
        if (j + 1 < rows) below.push_back(node(i, j + 1));
        pattern.append_column(below);
      }
    pattern.order_in_blocks(1);
    values = Vec::Zero(pattern.nonzeros());
    for (Index j = 0; j < width; ++j)
      for (Index i = 0; i < width; ++i) {
        values[pattern.diagonal_slot(node(i, j))] += mass;
        if (i + 1 < width) add(node(i, j), node(i + 1, j), weight(i, rank * width + j, false));
        if (j + 1 < rows) add(node(i, j), node(i, j + 1), weight(i, rank * width + j, true));
      }
    std::vector<Partition::Neighbour> neighbours;
    if (rank > 0) neighbours.push_back({rank - 1, row(0), {}});
    if (rank < last) neighbours.push_back({rank + 1, {}, row(width)});
    partition = std::make_unique<const Partition>(ranks(), pattern.size, neighbours);
  }

  // Multiplies p by the whole matrix, to test a solution; the result has the solvers' form.
  Vec times(const Vec& p) const {
    Vec r = Vec::Zero(p.size());
    for (Index c = 0; c < pattern.size; ++c)
      for (Index k = pattern.column_starts[c]; k < pattern.column_starts[c + 1]; ++k) {
        const Index row = pattern.rows[k];
        r[row] += values[k] * p[c];
        if (row != c) r[c] += values[k] * p[row];
      }
    partition->add_to_owners(r);
    return r;
  }
  // Returns a function of nodes as a right-hand side, which is 0 in copies.
  Vec sampled(const std::function<double(Index i, Index j)>& f) const {
    Vec r = Vec::Zero(pattern.size);
    for (Index j = 0; j < width_; ++j)
      for (Index i = 0; i < width_; ++i) r[node(i, j)] = f(i, ranks()->rank() * width_ + j);
    return r;
  }

  SparsePattern pattern;
  Vec values;
  std::unique_ptr<const Partition> partition;

 private:
  Index node(Index i, Index j) const { return j * width_ + i; }
  std::vector<Index> row(Index j) const {
    std::vector<Index> nodes;
    for (Index i = 0; i < width_; ++i) nodes.push_back(node(i, j));
    return nodes;
  }
  void add(Index a, Index b, double w) {
    values[pattern.diagonal_slot(a)] += w;
    values[pattern.diagonal_slot(b)] += w;
    values[pattern.slot(a, b)] -= w;
  }

  Index width_;
};

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
