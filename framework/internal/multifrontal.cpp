#include "majorant/framework/internal/multifrontal.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <new>
#include <numeric>

#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

// With fewer operations, waking threads does not pay. For a whole factorization the limit is half a
// millisecond on one core, for one update in it a tenth of a millisecond.
constexpr double kParallelOperations = 1e7, kParallelUpdate = 2e6;
// The largest subtree for one thread, as a part of each thread's share of all operations. Smaller
// subtrees shorten the wait at the end, but leave more fronts above, which are eliminated one by
// one. With 1/8, solves of meshes of 10,000 to 160,000 faces on two threads take longer and no less
// memory.
constexpr double kTaskPart = 1.0 / 2;
// The number of unknowns that a task permutes; fewer do not pay for waking a thread.
constexpr Index kPermuted = 16384;

// The fronts of a task between two polls: most fronts of a mesh take some 10 microseconds.
constexpr Index kFrontsPerPoll = 16;

// When an array is too small, 1 / kSpare of the request is allocated in addition. Patterns that
// change from step to step, as those around an image do, grow by a few percent, and untouched
// memory costs nothing.
constexpr std::size_t kSpare = 8;

// The size of a large page on x86-64 and, with pages of 4 KiB, on ARM.
constexpr std::size_t kLargePage = std::size_t(1) << 21;

// Returns an array for the numbers of a factor, which are written before they are read, in pages of
// 2 MiB if the system has them. Touching memory for the first time costs, page by page, as much as
// a Cholesky factorization of a mesh that is written into it. Throws std::bad_alloc.
LargeArray large_array(std::size_t size) {
  if (size > (std::numeric_limits<std::size_t>::max() - kLargePage) / sizeof(double))
    throw std::bad_alloc();
  const std::size_t bytes = size * sizeof(double);
  const bool is_large = bytes >= kLargePage;
  void* values =
      is_large ? std::aligned_alloc(kLargePage, (bytes + kLargePage - 1) / kLargePage * kLargePage)
               : std::malloc(bytes + 1);
  if (!values) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  if (is_large) ::madvise(values, bytes, MADV_HUGEPAGE);  // a failure does no harm
#endif
  return LargeArray(static_cast<double*>(values));
}

// Gives the large pages within an array back to the system. Their numbers are lost; the address
// space stays, and a write to it gets fresh pages.
void release_pages(double* values, std::size_t size) {
  const auto begin = reinterpret_cast<std::uintptr_t>(values);
  const std::uintptr_t first = (begin + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t last = (begin + size * sizeof(double)) / kLargePage * kLargePage;
  if (first < last) ::madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED);
}

// Clears the lower triangle, and the upper one where tiles reach into it.
void clear_triangle(double* values, const ColumnSlabs& shape) {
  for (Index c = 0; c < shape.columns; ++c) {
    double* const column = values + shape.column(c);
    std::fill(column + c / FrontKernels::kTile * FrontKernels::kTile, column + shape.rows, 0.0);
  }
}

Index tiles(Index rows) { return (rows + FrontKernels::kTile - 1) / FrontKernels::kTile; }

}  // namespace

struct MultifrontalFactor::Work {
  const Vec& values;
  double shift;
};

void FactorMemory::Part::fit(std::size_t numbers) {
  if (values && numbers <= size) return;
  values.reset();  // first, since both at once may not fit into memory
  const std::size_t room = size > 0 ? numbers + numbers / kSpare : numbers;
  size = 0;
  values = large_array(room);
  size = room;
}

MultifrontalFactor::MultifrontalFactor(const AssemblyTree& tree, const FrontKernels& kernels,
                                       FactorMemory memory, std::size_t large)
    : tree_(tree),
      kernels_(kernels),
      threads_(tree.operations() < kParallelOperations ? 1 : ThreadCount::current()),
      is_large_(tree.factor_size() * sizeof(double) >= large),
      update_places_(tree.fronts().size()),
      is_root_(tree.fronts().size(), 0),
      memory_(std::move(memory)) {
  for (const AssemblyTree::Front& front : tree_.fronts())
    most_rows_ = std::max(most_rows_, static_cast<std::size_t>(front.part().rows));
  make_tasks();
  place_updates();
  find_outside();
}

std::size_t MultifrontalFactor::bytes() const {
  return (tree_.factor_size() + updates_size() + to_size(threads_) * packed_size()) *
         sizeof(double);
}

void MultifrontalFactor::allocate() {
  memory_.factor.fit(tree_.factor_size());
  memory_.updates.fit(updates_size());
  memory_.packed.fit(to_size(threads_) * packed_size());
  has_memory_ = true;
}

MultifrontalFactor::Scratch MultifrontalFactor::scratch(int thread, int threads) {
  return {memory_.packed.values.get() + to_size(thread) * packed_size(),
          memory_.updates.values.get() + roots_size_ + to_size(thread) * stack_size_, threads};
}

// Descends from the roots: a subtree that is small enough becomes a task, otherwise its root is a
// front above the tasks.
void MultifrontalFactor::make_tasks() {
  const auto count = static_cast<Index>(tree_.fronts().size()) - 1;
  if (threads_ == 1) {
    tasks_.push_back({0, count, tree_.operations()});
    return;
  }
  std::vector<double> operations(to_size(count), 0);
  std::vector<Index> first(to_size(count));
  for (Index f = 0; f < count; ++f) {
    const std::span<const Index> children = tree_.children(f);
    first[f] = children.empty() ? f : first[children.front()];
    operations[f] = tree_.fronts()[f].operations();
    for (const Index child : children) operations[f] += operations[child];
  }
  const double largest = kTaskPart / threads_ * tree_.operations();
  for (Index f = count; f-- > 0;) {
    if (operations[f] > largest) {
      above_.push_back(f);
      continue;
    }
    tasks_.push_back({first[f], f + 1, operations[f]});
    f = first[f];
  }
  std::reverse(above_.begin(), above_.end());
  std::stable_sort(tasks_.begin(), tasks_.end(),
                   [](const Task& a, const Task& b) { return a.operations > b.operations; });
}

void MultifrontalFactor::place_updates() {
  std::vector<Index> fronts;
  for (const Task& task : tasks_) {
    const Index root = task.last - 1;
    is_root_[root] = 1;
    update_places_[root] = roots_size_;
    roots_size_ += tree_.fronts()[root].update().size();
    fronts.resize(to_size(root - task.first));
    std::iota(fronts.begin(), fronts.end(), task.first);
    stack_size_ = std::max(stack_size_, place_on_stacks(fronts));
  }
  const std::size_t threads = to_size(threads_);
  stack_size_ = std::max(stack_size_, (place_on_stacks(above_) + threads - 1) / threads);
}

// Places waiting updates on two stacks, one for fronts at even depths and one for odd depths. A
// front pushes its update on one stack while it pops those of its children from the other. fronts:
// ascending. Returns the required room.
std::size_t MultifrontalFactor::place_on_stacks(std::span<const Index> fronts) {
  constexpr char kElsewhere = 2;
  std::vector<char> stack(tree_.fronts().size(), kElsewhere);
  for (std::size_t k = fronts.size(); k-- > 0;) {
    const Index parent = tree_.fronts()[fronts[k]].parent;
    stack[fronts[k]] = parent >= 0 && stack[parent] == 0 ? 1 : 0;
  }
  std::array<std::size_t, 2> top{}, highest{};
  for (const Index f : fronts) {
    const auto mine = static_cast<std::size_t>(stack[f]), theirs = 1 - mine;
    update_places_[f] = top[mine];
    top[mine] += tree_.fronts()[f].update().size();
    highest[mine] = std::max(highest[mine], top[mine]);
    const auto children = tree_.children(f);
    const auto first =
        std::ranges::find_if(children, [&](Index c) { return stack[c] != kElsewhere; });
    if (first != children.end()) top[theirs] = update_places_[*first];
  }
  for (const Index f : fronts) update_places_[f] += stack[f] == 1 ? highest[0] : 0;
  return highest[0] + highest[1];
}

void MultifrontalFactor::find_outside() {
  const std::size_t count = tree_.fronts().size();
  inside_.resize(count);
  for (std::size_t f = 0; f + 1 < count; ++f)
    inside_[f] = tree_.fronts()[f].rows - tree_.fronts()[f].columns;
  if (threads_ == 1) return;
  std::size_t outside = 0;
  outside_places_.resize(count);
  for (const Task& task : tasks_) {
    const AssemblyTree::Front& root = tree_.fronts()[task.last - 1];
    for (Index f = task.first; f < task.last; ++f) {
      const std::span<const Index> below = tree_.rows_below(f);
      const auto first = std::ranges::lower_bound(below, root.first + root.columns);
      inside_[f] = static_cast<Index>(first - below.begin());
      outside_places_[f] = outside;
      outside += to_size(static_cast<Index>(below.end() - first));
    }
  }
  outside_.resize(static_cast<Eigen::Index>(outside));
  task_order_.resize(tasks_.size());
  std::iota(task_order_.begin(), task_order_.end(), 0);
  std::ranges::sort(task_order_, {}, [&](Index t) { return tasks_[t].first; });
}

std::size_t MultifrontalFactor::packed_size() const {
  return to_size(ColumnSlabs::kColumns) * (most_rows_ + to_size(FrontKernels::kTile));
}

bool MultifrontalFactor::factorize(const Vec& values, double shift, const StopCheck& stop) {
  if (!has_memory_) allocate();
  // Fronts above all tasks do not need their part of the factor while the tasks run.
  if (is_large_)
    for (const Index f : above_) release_pages(part(f), tree_.fronts()[f].part().size());
  const Work work{values, shift};
  std::atomic<bool> positive{true};
  const auto factorize_task = [&](Index t, int thread) {
    const Scratch own = scratch(thread, 1);
    for (Index f = tasks_[t].first; f < tasks_[t].last && positive; ++f) {
      if (f % kFrontsPerPoll == 0) stop.poll();
      if (!factorize_front(f, work, own)) positive = false;
    }
  };
  parallel_tasks(static_cast<Index>(tasks_.size()), factorize_task, threads_);
  const Scratch all = scratch(0, threads_);
  if (is_large_) release_pages(all.stack, to_size(threads_) * stack_size_);
  for (const Index f : above_) {
    stop.poll();
    if (positive && !factorize_front(f, work, all)) positive = false;
  }
  if (is_large_) release_pages(memory_.updates.values.get(), updates_size());
  return positive;
}

bool MultifrontalFactor::factorize_front(Index f, const Work& work, const Scratch& scratch) {
  const AssemblyTree::Front& front = tree_.fronts()[f];
  const ColumnSlabs part = front.part(), left = front.update();
  double *l = this->part(f), *u = update(f, scratch);
  take_in_entries(f, work);
  clear_triangle(u, left);
  for (const Index child : tree_.children(f)) {
    extend_add(child, scratch);
    if (scratch.threads > 1 && is_large_)
      release_pages(update(child, scratch), tree_.fronts()[child].update().size());
  }
  for (Index s = 0; s < part.slabs(); ++s) {
    double* const slab = l + part.begin(s);
    const FrontKernels::Stride stride = part.stride(s);
    const Index depth = part.columns_of(s), above = s * ColumnSlabs::kColumns;
    if (!kernels_.factorize(slab, stride, 0, depth)) return false;
    if (s + 1 < part.slabs()) {
      kernels_.pack(slab, stride, static_cast<Index>(stride), depth, 0, depth, scratch.packed);
      subtract_product({l, part, s + 1, depth}, scratch);
    }
    if (left.columns == 0) continue;
    kernels_.pack(slab, stride, front.rows - above, front.columns - above, 0, depth,
                  scratch.packed);
    subtract_product({u, left, 0, depth}, scratch);
  }
  return true;
}

// Processes tiles of columns from the left, where they are longest.
void MultifrontalFactor::subtract_product(const Target& target, const Scratch& scratch) const {
  constexpr Index kTiles = ColumnSlabs::kColumns / FrontKernels::kTile;  // of a whole slab
  const ColumnSlabs& shape = target.shape;
  const auto update = [&](Index slab, Index first, Index last) {
    const Index before = (slab - target.first) * kTiles;
    kernels_.update(target.values + shape.begin(slab), shape.stride(slab), shape.columns_of(slab),
                    scratch.packed + std::ptrdiff_t(before) * FrontKernels::kTile * target.depth,
                    static_cast<Index>(shape.stride(slab)) / FrontKernels::kTile, target.depth,
                    first, last);
  };
  const auto columns = static_cast<double>(shape.columns - target.first * ColumnSlabs::kColumns);
  const auto rows = static_cast<double>(shape.stride(target.first));
  if (scratch.threads == 1 || 0.5 * rows * columns * target.depth < kParallelUpdate) {
    for (Index s = target.first; s < shape.slabs(); ++s) update(s, 0, tiles(shape.columns_of(s)));
    return;
  }
  const Index before = target.first * kTiles;
  const auto update_tile = [&](Index t, int) {
    const Index slab = (before + t) / kTiles, tile = (before + t) % kTiles;
    update(slab, tile, tile + 1);
  };
  parallel_tasks(tiles(shape.columns) - before, update_tile, scratch.threads);
}

void MultifrontalFactor::take_in_entries(Index f, const Work& work) {
  const ColumnSlabs shape = tree_.fronts()[f].part();
  double* l = part(f);
  clear_triangle(l, shape);
  for (const AssemblyTree::Entry& entry : tree_.entries(f))
    l[entry.place] = work.values[entry.slot];
  if (work.shift != 0)
    for (Index c = 0; c < shape.columns; ++c) l[shape.column(c) + c] += work.shift;
}

void MultifrontalFactor::extend_add(Index child, const Scratch& scratch) {
  const AssemblyTree::Front& front = tree_.fronts()[child];
  const AssemblyTree::Front& parent = tree_.fronts()[front.parent];
  const ColumnSlabs shape = front.update(), part = parent.part(), left = parent.update();
  const Index* place = tree_.rows_of_parent(child);
  const double* from = update(child, scratch);
  double *l = this->part(front.parent), *u = update(front.parent, scratch) - parent.columns;
  for (Index c = 0; c < shape.columns; ++c) {
    const Index column = place[c];
    const double* const values = from + shape.column(c);
    double* to = column < parent.columns ? l + part.column(column)
                                         : u + left.column(column - parent.columns);
    for (Index r = c; r < shape.columns; ++r) to[place[r]] += values[r];
  }
}

// Eliminates the front's columns from `values`, by position, and leaves their contribution to the
// rows below in x. Returns false, and does nothing, if all are 0: right-hand sides with few entries
// have zeros in all fronts but those above these entries.
bool MultifrontalFactor::forward_columns(Index f, double* values, double* x) {
  const AssemblyTree::Front& front = tree_.fronts()[f];
  const ColumnSlabs shape = front.part();
  double* const own = values + front.first;
  if (std::all_of(own, own + front.columns, [](double value) { return value == 0; })) return false;
  std::copy_n(own, front.columns, x);
  std::fill(x + front.columns, x + shape.rows, 0.0);
  for (Index s = 0; s < shape.slabs(); ++s)
    kernels_.forward(part(f) + shape.begin(s), shape.stride(s), shape.columns_of(s),
                     x + s * ColumnSlabs::kColumns);
  std::copy_n(x, front.columns, own);
  return true;
}

void MultifrontalFactor::forward(Index f, double* x) {
  const std::span<const Index> below = tree_.rows_below(f);
  const std::size_t inside = to_size(inside_[f]);
  // Fronts above all tasks have no rows outside.
  double* const outside = inside < below.size() ? outside_.data() + outside_places_[f] : nullptr;
  if (!forward_columns(f, permuted_.data(), x)) {
    std::fill_n(outside, below.size() - inside, 0.0);
    return;
  }
  x += tree_.fronts()[f].columns;
  for (std::size_t k = 0; k < inside; ++k) permuted_[below[k]] += x[k];
  std::copy(x + inside, x + below.size(), outside);
}

void MultifrontalFactor::add_outside(const Task& task) {
  for (Index f = task.first; f < task.last; ++f) {
    const std::span<const Index> outside = tree_.rows_below(f).subspan(to_size(inside_[f]));
    const double* x = outside_.data() + outside_places_[f];
    for (const Index row : outside) permuted_[row] += *x++;
  }
}

void MultifrontalFactor::backward(Index f, double* values, double* x) {
  const AssemblyTree::Front& front = tree_.fronts()[f];
  const ColumnSlabs shape = front.part();
  const std::span<const Index> below = tree_.rows_below(f);
  std::copy_n(values + front.first, front.columns, x);
  for (std::size_t k = 0; k < below.size(); ++k) x[to_size(front.columns) + k] = values[below[k]];
  std::fill(x + front.rows, x + shape.rows, 0.0);
  for (Index s = shape.slabs(); s-- > 0;)
    kernels_.backward(part(f) + shape.begin(s), shape.stride(s), shape.columns_of(s),
                      x + s * ColumnSlabs::kColumns);
  std::copy_n(x, front.columns, values + front.first);
}

// Calls work(k) for every unknown, in pieces.
template <class F>
void MultifrontalFactor::for_each_unknown(const F& work) const {
  const Index size = tree_.size();
  const auto piece = [&](Index first, int) {
    for (Index k = first * kPermuted; k < std::min(size, (first + 1) * kPermuted); ++k) work(k);
  };
  parallel_tasks((size + kPermuted - 1) / kPermuted, piece, threads_);
}

// Overwrites permuted_ with L^-1 P r.
void MultifrontalFactor::forward_all(const Vec& r) {
  permuted_.resize(tree_.size());
  front_values_.resize(static_cast<Eigen::Index>(to_size(threads_) * most_rows_));
  for_each_unknown([&](Index k) { permuted_[k] = r[tree_.order()[k]]; });
  const auto forward_task = [&](Index t, int thread) {
    for (Index f = tasks_[t].first; f < tasks_[t].last; ++f) forward(f, front_values(thread));
  };
  parallel_tasks(static_cast<Index>(tasks_.size()), forward_task, threads_);
  auto task = task_order_.begin();
  for (const Index f : above_) {
    for (; task != task_order_.end() && tasks_[*task].last <= f; ++task) add_outside(tasks_[*task]);
    forward(f, front_values(0));
  }
}

void MultifrontalFactor::half_solve(const Vec& r, Vec& y) {
  forward_all(r);
  y = permuted_;
}

// Returns the fronts of the unknowns and all fronts above them, ascending.
std::vector<Index> MultifrontalFactor::fronts_above(std::span<const Index> unknowns) {
  std::vector<Index> fronts;
  for (const Index u : unknowns)
    for (Index f = tree_.front_of(position_[u]); f >= 0; f = tree_.fronts()[f].parent)
      fronts.push_back(f);
  std::ranges::sort(fronts);
  fronts.erase(std::unique(fronts.begin(), fronts.end()), fronts.end());
  return fronts;
}

void MultifrontalFactor::solve_entries(const SparseColumn& r, std::span<const Index> unknowns,
                                       Vec& entries) {
  if (position_.empty()) {
    position_.resize(to_size(tree_.size()));
    for (Index k = 0; k < tree_.size(); ++k) position_[tree_.order()[k]] = k;
    sparse_ = Vec::Zero(tree_.size());
  }
  front_values_.resize(static_cast<Eigen::Index>(to_size(threads_) * most_rows_));
  std::vector<Index> given;
  for (const auto& [unknown, value] : r) {
    given.push_back(unknown);
    sparse_[position_[unknown]] += value;
  }
  const std::vector<Index> down = fronts_above(given), up = fronts_above(unknowns);
  double* const x = front_values(0);
  for (const Index f : down) {
    if (!forward_columns(f, sparse_.data(), x)) continue;
    const double* taken = x + tree_.fronts()[f].columns;
    for (const Index row : tree_.rows_below(f)) sparse_[row] += *taken++;
  }
  for (std::size_t k = up.size(); k-- > 0;) backward(up[k], sparse_.data(), x);
  entries.resize(static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    entries[static_cast<Eigen::Index>(k)] = sparse_[position_[unknowns[k]]];
  for (const std::vector<Index>* const fronts : {&down, &up})
    for (const Index f : *fronts)
      sparse_.segment(tree_.fronts()[f].first, tree_.fronts()[f].columns).setZero();
}

void MultifrontalFactor::solve(const Vec& r, Vec& p) {
  forward_all(r);
  for (std::size_t k = above_.size(); k-- > 0;)
    backward(above_[k], permuted_.data(), front_values(0));
  const auto backward_task = [&](Index t, int thread) {
    for (Index f = tasks_[t].last; f-- > tasks_[t].first;)
      backward(f, permuted_.data(), front_values(thread));
  };
  parallel_tasks(static_cast<Index>(tasks_.size()), backward_task, threads_);
  p.resize(tree_.size());
  for_each_unknown([&](Index k) { p[tree_.order()[k]] = permuted_[k]; });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
