#include "majorant/framework/internal/multifrontal.h"

#include <algorithm>
#include <array>

namespace majorant {
namespace {

// Columns of a front that are eliminated before the rest is updated. Origin: a panel of 1000 rows
// fits into a second-level cache.
constexpr Index kPanelColumns = 64;
static_assert(kPanelColumns % FrontKernels::kTile == 0);

std::unique_ptr<double[]> uninitialized(std::size_t size) {
  return std::unique_ptr<double[]>(new double[size]);
}

}  // namespace

MultifrontalFactor::MultifrontalFactor(const FrontTree& tree, const FrontKernels& kernels)
    : tree_(tree), kernels_(kernels), update_places_(tree.fronts().size()) {
  for (const FrontTree::Front& front : tree_.fronts())
    largest_stride_ = std::max(largest_stride_, front.stride);
  panels_ = uninitialized(tree_.panel_size());
  updates_ = uninitialized(place_updates());
  packed_ = uninitialized(at(kPanelColumns) * at(largest_stride_ + FrontKernels::kTile));
  front_values_.resize(largest_stride_);
}

// Updates wait on two stacks, of fronts at even and at odd depths: a front's comes on the one
// while its children's are taken from the top of the other.
std::size_t MultifrontalFactor::place_updates() {
  const auto count = static_cast<Index>(tree_.fronts().size()) - 1;
  std::vector<Index> odd(at(count), 0);
  for (Index f = count; f-- > 0;)
    if (const Index parent = tree_.fronts()[at(f)].parent; parent >= 0)
      odd[at(f)] = 1 - odd[at(parent)];
  std::array<std::size_t, 2> top{}, highest{};
  for (Index f = 0; f < count; ++f) {
    const std::size_t mine = at(odd[at(f)]), theirs = 1 - mine;
    update_places_[at(f)] = top[mine];
    top[mine] += tree_.fronts()[at(f)].update_size();
    highest[mine] = std::max(highest[mine], top[mine]);
    if (const auto children = tree_.children(f); !children.empty())
      top[theirs] = update_places_[at(children.front())];
  }
  for (Index f = 0; f < count; ++f)
    if (odd[at(f)]) update_places_[at(f)] += highest[0];
  return highest[0] + highest[1];
}

bool MultifrontalFactor::factorize(const Vec& values, double shift) {
  const auto count = static_cast<Index>(tree_.fronts().size()) - 1;
  for (Index f = 0; f < count; ++f)
    if (!factorize_front(f, values, shift, packed_.get())) return false;
  return true;
}

bool MultifrontalFactor::factorize_front(Index f, const Vec& values, double shift, double* packed) {
  const FrontTree::Front& front = tree_.fronts()[at(f)];
  const Index below = front.rows - front.columns,
              update_tiles = front.update_stride / FrontKernels::kTile;
  take_in_entries(f, values, shift);
  std::fill_n(update(f), front.update_size(), 0.0);
  for (const Index child : tree_.children(f)) take_in_child(child);
  double* l = panel(f);
  for (Index first = 0; first < front.columns; first += kPanelColumns) {
    const Index last = std::min(front.columns, first + kPanelColumns), depth = last - first;
    if (!kernels_.factorize(l, front.stride, first, last)) return false;
    if (last < front.columns) {
      const Index rest = front.columns - last;
      kernels_.pack(l, front.stride, front.stride, last, first, last, packed);
      kernels_.update(l + last * front.stride + last, front.stride, rest, packed,
                      (front.stride - last) / FrontKernels::kTile, depth, 0,
                      (rest + FrontKernels::kTile - 1) / FrontKernels::kTile);
    }
    if (below == 0) continue;
    kernels_.pack(l, front.stride, front.rows, front.columns, first, last, packed);
    kernels_.update(update(f), front.update_stride, below, packed, update_tiles, depth, 0,
                    update_tiles);
  }
  return true;
}

void MultifrontalFactor::take_in_entries(Index f, const Vec& values, double shift) {
  const FrontTree::Front& front = tree_.fronts()[at(f)];
  double* l = panel(f);
  std::fill_n(l, at(front.stride) * at(front.columns), 0.0);
  for (const FrontTree::Entry& entry : tree_.entries(f)) l[entry.place] = values[entry.slot];
  if (shift != 0)
    for (Index c = 0; c < front.columns; ++c) l[c * front.stride + c] += shift;
}

void MultifrontalFactor::take_in_child(Index child) {
  const FrontTree::Front& front = tree_.fronts()[at(child)];
  const FrontTree::Front& parent = tree_.fronts()[at(front.parent)];
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
  for (Index k = 0; k < tree_.size(); ++k) permuted_[k] = r[tree_.order()[at(k)]];
  double* x = front_values_.data();
  for (Index f = 0; f < count; ++f) {
    const FrontTree::Front& front = tree_.fronts()[at(f)];
    const std::span<const Index> below = tree_.rows_below(f);
    std::copy_n(permuted_.data() + front.first, front.columns, x);
    std::fill(x + front.columns, x + front.stride, 0.0);
    kernels_.forward(panel(f), front.stride, front.columns, x);
    std::copy_n(x, front.columns, permuted_.data() + front.first);
    for (std::size_t k = 0; k < below.size(); ++k) permuted_[below[k]] += x[at(front.columns) + k];
  }
  for (Index f = count; f-- > 0;) {
    const FrontTree::Front& front = tree_.fronts()[at(f)];
    const std::span<const Index> below = tree_.rows_below(f);
    std::copy_n(permuted_.data() + front.first, front.columns, x);
    for (std::size_t k = 0; k < below.size(); ++k) x[at(front.columns) + k] = permuted_[below[k]];
    std::fill(x + front.rows, x + front.stride, 0.0);
    kernels_.backward(panel(f), front.stride, front.columns, x);
    std::copy_n(x, front.columns, permuted_.data() + front.first);
  }
  p.resize(r.size());
  for (Index k = 0; k < tree_.size(); ++k) p[tree_.order()[at(k)]] = permuted_[k];
}

}  // namespace majorant
