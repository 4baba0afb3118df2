// A symmetric positive definite system that is assembled entry by entry, factorized once and solved
// for any number of right-hand sides, such as a Laplacian.
//
//   std::vector<SparseSpd::Entry> entries{{0, 0, 2}, {1, 0, -1}, {1, 1, 2}};
//   const SparseSpd matrix(2, 1, entries, "the matrix is singular");
//   const Vec x = matrix.solve(Vec::Ones(2));
//
// Not for matrices whose values change while the pattern stays: use SparsePattern and LinearSolver,
// which analyse the pattern once.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "majorant/framework/linear_solver.h"

namespace majorant {

class SparseSpd {
 public:
  // Adds `value` to the entries (row, column) and (column, row), once if they are the same. Entries
  // at one place are added in their order.
  struct Entry {
    Index row, column;
    double value;
  };
  // block: 1 or 2 neighbouring unknowns are ordered together. ordering: Metis for many solves of a
  // large system. Throws Error(Infeasible, otherwise) if the matrix is not positive definite, and
  // Stopped.
  SparseSpd(Index size, Index block, const std::vector<Entry>& entries,
            const std::string& otherwise, Ordering ordering = Ordering::Amd,
            const StopCheck& stop = {});
  // values: parallel to pattern.rows. Throws as above.
  SparseSpd(SparsePattern pattern, const Vec& values, const std::string& otherwise,
            const StopCheck& stop = {});

  Vec solve(const Vec& rhs) const;
  // Returns the entries of the solution at these unknowns, equal to the last bit, for a right-hand
  // side with few entries: much cheaper than the whole solution.
  Vec solution_entries(const DirectSolver::SparseColumn& rhs,
                       const std::vector<Index>& unknowns) const;
  Index size() const { return pattern_->size; }

 private:
  void factorize(const Vec& values, const std::string& otherwise, Ordering ordering,
                 const StopCheck& stop);

  std::unique_ptr<const SparsePattern> pattern_;  // at a fixed address for the solver, even if
                                                  // moved
  std::unique_ptr<DirectSolver> solver_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
