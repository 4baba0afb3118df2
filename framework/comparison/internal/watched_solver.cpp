#include "majorant/framework/comparison/internal/watched_solver.h"

#include <utility>

#include "majorant/framework/stopwatch.h"

namespace majorant {
namespace {

class WatchedSolver final : public LinearSolver {
 public:
  WatchedSolver(std::shared_ptr<LinearSolver> solver, std::shared_ptr<SolverUse> use)
      : solver_(std::move(solver)), use_(std::move(use)) {}

  void analyze(const SparsePattern& pattern) override {
    const AddedSeconds timed(use_->factorize_seconds);
    solver_->analyze(pattern);
  }
  void hint_near_null_space(Eigen::MatrixXd vectors) override {
    solver_->hint_near_null_space(std::move(vectors));
  }
  FactorStatus factorize(const Vec& values, double shift) override {
    return factorize_until({}, values, shift);
  }
  FactorStatus factorize_until(const StopCheck& stop, const Vec& values, double shift) override {
    const AddedSeconds timed(use_->factorize_seconds);
    ++use_->factorizations;
    return solver_->factorize_until(stop, values, shift);
  }
  Solution solve(const Vec& r, Vec& p, double tolerance) override {
    const AddedSeconds timed(use_->solve_seconds);
    return solver_->solve(r, p, tolerance);
  }
  std::size_t bytes() const override { return solver_->bytes(); }
  std::string description() const override { return solver_->description(); }

 private:
  std::shared_ptr<LinearSolver> solver_;
  std::shared_ptr<SolverUse> use_;
};

}  // namespace

SolverFactory watched_solver(SolverFactory factory, std::shared_ptr<SolverUse> use) {
  return [factory = std::move(factory), use = std::move(use)] {
    return std::make_shared<WatchedSolver>(factory(), use);
  };
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
