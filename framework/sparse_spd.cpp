#include "majorant/framework/sparse_spd.h"

#include <utility>

#include "majorant/framework/error.h"
#include "majorant/framework/pattern_of_pairs.h"

namespace majorant {
namespace {

SparsePattern pattern_of(Index size, Index block, const std::vector<SparseSpd::Entry>& entries) {
  return pattern_of_pairs(size, block, [&](const auto& add) {
    for (const SparseSpd::Entry& e : entries) add(e.row, e.column);
  });
}

}  // namespace

SparseSpd::SparseSpd(Index size, Index block, const std::vector<Entry>& entries,
                     const std::string& otherwise, Ordering ordering, const StopCheck& stop)
    : pattern_(std::make_unique<const SparsePattern>(pattern_of(size, block, entries))) {
  Vec values = Vec::Zero(pattern_->nonzeros());
  for (const Entry& e : entries) values[pattern_->slot(e.row, e.column)] += e.value;
  factorize(values, otherwise, ordering, stop);
}

SparseSpd::SparseSpd(SparsePattern pattern, const Vec& values, const std::string& otherwise,
                     const StopCheck& stop)
    : pattern_(std::make_unique<const SparsePattern>(std::move(pattern))) {
  factorize(values, otherwise, Ordering::Amd, stop);
}

void SparseSpd::factorize(const Vec& values, const std::string& otherwise, Ordering ordering,
                          const StopCheck& stop) {
  stop.poll();
  solver_ = make_direct_solver({.ordering = ordering});
  solver_->analyze(*pattern_);
  stop.poll();
  if (solver_->factorize_until(stop, values, 0.0) != FactorStatus::Ok)
    throw Error(ErrorKind::Infeasible, otherwise);
}

Vec SparseSpd::solve(const Vec& rhs) const {
  Vec x;
  solver_->solve(rhs, x);
  return x;
}

Vec SparseSpd::solution_entries(const DirectSolver::SparseColumn& rhs,
                                const std::vector<Index>& unknowns) const {
  return solver_->solution_entries(size(), rhs, unknowns);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
