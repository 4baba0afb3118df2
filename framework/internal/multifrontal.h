// The numerical half of a multifrontal Cholesky factorization [DR83]: P H P^T = L L^T, front by
// front. A front adds the updates of its children to its own entries of H, eliminates its columns,
// and passes an update to its parent.
//
//   SparsePattern pattern;
//   pattern.append_column({});
//   pattern.order_in_blocks(1);
//   const AssemblyTree tree(pattern, BlockElimination{{0}, {0, 1}, {0, 1}, {0}});   // of one block
//   MultifrontalFactor factor(tree);
//   Vec p;
//   if (factor.factorize(Vec::Ones(1), 0.0)) factor.solve(Vec::Ones(1), p);
//
// With several threads (as many as the constructor's caller has, parallel.h), subtrees are
// processed at the same time, then large fronts in parts; solves traverse the tree likewise, so
// both are one class. Results do not depend on the number of threads.
#pragma once

#include <cstdlib>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "majorant/framework/internal/assembly_tree.h"
#include "majorant/framework/internal/front_kernels.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/stop_check.h"

namespace majorant {

struct FreedByMalloc {
  void operator()(double* values) const { std::free(values); }
};
using LargeArray = std::unique_ptr<double[], FreedByMalloc>;

// The large arrays of a factor, for reuse by the next one: touching fresh memory costs about as
// much as the factorization of a mesh's matrix in it.
struct FactorMemory {
  struct Part {
    LargeArray values;
    std::size_t size = 0;
    // Makes room for so many numbers; old numbers are lost if it grows. Throws std::bad_alloc.
    void fit(std::size_t numbers);
  };
  Part factor, updates, packed;
};

class MultifrontalFactor {
 public:
  // `tree` must outlive this object. The first factorize() allocates the large arrays, as far as
  // `memory` does not have them. large: factors of at least this many bytes give memory back to the
  // system while it is not in use; tests use a smaller number.
  explicit MultifrontalFactor(const AssemblyTree& tree,
                              const FrontKernels& kernels = front_kernels(),
                              FactorMemory memory = {}, std::size_t large = kLargeFactor);
  // Returns the allocated memory; only the destructor may follow.
  FactorMemory release() { return std::move(memory_); }

  // Returns the bytes of all that factorize() allocates: the factor, waiting updates, scratch.
  std::size_t bytes() const;

  // Factorizes H + shift * I; values are parallel to the pattern's rows. Returns false if it is not
  // positive definite. Polls between fronts and throws Stopped; no factor exists then.
  bool factorize(const Vec& values, double shift, const StopCheck& stop = {});
  void solve(const Vec& r, Vec& p);
  // Computes the first half of solve(): y with (P^T L) y = r. It keeps the zeros of r where no
  // front fills them.
  void half_solve(const Vec& r, Vec& y);
  // Returns the entries of solve() at these unknowns, equal to the last bit, for an r with few
  // nonzeros. Visits the fronts between these unknowns and the roots, on one thread.
  using SparseColumn = DirectSolver::SparseColumn;
  void solve_entries(const SparseColumn& r, std::span<const Index> unknowns, Vec& entries);

 private:
  // A subtree, for one thread: fronts first to last - 1.
  struct Task {
    Index first, last;
    double operations;
  };
  struct Work;  // of one factorize()
  // The working memory of a thread that factorizes fronts: packed columns, waiting updates.
  struct Scratch {
    double *packed, *stack;
    int threads;  // that share the work on a front
  };

  // The target of a product of packed rows: the lower triangle of the slabs from `first` on. Each
  // of its numbers is a sum of `depth` products.
  struct Target {
    double* values;
    ColumnSlabs shape;
    Index first, depth;
  };

  void allocate();
  void make_tasks();
  void place_updates();
  std::size_t place_on_stacks(std::span<const Index> fronts);
  void find_outside();
  Scratch scratch(int thread, int threads);
  std::size_t updates_size() const { return stack_size_ * to_size(threads_) + roots_size_; }
  std::size_t packed_size() const;  // for one thread
  bool factorize_front(Index f, const Work& work, const Scratch& scratch);
  void subtract_product(const Target& target, const Scratch& scratch) const;
  void take_in_entries(Index f, const Work& work);
  void extend_add(Index child, const Scratch& scratch);
  void forward_all(const Vec& r);
  template <class F>
  void for_each_unknown(const F& work) const;
  double* front_values(int thread) { return front_values_.data() + to_size(thread) * most_rows_; }
  void forward(Index f, double* x);
  bool forward_columns(Index f, double* values, double* x);
  void add_outside(const Task& task);
  void backward(Index f, double* values, double* x);
  std::vector<Index> fronts_above(std::span<const Index> unknowns);
  double* part(Index f) { return memory_.factor.values.get() + tree_.fronts()[f].begin; }
  double* update(Index f, const Scratch& scratch) {
    return (is_root_[f] ? memory_.updates.values.get() : scratch.stack) + update_places_[f];
  }

  const AssemblyTree& tree_;
  const FrontKernels& kernels_;
  const int threads_;
  const bool is_large_;            // waiting memory is given back
  std::size_t most_rows_ = 0;      // of a front, padded
  std::vector<Task> tasks_;        // the most expensive first
  std::vector<Index> task_order_;  // in the order of the tree
  std::vector<Index> above_;       // fronts of no task, ascending: processed one by one, on all
                                   // threads
  // The places of updates. Updates of the roots of tasks come first, since they wait for fronts
  // above; then there is a stack for each thread. Fronts above the tasks use the memory of all
  // these stacks.
  std::vector<std::size_t> update_places_;
  std::vector<char> is_root_;
  std::size_t roots_size_ = 0, stack_size_ = 0;
  // For each front, in the order of the tree: the number of its rows below that belong to its task,
  // and the place where its updates of the other rows wait.
  std::vector<Index> inside_;
  std::vector<std::size_t> outside_places_;
  FactorMemory memory_;
  bool has_memory_ = false;  // enough for this tree
  Vec permuted_, front_values_, outside_;
  // For solve_entries(): the position of each unknown, and values that are 0 between two calls.
  std::vector<Index> position_;
  Vec sparse_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
