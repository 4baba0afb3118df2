#include "majorant/framework/cholmod_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <string>
#include <vector>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/cholmod/internal/cholmod_matrix.h"
#include "majorant/framework/error.h"
#include "majorant/framework/internal/block_graph.h"
#include "majorant/framework/internal/block_ordering.h"
#include "majorant/framework/internal/one_blas_thread.h"

namespace majorant {
namespace {

// Supernodes are merged up to this many columns if at most 0.8, 0.1, 0.05 of the result are zeros
// (CHOLMOD's nrelax and zrelax). The values are twice CHOLMOD's defaults 4, 16, 48: factorizations
// of maps with 10K faces take 4 to 12 % less time. Larger zrelax or fewer columns gain nothing.
constexpr std::array<std::size_t, 3> kMergedColumns{8, 32, 96};

class CholmodSolver final : public LinearSolver {
 public:
  explicit CholmodSolver(CholmodOptions options) : options_(options) {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.quick_return_if_not_posdef = 1;
    common_.final_ll = 1;  // L L^T: L D L^T would accept negative pivots
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
    common_.supernodal = options.factor == CholmodOptions::Factor::Simplicial   ? CHOLMOD_SIMPLICIAL
                         : options.factor == CholmodOptions::Factor::Supernodal ? CHOLMOD_SUPERNODAL
                                                                                : CHOLMOD_AUTO;
    std::copy(kMergedColumns.begin(), kMergedColumns.end(), common_.nrelax);
  }
  ~CholmodSolver() override {
    forget();
    cholmod_finish(&common_);
  }
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  void analyze(const SparsePattern& pattern) override {
    require_valid(pattern);
    forget();
    pattern_ = &pattern;
    if (pattern.size == 0) return;
    const BlockGraph graph(pattern);
    const FillReducingOrder found = fill_reducing_order(graph, options_.ordering);
    std::vector<Index> order = order_of_unknowns(found.order, pattern);
    cholmod_sparse matrix = matrix_of(nullptr);
    factor_ = cholmod_analyze_p(&matrix, order.data(), nullptr, 0, &common_);
    require_success(factor_ != nullptr);
    entries_ = common_.lnz;
    description_ = fmt::format("CHOLMOD, {}, {}, {:.3g} factor nonzeros",
                               factor_->is_super ? "supernodal" : "simplicial",
                               name_of(found.method), entries_);
  }

  FactorStatus factorize(const Vec& values, double shift) override {
    require_size("LinearSolver::factorize: values", values.size(),
                 pattern_ ? pattern_->nonzeros() : 0);
    if (!factor_) return FactorStatus::Ok;
    cholmod_sparse matrix = matrix_of(values.data());
    double beta[2] = {shift, 0};
    const OneBlasThread one;
    const bool done = cholmod_factorize_p(&matrix, beta, nullptr, 0, factor_, &common_) != 0;
    if (common_.status == CHOLMOD_NOT_POSDEF) return FactorStatus::NotPositiveDefinite;
    require_success(done && common_.status >= CHOLMOD_OK);
    return factor_->minor == factor_->n && has_positive_diagonal()
               ? FactorStatus::Ok
               : FactorStatus::NotPositiveDefinite;
  }

  Solution solve(const Vec& r, Vec& p, double) override {
    require_size("LinearSolver::solve: r", r.size(), pattern_ ? pattern_->size : 0);
    p.resize(r.size());
    if (!factor_) return {};
    cholmod_dense b{};
    b.nrow = b.d = b.nzmax = to_size(pattern_->size);
    b.ncol = 1;
    b.x = const_cast<double*>(r.data());
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    const OneBlasThread one;
    require_success(cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &solution_, nullptr, &work_y_,
                                   &work_e_, &common_) != 0);
    p = Eigen::Map<const Vec>(static_cast<const double*>(solution_->x), p.size());
    return {};
  }

  std::size_t bytes() const override {
    if (!factor_) return 0;
    if (factor_->is_super)
      return (factor_->xsize + factor_->maxcsize) * sizeof(double) + factor_->ssize * sizeof(Index);
    return static_cast<std::size_t>(entries_) * (sizeof(double) + sizeof(Index));
  }
  std::string description() const override { return description_; }

 private:
  cholmod_sparse matrix_of(const double* values) const {
    return lower_triangle(pattern_->size, pattern_->column_starts, pattern_->rows, values);
  }

  // Returns whether the diagonal of L is positive and finite; CHOLMOD accepts numbers that are not.
  bool has_positive_diagonal() const {
    const auto* const x = static_cast<const double*>(factor_->x);
    const auto good = [](double d) { return d > 0 && std::isfinite(d); };
    if (!factor_->is_super) {
      const auto* const starts = static_cast<const Index*>(factor_->p);
      for (std::size_t c = 0; c < factor_->n; ++c)
        if (!good(x[starts[c]])) return false;
      return true;
    }
    const auto list = [](const void* values) { return static_cast<const Index*>(values); };
    const Index *columns = list(factor_->super), *rows = list(factor_->pi),
                *begin = list(factor_->px);
    for (std::size_t s = 0; s < factor_->nsuper; ++s)
      for (Index c = 0; c < columns[s + 1] - columns[s]; ++c)
        if (!good(x[begin[s] + c * (rows[s + 1] - rows[s] + 1)])) return false;
    return true;
  }

  void require_success(bool success) const {
    if (success) return;
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    if (common_.status == CHOLMOD_TOO_LARGE)
      throw Error(ErrorKind::Unsupported,
                  "CHOLMOD counts entries of a factor in 32 bits, and this one has more; use "
                  "make_direct_solver()");
    throw Error(ErrorKind::Invalid, fmt::format("CHOLMOD failed with status {}", common_.status));
  }

  void forget() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_dense(&solution_, &common_);
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
    pattern_ = nullptr;
    description_.clear();
  }

  CholmodOptions options_;
  const SparsePattern* pattern_ = nullptr;
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *solution_ = nullptr, *work_y_ = nullptr, *work_e_ = nullptr;
  double entries_ = 0;  // of the factor
  std::string description_;
};

}  // namespace

std::unique_ptr<LinearSolver> make_cholmod_solver(CholmodOptions options) {
  return std::make_unique<CholmodSolver>(options);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
