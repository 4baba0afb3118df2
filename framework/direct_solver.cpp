#include "majorant/framework/internal/direct_solver.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <utility>

#include "majorant/framework/internal/argument_check.h"
#include "majorant/framework/internal/block_graph.h"
#include "majorant/framework/internal/block_ordering.h"
#include "majorant/framework/internal/extended_elimination.h"
#include "majorant/framework/internal/multifrontal.h"
#include "majorant/framework/internal/symbolic_analysis.h"

namespace majorant {
namespace {

// Blocks from which METIS pays for ten factorizations. Origin: ms more to order and less to
// factorize than with AMD: 10K faces 15 and 0.3, 50K 110 and 3, 160K (80K blocks) 380 and 52.
constexpr Index kMetisBlocks = 75000;

// Patterns that differ from the last one by at most so many edges for each block keep its ordering,
// as long as the factor needs at most so many times the operations. Origin: bijective runs at 10K
// faces, where flips of edges come between two factorizations; CPU ms of helix and koala with 1.0,
// 1.25, 1.6, 2.2 times: 992 340, 915 312, 890 324, 886 317. So many edges never came.
constexpr double kFewEdges = 0.1, kMoreOperations = 1.6;

class DirectSolver final : public LinearSolver {
 public:
  DirectSolver(Ordering ordering, InsteadOfFactor instead)
      : ordering_(ordering), instead_(std::move(instead)) {}

  void analyze(const SparsePattern& pattern) override {
    require_valid(pattern);
    other_.reset();
    factor_.reset();
    tree_.reset();
    size_ = pattern.size;
    nonzeros_ = pattern.nonzeros();
    if (pattern.size == 0) return;
    make_tree(pattern);
    factor_ = std::make_unique<MultifrontalFactor>(*tree_);
    if (instead_) other_ = instead_({factor_->bytes(), pattern.rows.size()});
    if (!other_) return describe();
    factor_.reset();
    tree_.reset();
    last_graph_.reset();
    elimination_ = {};
    other_->analyze(pattern);
  }
  FactorStatus factorize(const Vec& values, double shift) override {
    require_size("LinearSolver::factorize: values", values.size(), nonzeros_);
    if (other_) return other_->factorize(values, shift);
    return !factor_ || factor_->factorize(values, shift) ? FactorStatus::Ok
                                                         : FactorStatus::NotPositiveDefinite;
  }
  Solution solve(const Vec& r, Vec& p, double tolerance) override {
    require_size("LinearSolver::solve: r", r.size(), size_);
    if (other_) return other_->solve(r, p, tolerance);
    if (factor_)
      factor_->solve(r, p);
    else
      p.resize(r.size());
    return {};
  }
  std::string description() const override { return other_ ? other_->description() : description_; }

 private:
  void make_tree(const SparsePattern& pattern) {
    BlockGraph graph(pattern);
    extended_ = extend_last(pattern, graph);
    if (!extended_) {
      last_graph_.reset();
      order(pattern, graph);
    }
    last_graph_ = std::move(graph);
  }

  void order(const SparsePattern& pattern, const BlockGraph& graph) {
    chosen_ = ordering_ != Ordering::Automatic ? ordering_
              : graph.size() < kMetisBlocks    ? Ordering::Amd
                                               : Ordering::Metis;
    elimination_ =
        analyze_elimination(graph, chosen_ == Ordering::Metis ? nested_dissection_order(graph)
                                                              : minimum_degree_order(graph));
    tree_ = std::make_unique<const FrontTree>(pattern, elimination_);
    fresh_operations_ = tree_->operations();
  }

  // With the last ordering, if that is worth it.
  bool extend_last(const SparsePattern& pattern, const BlockGraph& graph) {
    if (!last_graph_ || last_graph_->size() != graph.size()) return false;
    const BlockEdges edges = graph.edges_beyond(*last_graph_);
    if (static_cast<double>(edges.size()) > kFewEdges * graph.size()) return false;
    elimination_ = extended_elimination(elimination_, edges);
    tree_ = std::make_unique<const FrontTree>(pattern, elimination_);
    return tree_->operations() <= kMoreOperations * fresh_operations_;
  }

  void describe() {
    description_ = fmt::format("multifrontal, {}, {}{}, {:.3g} factor nonzeros, {:.3g} operations",
                               front_kernels().name, chosen_ == Ordering::Metis ? "METIS" : "AMD",
                               extended_ ? " of an earlier pattern" : "", tree_->nonzeros(),
                               tree_->operations());
  }

  Ordering ordering_, chosen_ = Ordering::Amd;
  InsteadOfFactor instead_;
  Index size_ = 0, nonzeros_ = 0;
  std::optional<BlockGraph> last_graph_;
  BlockElimination elimination_;  // of it
  bool extended_ = false;         // made for another one
  double fresh_operations_ = 0;   // with its own ordering
  std::unique_ptr<const FrontTree> tree_;
  std::unique_ptr<MultifrontalFactor> factor_;
  std::unique_ptr<LinearSolver> other_;  // solves, if there is one
  std::string description_;
};

}  // namespace

std::string_view vector_instructions() { return front_kernels().name; }

std::unique_ptr<LinearSolver> make_direct_solver(Ordering ordering) {
  return make_direct_solver(ordering, {});
}

std::unique_ptr<LinearSolver> make_direct_solver(Ordering ordering, InsteadOfFactor instead) {
  return std::make_unique<DirectSolver>(ordering, std::move(instead));
}

FactorSize factor_size(const SparsePattern& pattern, Ordering ordering) {
  FactorSize size;
  DirectSolver(ordering, [&](const FactorSize& needed) {
    size = needed;
    return nullptr;
  }).analyze(pattern);
  return size;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
