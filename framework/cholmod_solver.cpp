#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <vector>

#include "majorant/framework/internal/foreign_code.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/thread_count.h"

namespace majorant {
namespace {

class CholmodSolver final : public LinearSolver {
 public:
  CholmodSolver(Factorization factorization, Ordering ordering) : ordering_(ordering) {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.quick_return_if_not_posdef = 1;
    common_.supernodal = factorization == Factorization::Automatic    ? CHOLMOD_AUTO
                         : factorization == Factorization::Supernodal ? CHOLMOD_SUPERNODAL
                                                                      : CHOLMOD_SIMPLICIAL;
    common_.final_ll = 1;
  }
  ~CholmodSolver() override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_dense(&solution_, &common_);
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
    cholmod_finish(&common_);
  }
  CholmodSolver(const CholmodSolver&) = delete;
  CholmodSolver& operator=(const CholmodSolver&) = delete;

  void analyze(const SparsePattern& pattern) override;
  FactorStatus factorize(const Vec& values, double shift) override;
  void solve(const Vec& r, Vec& p) override;
  std::string description() const override { return description_; }

 private:
  cholmod_sparse view(const double* values) const;
  bool order_by_metis(cholmod_sparse& blocks, std::vector<Index>& order);
  cholmod_factor* analyze_with(const char* name, const std::vector<Index>& permutation);

  const SparsePattern* pattern_ = nullptr;
  Ordering ordering_;
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *solution_ = nullptr, *work_y_ = nullptr, *work_e_ = nullptr;
  double operations_ = 0, factor_nonzeros_ = 0;
  std::string description_;
};

// The graph whose nodes are the pattern's blocks, as the lower triangle of a symmetric matrix.
struct BlockGraph {
  Index blocks = 0;
  std::vector<Index> starts, rows;

  explicit BlockGraph(const SparsePattern& p) {
    std::vector<std::vector<Index>> columns_of;
    for (const Index b : p.block_of) blocks = std::max(blocks, b + 1);
    columns_of.resize(at(blocks));
    for (Index c = 0; c < p.size; ++c) columns_of[at(p.block_of[at(c)])].push_back(c);
    std::vector<std::vector<Index>> lower(at(blocks));
    for (Index c = 0; c < p.size; ++c) {
      const Index b = p.block_of[at(c)];
      for (Index k = p.column_starts[at(c)]; k < p.column_starts[at(c) + 1]; ++k) {
        const Index r = p.block_of[at(p.rows[at(k)])];
        if (r != b) lower[at(std::min(r, b))].push_back(std::max(r, b));
      }
    }
    starts.push_back(0);
    for (auto& column : lower) {
      std::sort(column.begin(), column.end());
      column.erase(std::unique(column.begin(), column.end()), column.end());
      rows.insert(rows.end(), column.begin(), column.end());
      starts.push_back(static_cast<Index>(rows.size()));
    }
  }
};

cholmod_sparse sparse_view(Index size, const std::vector<Index>& starts,
                           const std::vector<Index>& rows, const double* values) {
  cholmod_sparse m{};
  m.nrow = m.ncol = at(size);
  m.nzmax = rows.size();
  m.p = const_cast<Index*>(starts.data());
  m.i = const_cast<Index*>(rows.data());
  m.x = const_cast<double*>(values);
  m.stype = -1;
  m.itype = CHOLMOD_INT;
  m.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  m.dtype = CHOLMOD_DOUBLE;
  m.sorted = m.packed = 1;
  return m;
}

std::vector<Index> lift(const std::vector<Index>& block_permutation, const SparsePattern& p) {
  std::vector<Index> position(block_permutation.size());
  for (std::size_t k = 0; k < block_permutation.size(); ++k)
    position[at(block_permutation[k])] = static_cast<Index>(k);
  std::vector<Index> permutation(at(p.size));
  for (Index i = 0; i < p.size; ++i) permutation[at(i)] = i;
  std::stable_sort(permutation.begin(), permutation.end(), [&](Index a, Index b) {
    return position[at(p.block_of[at(a)])] < position[at(p.block_of[at(b)])];
  });
  return permutation;
}

cholmod_sparse CholmodSolver::view(const double* values) const {
  return sparse_view(pattern_->size, pattern_->column_starts, pattern_->rows, values);
}

cholmod_factor* CholmodSolver::analyze_with(const char* name,
                                            const std::vector<Index>& permutation) {
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_GIVEN;
  common_.postorder = 1;
  cholmod_sparse matrix = view(nullptr);
  cholmod_factor* factor =
      cholmod_analyze_p(&matrix, const_cast<Index*>(permutation.data()), nullptr, 0, &common_);
  if (!factor) throw std::bad_alloc();
  operations_ = common_.fl;
  factor_nonzeros_ = common_.lnz;
  description_ = fmt::format("{}, {}, {:.3g} factor nonzeros, {:.3g} operations",
                             factor->is_super ? "supernodal" : "simplicial", name, factor_nonzeros_,
                             operations_);
  return factor;
}

bool CholmodSolver::order_by_metis(cholmod_sparse& blocks, std::vector<Index>& order) {
  const MetisScope scope;
  return cholmod_metis(&blocks, nullptr, 0, 1, order.data(), &common_);
}

void CholmodSolver::analyze(const SparsePattern& pattern) {
  const ThreadCount alone(1);
  pattern_ = &pattern;
  cholmod_free_factor(&factor_, &common_);
  if (pattern.size == 0) return;
  const BlockGraph graph(pattern);
  cholmod_sparse blocks = sparse_view(graph.blocks, graph.starts, graph.rows, nullptr);
  std::vector<Index> order(at(graph.blocks));
  if (ordering_ != Ordering::Metis && cholmod_amd(&blocks, nullptr, 0, order.data(), &common_))
    factor_ = analyze_with("AMD", lift(order, pattern));
  if (ordering_ != Ordering::Amd && order_by_metis(blocks, order)) {
    const double amd_operations = operations_;
    const std::string amd_description = description_;
    cholmod_factor* metis = analyze_with("METIS", lift(order, pattern));
    if (factor_ && amd_operations <= operations_) {
      cholmod_free_factor(&metis, &common_);
      description_ = amd_description;
    } else {
      cholmod_free_factor(&factor_, &common_);
      factor_ = metis;
    }
  }
  if (!factor_) throw std::bad_alloc();
}

FactorStatus CholmodSolver::factorize(const Vec& values, double shift) {
  if (pattern_->size == 0) return FactorStatus::Ok;
  require_blas();
  const ThreadCount alone(1);
  cholmod_sparse matrix = view(values.data());
  double beta[2] = {shift, 0};
  cholmod_factorize_p(&matrix, beta, nullptr, 0, factor_, &common_);
  if (common_.status == CHOLMOD_NOT_POSDEF) return FactorStatus::NotPositiveDefinite;
  if (common_.status < CHOLMOD_OK) throw std::bad_alloc();
  return factor_->minor == factor_->n ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
}

void CholmodSolver::solve(const Vec& r, Vec& p) {
  p.resize(r.size());
  if (r.size() == 0) return;
  const ThreadCount alone(1);
  cholmod_dense rhs{};
  rhs.nrow = rhs.d = rhs.nzmax = static_cast<std::size_t>(r.size());
  rhs.ncol = 1;
  rhs.x = const_cast<double*>(r.data());
  rhs.xtype = CHOLMOD_REAL;
  rhs.dtype = CHOLMOD_DOUBLE;
  if (!cholmod_solve2(CHOLMOD_A, factor_, &rhs, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                      &common_))
    throw std::bad_alloc();
  p = Eigen::Map<const Vec>(static_cast<const double*>(solution_->x), r.size());
}

}  // namespace

std::unique_ptr<LinearSolver> make_cholmod_solver(Factorization factorization, Ordering ordering) {
  return std::make_unique<CholmodSolver>(factorization, ordering);
}

}  // namespace majorant
