// A linear solver that counts its calls: the oracle of the counts in records.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/linear_solver.h"
#include "majorant/framework/run_record.h"

namespace majorant::test {

struct SolverCounts {
  int analyses = 0, factorizations = 0, failed = 0, solves = 0;
};

class CountingSolver final : public LinearSolver {
 public:
  CountingSolver(std::unique_ptr<LinearSolver> solver, std::shared_ptr<SolverCounts> counts)
      : solver_(std::move(solver)), counts_(std::move(counts)) {}
  void analyze(const SparsePattern& pattern) override {
    ++counts_->analyses;
    solver_->analyze(pattern);
  }
  FactorStatus factorize(const Vec& values, double shift) override {
    const FactorStatus status = solver_->factorize(values, shift);
    ++counts_->factorizations;
    counts_->failed += status != FactorStatus::Ok;
    return status;
  }
  Solution solve(const Vec& r, Vec& p, double tolerance) override {
    ++counts_->solves;
    return solver_->solve(r, p, tolerance);
  }
  std::string description() const override { return solver_->description(); }

 private:
  std::unique_ptr<LinearSolver> solver_;
  std::shared_ptr<SolverCounts> counts_;
};

// Returns a factory for NewtonOptions::linear_solver and similar options.
inline std::function<std::unique_ptr<LinearSolver>()> counting(
    std::shared_ptr<SolverCounts> counts) {
  return [counts] { return std::make_unique<CountingSolver>(make_direct_solver(), counts); };
}

// Returns the sums of the counters of factorizations in records.
inline SolverCounts recorded(const std::vector<IterationRecord>& records) {
  SolverCounts sum;
  for (const IterationRecord& r : records) {
    sum.factorizations += r.factorizations;
    sum.failed += r.failed_factorizations;
  }
  return sum;
}

}  // namespace majorant::test

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
