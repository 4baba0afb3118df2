#include "majorant/framework/internal/multifrontal.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

// Columns of a front that are eliminated before the rest is updated: a panel of 1000 rows fits into
// a second-level cache.
constexpr Index kPanelColumns = 64;
static_assert(kPanelColumns % FrontKernels::kTile == 0);

// Less is not worth waking threads for: of the whole factorization, half a millisecond on one core,
// and of one update in it, a tenth of that.
constexpr double kParallelOperations = 1e7, kParallelUpdate = 2e6;
// Largest subtree for one thread, of the operations of all for each thread: the last one to finish
// keeps the others waiting for at most an eighth of the time.
constexpr double kTaskPart = 1.0 / 8;

std::unique_ptr<double[]> uninitialized(std::size_t size) {
  return std::unique_ptr<double[]>(new double[size]);
}

// Columns of a lower triangle, and what of the upper one shares tiles with it.
void clear_triangle(double* values, std::ptrdiff_t stride, Index columns) {
  for (Index c = 0; c < columns; ++c, values += stride)
    std::fill(values + c / FrontKernels::kTile * FrontKernels::kTile, values + stride, 0.0);
}

Index tiles(Index rows) { return (rows + FrontKernels::kTile - 1) / FrontKernels::kTile; }

}  // namespace

struct MultifrontalFactor::Work {
  const Vec& values;
  double shift;
};

MultifrontalFactor::MultifrontalFactor(const AssemblyTree& tree, const FrontKernels& kernels)
    : tree_(tree),
      kernels_(kernels),
      threads_(tree.operations() < kParallelOperations ? 1 : ThreadCount::current()),
      update_places_(tree.fronts().size()) {
  for (const AssemblyTree::Front& front : tree_.fronts())
    largest_stride_ = std::max(largest_stride_, static_cast<std::size_t>(front.stride));
  make_tasks();
  updates_size_ = place_updates();
}

std::size_t MultifrontalFactor::bytes() const {
  return (tree_.panel_size() + updates_size_ + to_size(threads_) * packed_size()) * sizeof(double);
}

void MultifrontalFactor::allocate() {
  panels_ = uninitialized(tree_.panel_size());
  updates_ = uninitialized(updates_size_);
  packed_ = uninitialized(to_size(threads_) * packed_size());
  front_values_.resize(static_cast<Eigen::Index>(largest_stride_));
}

// From the top down: a subtree that is small enough is a task, the root of another one is above.
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

// Every task has stacks of its own: others work at the same time.
std::size_t MultifrontalFactor::place_updates() {
  std::size_t size = 0;
  for (const Task& task : tasks_) size = place_updates(task, size);
  for (const Index f : above_) {
    update_places_[f] = size;
    size += tree_.fronts()[f].update_size();
  }
  return size;
}

// Updates wait on two stacks, of fronts at even and at odd depths: a front's comes on the one
// while its children's are taken from the top of the other.
std::size_t MultifrontalFactor::place_updates(const Task& task, std::size_t start) {
  std::vector<Index> odd(to_size(task.last - task.first), 0);
  const auto is_odd = [&](Index f) -> Index& { return odd[f - task.first]; };
  for (Index f = task.last; f-- > task.first;)
    if (const Index parent = tree_.fronts()[f].parent; parent >= 0 && parent < task.last)
      is_odd(f) = 1 - is_odd(parent);
  std::array<std::size_t, 2> top{}, highest{};
  for (Index f = task.first; f < task.last; ++f) {
    const std::size_t mine = to_size(is_odd(f)), theirs = 1 - mine;
    update_places_[f] = top[mine];
    top[mine] += tree_.fronts()[f].update_size();
    highest[mine] = std::max(highest[mine], top[mine]);
    if (const auto children = tree_.children(f); !children.empty())
      top[theirs] = update_places_[children.front()];
  }
  for (Index f = task.first; f < task.last; ++f)
    update_places_[f] += start + (is_odd(f) ? highest[0] : 0);
  return start + highest[0] + highest[1];
}

std::size_t MultifrontalFactor::packed_size() const {
  return to_size(kPanelColumns) * (largest_stride_ + to_size(FrontKernels::kTile));
}

bool MultifrontalFactor::factorize(const Vec& values, double shift) {
  if (!packed_) allocate();
  const Work work{values, shift};
  std::atomic<bool> positive{true};
  const auto count = static_cast<Index>(tasks_.size());
  const auto factorize_task = [&](Index t, int thread) {
    double* packed = packed_.get() + to_size(thread) * packed_size();
    for (Index f = tasks_[t].first; f < tasks_[t].last && positive; ++f)
      if (!factorize_front(f, work, packed, 1)) positive = false;
  };
  parallel_tasks(count, factorize_task, threads_);
  for (const Index f : above_)
    if (positive && !factorize_front(f, work, packed_.get(), threads_)) positive = false;
  return positive;
}

bool MultifrontalFactor::factorize_front(Index f, const Work& work, double* packed, int threads) {
  const AssemblyTree::Front& front = tree_.fronts()[f];
  const Index below = front.rows - front.columns;
  take_in_entries(f, work);
  clear_triangle(update(f), front.update_stride, below);
  for (const Index child : tree_.children(f)) extend_add(child);
  double* l = panel(f);
  for (Index first = 0; first < front.columns; first += kPanelColumns) {
    const Index last = std::min(front.columns, first + kPanelColumns), depth = last - first;
    if (!kernels_.factorize(l, front.stride, first, last)) return false;
    if (last < front.columns) {
      const auto rows = static_cast<Index>(front.stride);
      kernels_.pack(l, front.stride, rows, last, first, last, packed);
      subtract_product(
          {l + last * front.stride + last, front.stride, front.columns - last, rows - last, depth},
          packed, threads);
    }
    if (below == 0) continue;
    kernels_.pack(l, front.stride, front.rows, front.columns, first, last, packed);
    subtract_product({update(f), front.update_stride, below, below, depth}, packed, threads);
  }
  return true;
}

// Tiles of columns from the left, where they are longest.
void MultifrontalFactor::subtract_product(const Target& target, const double* packed,
                                          int threads) const {
  const Index columns = tiles(target.columns), rows = tiles(target.rows);
  const auto update = [&](Index first, Index last) {
    kernels_.update(target.values, target.stride, target.columns, packed, rows, target.depth, first,
                    last);
  };
  const double operations = 0.5 * target.rows * target.columns * target.depth;
  if (threads == 1 || operations < kParallelUpdate) return update(0, columns);
  parallel_tasks(
      columns, [&](Index c, int) { update(c, c + 1); }, threads);
}

void MultifrontalFactor::take_in_entries(Index f, const Work& work) {
  const AssemblyTree::Front& front = tree_.fronts()[f];
  double* l = panel(f);
  clear_triangle(l, front.stride, front.columns);
  for (const AssemblyTree::Entry& entry : tree_.entries(f))
    l[entry.column * front.stride + entry.row] = work.values[entry.slot];
  if (work.shift != 0)
    for (Index c = 0; c < front.columns; ++c) l[c * front.stride + c] += work.shift;
}

void MultifrontalFactor::extend_add(Index child) {
  const AssemblyTree::Front& front = tree_.fronts()[child];
  const AssemblyTree::Front& parent = tree_.fronts()[front.parent];
  const Index* place = tree_.rows_of_parent(child);
  const Index count = front.rows - front.columns;
  const double* from = update(child);
  double *l = panel(front.parent), *u = update(front.parent);
  for (Index c = 0; c < count; ++c, from += front.update_stride) {
    const Index column = place[c];
    double* to = column < parent.columns
                     ? l + column * parent.stride
                     : u + (column - parent.columns) * parent.update_stride - parent.columns;
    for (Index r = c; r < count; ++r) to[place[r]] += from[r];
  }
}

void MultifrontalFactor::solve(const Vec& r, Vec& p) {
  const auto count = static_cast<Index>(tree_.fronts().size()) - 1;
  permuted_.resize(r.size());
  for (Index k = 0; k < tree_.size(); ++k) permuted_[k] = r[tree_.order()[k]];
  double* x = front_values_.data();
  for (Index f = 0; f < count; ++f) {
    const AssemblyTree::Front& front = tree_.fronts()[f];
    const std::span<const Index> below = tree_.rows_below(f);
    std::copy_n(permuted_.data() + front.first, front.columns, x);
    std::fill(x + front.columns, x + front.stride, 0.0);
    kernels_.forward(panel(f), front.stride, front.columns, x);
    std::copy_n(x, front.columns, permuted_.data() + front.first);
    for (std::size_t k = 0; k < below.size(); ++k)
      permuted_[below[k]] += x[to_size(front.columns) + k];
  }
  for (Index f = count; f-- > 0;) {
    const AssemblyTree::Front& front = tree_.fronts()[f];
    const std::span<const Index> below = tree_.rows_below(f);
    std::copy_n(permuted_.data() + front.first, front.columns, x);
    for (std::size_t k = 0; k < below.size(); ++k)
      x[to_size(front.columns) + k] = permuted_[below[k]];
    std::fill(x + front.rows, x + front.stride, 0.0);
    kernels_.backward(panel(f), front.stride, front.columns, x);
    std::copy_n(x, front.columns, permuted_.data() + front.first);
  }
  p.resize(r.size());
  for (Index k = 0; k < tree_.size(); ++k) p[tree_.order()[k]] = permuted_[k];
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
