#include "unit_fe.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

#include "majorant/framework/cholmod/internal/cholmod_matrix.h"
#include "majorant/framework/internal/one_blas_thread.h"

namespace majorant {
namespace {

// Makes the graph whose nodes are the pattern's blocks.
void block_graph(const SparsePattern& p, std::vector<Index>& starts, std::vector<Index>& rows) {
  std::vector<std::vector<Index>> lower(to_size(p.block_of.back()) + 1);
  for (Index c = 0; c < p.size; ++c)
    for (Index k = p.column_starts[c]; k < p.column_starts[c + 1]; ++k) {
      const Index a = p.block_of[c], b = p.block_of[p.rows[k]];
      if (a != b) lower[std::min(a, b)].push_back(std::max(a, b));
    }
  starts.assign(1, 0);
  for (auto& column : lower) {
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    rows.insert(rows.end(), column.begin(), column.end());
    starts.push_back(static_cast<Index>(rows.size()));
  }
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

// Operations per entry of the factor above which simplicial factorizations are left out. This is
// seven times CHOLMOD's own threshold; there they take more than twice as long.
constexpr double kTooDense = 280;

class Reference {
 public:
  explicit Reference(int supernodal) {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.quick_return_if_not_posdef = 1;
    common_.supernodal = supernodal;
    common_.final_ll = 1;
  }
  ~Reference() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_dense(&solution_, &common_);
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
    cholmod_finish(&common_);
  }
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  void analyze(const SparsePattern& pattern, int ordering) {
    std::vector<Index> starts, rows;
    block_graph(pattern, starts, rows);
    std::vector<Index> order(starts.size() - 1);
    cholmod_sparse graph = lower_triangle(static_cast<Index>(order.size()), starts, rows, nullptr);
    const int ordered = ordering == CHOLMOD_AMD
                            ? cholmod_amd(&graph, nullptr, 0, order.data(), &common_)
                            : cholmod_metis(&graph, nullptr, 0, 1, order.data(), &common_);
    if (!ordered) throw std::runtime_error("unit fe: no ordering");
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
    cholmod_sparse matrix =
        lower_triangle(pattern.size, pattern.column_starts, pattern.rows, nullptr);
    factor_ =
        cholmod_analyze_p(&matrix, order_of_unknowns(order, pattern).data(), nullptr, 0, &common_);
    if (!factor_) throw std::runtime_error("unit fe: no analysis");
  }

  double operations_per_entry() const { return common_.fl / common_.lnz; }

  void factorize_and_solve(const SparsePattern& pattern, const Vec& values, const Vec& rhs) {
    cholmod_sparse matrix =
        lower_triangle(pattern.size, pattern.column_starts, pattern.rows, values.data());
    double beta[2] = {0, 0};
    {
      const OneBlasThread alone;
      cholmod_factorize_p(&matrix, beta, nullptr, 0, factor_, &common_);
    }
    if (common_.status != CHOLMOD_OK) throw std::runtime_error("unit fe: no factorization");
    cholmod_dense b{};
    b.nrow = b.d = b.nzmax = to_size(pattern.size);
    b.ncol = 1;
    b.x = const_cast<double*>(rhs.data());
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    const OneBlasThread alone;
    if (!cholmod_solve2(CHOLMOD_A, factor_, &b, nullptr, &solution_, nullptr, &work_y_, &work_e_,
                        &common_))
      throw std::runtime_error("unit fe: no solution");
  }

 private:
  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense *solution_ = nullptr, *work_y_ = nullptr, *work_e_ = nullptr;
};

}  // namespace

UnitFe measure_unit_fe(const SparsePattern& pattern, const Vec& values, const Vec& rhs,
                       int repeats) {
  const struct {
    const char* name;
    int supernodal, ordering;
  } kinds[] = {{"supernodal AMD", CHOLMOD_SUPERNODAL, CHOLMOD_AMD},
               {"supernodal METIS", CHOLMOD_SUPERNODAL, CHOLMOD_METIS},
               {"simplicial AMD", CHOLMOD_SIMPLICIAL, CHOLMOD_AMD},
               {"simplicial METIS", CHOLMOD_SIMPLICIAL, CHOLMOD_METIS}};
  UnitFe unit;
  for (std::size_t k = 0; k < unit.variants.size(); ++k) {
    Reference reference(kinds[k].supernodal);
    reference.analyze(pattern, kinds[k].ordering);
    if (kinds[k].supernodal == CHOLMOD_SIMPLICIAL && reference.operations_per_entry() > kTooDense) {
      unit.variants[k] = {kinds[k].name, std::numeric_limits<double>::infinity()};
      continue;
    }
    reference.factorize_and_solve(pattern, values, rhs);  // allocates memory before the timed calls
    std::vector<double> seconds;
    for (int repeat = 0; repeat < repeats; ++repeat) {
      const double started = cpu_seconds();
      reference.factorize_and_solve(pattern, values, rhs);
      seconds.push_back(cpu_seconds() - started);
    }
    unit.variants[k] = {kinds[k].name, median(seconds)};
    if (k == 0 || unit.variants[k].seconds < unit.seconds) unit.seconds = unit.variants[k].seconds;
  }
  return unit;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
