#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <cmath>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/linear_solver.h"

namespace majorant {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;

class EigenLdltSolver final : public LinearSolver {
 public:
  void analyze(const SparsePattern& pattern) override {
    require_valid(pattern);
    matrix_ = Eigen::Map<const Matrix>(pattern.size, pattern.size, pattern.nonzeros(),
                                       pattern.column_starts.data(), pattern.rows.data(),
                                       Vec::Ones(pattern.nonzeros()).eval().data());
    if (pattern.size == 0) return;
    ldlt_.analyzePattern(matrix_);
  }

  FactorStatus factorize(const Vec& values, double shift) override {
    require_size("LinearSolver::factorize: values", values.size(), matrix_.nonZeros());
    if (matrix_.rows() == 0) return FactorStatus::Ok;
    Eigen::Map<Vec>(matrix_.valuePtr(), matrix_.nonZeros()) = values;
    ldlt_.setShift(shift);
    ldlt_.factorize(matrix_);
    // Eigen stops only at pivots that are 0; negative pivots and NaN are tested here.
    if (ldlt_.info() != Eigen::Success) return FactorStatus::NotPositiveDefinite;
    for (const double pivot : Vec(ldlt_.vectorD()))
      if (!(pivot > 0) || !std::isfinite(pivot)) return FactorStatus::NotPositiveDefinite;
    return FactorStatus::Ok;
  }

  Solution solve(const Vec& r, Vec& p, double) override {
    require_size("LinearSolver::solve: r", r.size(), matrix_.rows());
    if (r.size() == 0)
      p.resize(0);
    else
      p = ldlt_.solve(r);
    return {};
  }

  std::size_t bytes() const override {
    const auto entries = ldlt_.matrixL().nestedExpression().nonZeros();
    return static_cast<std::size_t>(entries) * (sizeof(double) + sizeof(Index));
  }

  std::string description() const override {
    return fmt::format("Eigen LDLT, AMD, {} nonzeros", matrix_.nonZeros());
  }

 private:
  Matrix matrix_;  // lower triangle
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<Index>> ldlt_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_eigen_ldlt_solver() {
  return std::make_unique<EigenLdltSolver>();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
