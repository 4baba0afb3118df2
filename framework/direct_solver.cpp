#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/internal/block_graph.h"
#include "majorant/framework/internal/block_ordering.h"
#include "majorant/framework/internal/multifrontal.h"
#include "majorant/framework/internal/symbolic_analysis.h"
#include "majorant/framework/internal/symbolic_update.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/parallel.h"
#include "majorant/framework/pattern_analysis.h"

namespace majorant {

struct PatternAnalysis::Parts {
  BlockGraph graph;
  Ordering chosen = Ordering::Amd;
  BlockElimination elimination;
  std::unique_ptr<const AssemblyTree> tree;

  Parts(const SparsePattern& pattern, BlockGraph of_it, Ordering method) : graph(std::move(of_it)) {
    FillReducingOrder found = fill_reducing_order(graph, method);
    chosen = found.method;
    elimination = analyze_elimination(graph, std::move(found.order));
    tree = std::make_unique<const AssemblyTree>(pattern, elimination);
  }
};

PatternAnalysis::PatternAnalysis(const SparsePattern& pattern, Ordering ordering)
    : pattern_(&pattern),
      ordering_(ordering),
      parts_(std::make_shared<Parts>(pattern, BlockGraph(pattern), ordering)) {}

PatternAnalysis::~PatternAnalysis() = default;

std::shared_ptr<PatternAnalysis::Parts> PatternAnalysis::take(const SparsePattern& pattern,
                                                              Ordering ordering) {
  return &pattern == pattern_ && ordering == ordering_ ? std::move(parts_) : nullptr;
}

namespace {

// A pattern keeps the ordering of the last one if it differs by at most kFewEdges edges a block,
// and the factor takes at most kMoreOperations times the operations. In bijective runs, which flip
// edges between factorizations, larger values save no more time.
constexpr double kFewEdges = 0.1, kMoreOperations = 1.6;

bool same(const SparsePattern& a, const SparsePattern& b) {
  return a.size == b.size && a.column_starts == b.column_starts && a.rows == b.rows &&
         a.block_of == b.block_of;
}

// Rows with entries in more than this part of the columns are multiplied as dense rows.
constexpr double kFullRow = 1.0 / 4;
// The products of this many dense rows are added at a time, so that the sums are read and written
// less often.
constexpr Eigen::Index kRowsAtATime = 4;

// Adds the sum of the products y^T y of these rows y to a symmetric matrix. The order of the rows
// is fixed, so that the result is the same, bit for bit, on all machines.
void add_products_of_rows(const std::vector<DirectSolver::SparseColumn>& rows,
                          Eigen::MatrixXd& products) {
  const Eigen::Index count = products.cols();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(count, kRowsAtATime);
  Eigen::Index waiting = 0;
  const auto add_full = [&] {
    for (Eigen::Index k = 0; k < count; ++k) {
      const double a = full(k, 0), b = full(k, 1), c = full(k, 2), d = full(k, 3);
      for (Eigen::Index i = k; i < count; ++i)
        products(i, k) += (a * full(i, 0) + b * full(i, 1)) + (c * full(i, 2) + d * full(i, 3));
    }
    full.setZero();
    waiting = 0;
  };
  for (const DirectSolver::SparseColumn& row : rows) {
    if (static_cast<double>(row.size()) > kFullRow * static_cast<double>(count)) {
      for (const auto& [k, value] : row) full(k, waiting) = value;
      if (++waiting == kRowsAtATime) add_full();
      continue;
    }
    for (auto one = row.begin(); one != row.end(); ++one)
      for (auto other = one; other != row.end(); ++other)
        products(other->first, one->first) += one->second * other->second;
  }
  if (waiting > 0) add_full();
  products.triangularView<Eigen::StrictlyUpper>() = products.transpose();
}

class MultifrontalSolver final : public DirectSolver {
 public:
  explicit MultifrontalSolver(const DirectSolverOptions& options)
      : ordering_(options.ordering),
        analysis_(options.analysis),
        threads_(options.threads),
        large_factor_(options.large_factor) {}

  void analyze(const SparsePattern& pattern) override {
    // The pattern is analysed already if bytes() was needed to choose this solver.
    if (analysed_ && same(*analysed_, pattern)) return;
    require_valid(pattern);
    analysed_.reset();
    FactorMemory memory = factor_ ? factor_->release() : FactorMemory();
    factor_.reset();
    tree_.reset();
    size_ = pattern.size;
    nonzeros_ = pattern.nonzeros();
    if (pattern.size == 0) return;
    const ThreadCount threads(threads_);
    make_tree(pattern);
    factor_ = std::make_unique<MultifrontalFactor>(*tree_, front_kernels(), std::move(memory),
                                                   large_factor_);
    describe();
    analysed_ = pattern;
  }
  FactorStatus factorize(const Vec& values, double shift) override {
    return factorize_until({}, values, shift);
  }
  FactorStatus factorize_until(const StopCheck& stop, const Vec& values, double shift) override {
    require_size("LinearSolver::factorize: values", values.size(), nonzeros_);
    analysed_.reset();
    const bool is_positive = !factor_ || factor_->factorize(values, shift, stop);
    return is_positive ? FactorStatus::Ok : FactorStatus::NotPositiveDefinite;
  }
  Solution solve(const Vec& r, Vec& p, double) override {
    require_size("LinearSolver::solve: r", r.size(), size_);
    if (factor_)
      factor_->solve(r, p);
    else
      p.resize(r.size());
    return {};
  }
  // The nonzeros of L^-1 P R, row by row.
  Eigen::MatrixXd inverse_products(Index size, const std::vector<SparseColumn>& columns,
                                   const StopCheck& stop) override {
    require_size("DirectSolver::inverse_products: size", size, size_);
    const auto count = static_cast<Index>(columns.size());
    Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count);
    if (!factor_) return products;
    std::vector<SparseColumn> halves(to_size(size));  // by row: columns and values
    Vec r = Vec::Zero(size), y;
    for (Index k = 0; k < count; ++k) {
      stop.poll();
      stop.advance(to_size(k), to_size(count));
      for (const auto& [unknown, value] : columns[k]) r[unknown] += value;
      factor_->half_solve(r, y);
      for (const auto& [unknown, value] : columns[k]) r[unknown] = 0;
      for (Index u = 0; u < size; ++u)
        if (y[u] != 0) halves[u].emplace_back(k, y[u]);
    }
    add_products_of_rows(halves, products);
    return products;
  }
  Vec solution_entries(Index size, const SparseColumn& r,
                       const std::vector<Index>& unknowns) override {
    require_size("DirectSolver::solution_entries: size", size, size_);
    Vec entries;
    if (factor_) factor_->solve_entries(r, unknowns, entries);
    return entries;
  }
  std::size_t bytes() const override { return factor_ ? factor_->bytes() : 0; }
  std::string description() const override { return description_; }

 private:
  using Analysis = PatternAnalysis::Parts;

  void make_tree(const SparsePattern& pattern) {
    if (const auto given = std::exchange(analysis_, nullptr))
      if (const auto found = given->take(pattern, ordering_)) return adopt(std::move(*found));
    BlockGraph graph(pattern);
    extended_ = extend_last(pattern, graph);
    if (extended_) {
      last_graph_ = std::move(graph);
    } else {
      last_graph_.reset();
      elimination_ = {};
      tree_.reset();
      adopt(Analysis(pattern, std::move(graph), ordering_));
    }
  }

  void adopt(Analysis&& found) {
    extended_ = false;
    chosen_ = found.chosen;
    tree_ = std::move(found.tree);
    fresh_operations_ = tree_->operations();
    // The graph for the next pattern takes memory. Large patterns change only around an image, and
    // their solver chooses the ordering itself.
    last_graph_.reset();
    elimination_ = {};
    if (ordering_ == Ordering::Automatic && tree_->factor_size() * sizeof(double) >= large_factor_)
      return;
    last_graph_ = std::move(found.graph);
    elimination_ = std::move(found.elimination);
  }

  // Extends the last ordering, if that is worth it.
  bool extend_last(const SparsePattern& pattern, const BlockGraph& graph) {
    if (!last_graph_ || last_graph_->size() != graph.size()) return false;
    const BlockEdges edges = graph.edges_beyond(*last_graph_);
    if (static_cast<double>(edges.size()) > kFewEdges * graph.size()) return false;
    elimination_ = symbolic_update(elimination_, edges);
    tree_ = std::make_unique<const AssemblyTree>(pattern, elimination_);
    return tree_->operations() <= kMoreOperations * fresh_operations_;
  }

  void describe() {
    description_ = fmt::format("multifrontal, {}, {}{}, {:.3g} factor nonzeros, {:.3g} operations",
                               front_kernels().name, name_of(chosen_),
                               extended_ ? " of an earlier pattern" : "", tree_->nonzeros(),
                               tree_->operations());
  }

  Ordering ordering_, chosen_ = Ordering::Amd;
  std::shared_ptr<PatternAnalysis> analysis_;  // until the first pattern is analysed
  int threads_;
  std::size_t large_factor_;
  Index size_ = 0, nonzeros_ = 0;
  std::optional<SparsePattern> analysed_;  // and not factorized yet
  std::optional<BlockGraph> last_graph_;
  BlockElimination elimination_;  // of last_graph_
  bool extended_ = false;         // the ordering is that of an earlier pattern
  double fresh_operations_ = 0;   // of the last new ordering
  std::unique_ptr<const AssemblyTree> tree_;
  std::unique_ptr<MultifrontalFactor> factor_;
  std::string description_;
};

}  // namespace

std::string_view vector_instructions() { return front_kernels().name; }

std::unique_ptr<DirectSolver> make_direct_solver(const DirectSolverOptions& options) {
  return std::make_unique<MultifrontalSolver>(options);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
