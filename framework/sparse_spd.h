// A symmetric positive definite system that is put together entry by entry, factorized once and
// solved for as many right-hand sides as needed: Laplacians and the like.
//
//   std::vector<SparseSpd::Entry> entries{{0, 0, 2}, {1, 0, -1}, {1, 1, 2}};
//   const SparseSpd matrix(2, 1, entries, "the matrix is singular");
//   const Vec x = matrix.solve(Vec::Ones(2));
//
// Not for matrices whose values change while the pattern stays, which is analysed but once with
// SparsePattern and LinearSolver.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/framework/linear_solver.h"

namespace majorant {

class SparseSpd {
 public:
  // Adds `value` to the entries (row, column) and (column, row), to the diagonal once. Entries of
  // one place are added up in their order.
  struct Entry {
    Index row, column;
    double value;
  };
  // block: neighbouring unknowns that are ordered together, 1 or 2 of them. ordering: Metis where
  // many solves of a large system come. Throws Error(Infeasible, otherwise) when the matrix is not
  // positive definite; Stopped.
  SparseSpd(Index size, Index block, const std::vector<Entry>& entries,
            const std::string& otherwise, Ordering ordering = Ordering::Amd,
            const StopCheck& stop = {});
  // values: parallel to pattern.rows. Stopped.
  SparseSpd(SparsePattern pattern, const Vec& values, const std::string& otherwise,
            const StopCheck& stop = {});

  Vec solve(const Vec& rhs) const;
  // The entries at these unknowns of the solution for a right-hand side of few entries, to the last
  // bit: much cheaper than all of it.
  Vec solution_entries(const DirectSolver::SparseColumn& rhs,
                       const std::vector<Index>& unknowns) const;
  Index size() const { return pattern_->size; }

 private:
  void factorize(const Vec& values, const std::string& otherwise, Ordering ordering,
                 const StopCheck& stop);

  std::unique_ptr<const SparsePattern> pattern_;  // where the solver knows it, also when moved
  std::unique_ptr<DirectSolver> solver_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
