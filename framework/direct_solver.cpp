#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/internal/argument_check.h"
#include "majorant/framework/internal/extended_elimination.h"
#include "majorant/framework/internal/foreign_code.h"
#include "majorant/framework/internal/multifrontal.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/thread_count.h"

namespace majorant {
namespace {

// Groups of at most so many blocks are merged whatever it costs, if it costs little, and very
// little (CHOLMOD's nrelax). Origin: bench/solver_cost --no-runs, factorization of spot, hand,
// scorpion and helix at 10K faces: 0.22, 0.24, 0.17, 0.25 fe; CHOLMOD's own 4, 16, 48 are 0.24,
// 0.27, 0.21, 0.32, and 16, 48, 128 are 0.39, 0.41, 0.38, 0.69.
constexpr std::array<std::size_t, 3> kRelaxedBlocks{4, 8, 16};

// Blocks from which METIS pays for ten factorizations. Origin: ms more to order and less to
// factorize than with AMD: 10K faces 15 and 0.3, 50K 110 and 3, 160K (80K blocks) 380 and 52.
constexpr Index kMetisBlocks = 75000;

// Patterns that differ from the last one by at most so many edges for each block keep its ordering,
// as long as the factor needs at most so many times the operations. Origin: bijective runs at 10K
// faces, where flips of edges come between two factorizations; CPU ms of helix and koala with 1.0,
// 1.25, 1.6, 2.2 times: 992 340, 915 312, 890 324, 886 317. So many edges never came.
constexpr double kFewEdges = 0.1, kMoreOperations = 1.6;

// The graph whose nodes are the pattern's blocks: lower triangle, by columns.
struct BlockGraph {
  std::vector<Index> starts, rows;

  explicit BlockGraph(const SparsePattern& p) {
    Index blocks = 0;
    for (const Index b : p.block_of) blocks = std::max(blocks, b + 1);
    std::vector<std::size_t> place(at(blocks) + 1, 0);
    const auto visit = [&](const auto& use) {
      for (Index c = 0; c < p.size; ++c)
        for (Index k = p.column_starts[at(c)]; k < p.column_starts[at(c) + 1]; ++k) {
          const Index a = p.block_of[at(c)], b = p.block_of[at(p.rows[at(k)])];
          if (a != b) use(std::min(a, b), std::max(a, b));
        }
    };
    visit([&](Index column, Index) { ++place[at(column) + 1]; });
    for (std::size_t b = 1; b < place.size(); ++b) place[b] += place[b - 1];
    std::vector<Index> all(place.back()), seen(at(blocks), -1);
    std::vector<std::size_t> next(place);
    visit([&](Index column, Index row) { all[next[at(column)]++] = row; });
    starts.push_back(0);
    for (Index b = 0; b < blocks; ++b) {
      for (std::size_t k = place[at(b)]; k < place[at(b) + 1]; ++k)
        if (seen[at(all[k])] != b) {
          seen[at(all[k])] = b;
          rows.push_back(all[k]);
        }
      starts.push_back(static_cast<Index>(rows.size()));
    }
  }
  Index size() const { return static_cast<Index>(starts.size()) - 1; }

  // That another graph of as many nodes does not have.
  BlockEdges edges_beyond(const BlockGraph& other) const {
    BlockEdges edges;
    std::vector<Index> seen(at(size()), -1);
    for (Index b = 0; b < size(); ++b) {
      for (const Index row : other.column(b)) seen[at(row)] = b;
      for (const Index row : column(b))
        if (seen[at(row)] != b) edges.push_back({b, row});
    }
    return edges;
  }

 private:
  std::span<const Index> column(Index b) const {
    return {rows.data() + starts[at(b)], rows.data() + starts[at(b) + 1]};
  }
};

class Cholmod {
 public:
  Cholmod() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.error_handler = nullptr;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
    std::copy(kRelaxedBlocks.begin(), kRelaxedBlocks.end(), common_.nrelax);
  }
  ~Cholmod() { cholmod_finish(&common_); }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  std::vector<Index> order(const BlockGraph& graph, Ordering ordering) {
    cholmod_sparse matrix = view(graph);
    std::vector<Index> order(at(graph.size()));
    if (ordering == Ordering::Metis) {
      const MetisScope scope;
      require(cholmod_metis(&matrix, nullptr, 0, 1, order.data(), &common_));
    } else {
      require(cholmod_amd(&matrix, nullptr, 0, order.data(), &common_));
    }
    return order;
  }

  BlockElimination eliminate(const BlockGraph& graph, std::vector<Index> order) {
    cholmod_sparse matrix = view(graph);
    cholmod_factor* factor = cholmod_analyze_p(&matrix, order.data(), nullptr, 0, &common_);
    require(factor != nullptr);
    const auto* permutation = static_cast<const Index*>(factor->Perm);
    const auto* super = static_cast<const Index*>(factor->super);
    const auto* starts = static_cast<const Index*>(factor->pi);
    const auto* rows = static_cast<const Index*>(factor->s);
    BlockElimination elimination{{permutation, permutation + factor->n},
                                 {super, super + factor->nsuper + 1},
                                 {starts, starts + factor->nsuper + 1},
                                 {rows, rows + starts[factor->nsuper]}};
    cholmod_free_factor(&factor, &common_);
    return elimination;
  }

 private:
  static cholmod_sparse view(const BlockGraph& graph) {
    cholmod_sparse m{};
    m.nrow = m.ncol = at(graph.size());
    m.nzmax = graph.rows.size();
    m.p = const_cast<Index*>(graph.starts.data());
    m.i = const_cast<Index*>(graph.rows.data());
    m.stype = -1;
    m.itype = CHOLMOD_INT;
    m.xtype = CHOLMOD_PATTERN;
    m.dtype = CHOLMOD_DOUBLE;
    m.packed = 1;
    return m;
  }
  static void require(bool done) {
    if (!done) throw std::bad_alloc();
  }

  cholmod_common common_{};
};

class DirectSolver final : public LinearSolver {
 public:
  explicit DirectSolver(Ordering ordering) : ordering_(ordering) {}

  void analyze(const SparsePattern& pattern) override {
    require_valid(pattern);
    factor_.reset();
    tree_.reset();
    size_ = pattern.size;
    nonzeros_ = pattern.nonzeros();
    if (pattern.size == 0) return;
    make_tree(pattern);
    make_factor();
  }
  FactorStatus factorize(const Vec& values, double shift) override {
    require_size("LinearSolver::factorize: values", values.size(), nonzeros_);
    return !factor_ || factor_->factorize(values, shift) ? FactorStatus::Ok
                                                         : FactorStatus::NotPositiveDefinite;
  }
  Solution solve(const Vec& r, Vec& p, double) override {
    require_size("LinearSolver::solve: r", r.size(), size_);
    if (factor_)
      factor_->solve(r, p);
    else
      p.resize(r.size());
    return {};
  }
  std::string description() const override { return description_; }

 private:
  void make_tree(const SparsePattern& pattern) {
    const ThreadCount alone(1);
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
    Cholmod cholmod;
    elimination_ = cholmod.eliminate(graph, cholmod.order(graph, chosen_));
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

  void make_factor() {
    factor_ = std::make_unique<MultifrontalFactor>(*tree_);
    description_ = fmt::format("multifrontal, {}, {}{}, {:.3g} factor nonzeros, {:.3g} operations",
                               front_kernels().name, chosen_ == Ordering::Metis ? "METIS" : "AMD",
                               extended_ ? " of an earlier pattern" : "", tree_->nonzeros(),
                               tree_->operations());
  }

  Ordering ordering_, chosen_ = Ordering::Amd;
  Index size_ = 0, nonzeros_ = 0;
  std::optional<BlockGraph> last_graph_;
  BlockElimination elimination_;  // of it
  bool extended_ = false;         // made for another one
  double fresh_operations_ = 0;   // with its own ordering
  std::unique_ptr<const FrontTree> tree_;
  std::unique_ptr<MultifrontalFactor> factor_;
  std::string description_;
};

}  // namespace

std::string_view vector_instructions() { return front_kernels().name; }

std::unique_ptr<LinearSolver> make_direct_solver(Ordering ordering) {
  return std::make_unique<DirectSolver>(ordering);
}

}  // namespace majorant
