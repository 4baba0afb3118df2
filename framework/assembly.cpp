#include "majorant/framework/assembly.h"

#include <algorithm>
#include <span>

#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

constexpr Index kElementsOfATask = 1024;  // fewer are not worth waking a thread for

// Appends the reduced unknowns of an element, some maybe several times.
void append_reduced_unknowns(const ElementDofs& s, const Elimination& z, Index e,
                             std::vector<Index>& out) {
  for (Index k = 0; k < s.nodes.cols(); ++k)
    for (int c = 0; c < s.block; ++c) {
      const Index i = s.block * s.nodes(e, k) + c;
      for (auto q = z.begin(i); q != z.end(i); ++q) out.push_back(q->reduced);
    }
}

}  // namespace

SparsePattern reduced_pattern(const std::vector<const ElementDofs*>& terms,
                              const Elimination& elimination) {
  const Index n = elimination.reduced_size();
  // The unknowns of all elements one after the other; by unknown, the elements that have it.
  std::vector<std::size_t> starts{0}, element_starts(to_size(n) + 2, 0);
  std::vector<Index> all;
  for (const ElementDofs* s : terms)
    for (Index e = 0; e < s->element_count(); ++e) {
      append_reduced_unknowns(*s, elimination, e, all);
      starts.push_back(all.size());
    }
  for (const Index u : all) ++element_starts[u + 2];
  for (std::size_t u = 2; u < element_starts.size(); ++u)
    element_starts[u] += element_starts[u - 1];
  std::vector<std::size_t> elements(all.size());
  for (std::size_t e = 0; e + 1 < starts.size(); ++e)
    for (std::size_t k = starts[e]; k < starts[e + 1]; ++k)
      elements[element_starts[to_size(all[k]) + 1]++] = e;
  SparsePattern p;
  std::vector<Index> mark(to_size(n), -1), below;
  const auto elements_of = [&](Index c) {
    return std::span(elements).subspan(element_starts[c],
                                       element_starts[c + 1] - element_starts[c]);
  };
  for (Index c = 0; c < n; ++c) {
    const auto with = elements_of(c);
    below.clear();
    if (c > 0 && !with.empty() && std::ranges::equal(with, elements_of(c - 1))) {
      // The next unknown of a node has the rows of the one before it, but that one's and its own.
      below.assign(p.rows.begin() + p.diagonal_slot(c - 1) + 2, p.rows.end());
    } else {
      for (const std::size_t e : with)
        for (std::size_t k = starts[e]; k < starts[e + 1]; ++k)
          if (const Index r = all[k]; r > c && mark[r] != c) {
            mark[r] = c;
            below.push_back(r);
          }
    }
    p.append_column(below);
  }
  p.block_of = node_blocks(terms, elimination);
  return p;
}

std::vector<Index> node_blocks(const std::vector<const ElementDofs*>& terms,
                               const Elimination& elimination) {
  // A node is as many unknowns as in the term that has most of them.
  int block = 1;
  for (const ElementDofs* s : terms) block = std::max(block, s->block);
  std::vector<Index> block_of;
  Index previous = -1, blocks = 0;
  for (Index j = 0; j < elimination.reduced_size(); ++j) {
    const Index node = elimination.full_index(j) / block;
    if (j > 0 && node != previous) ++blocks;
    block_of.push_back(blocks);
    previous = node;
  }
  return block_of;
}

ScatterMap::ScatterMap(const ElementDofs& element_dofs, const Elimination& elimination,
                       const SparsePattern& pattern)
    : local_size_(element_dofs.local_size()), packed_size_(local_size_ * (local_size_ + 1) / 2) {
  const Index count = element_dofs.element_count();
  direct_.assign(to_size(count) * to_size(packed_size_), -1);
  reduced_.assign(to_size(count) * to_size(local_size_), -1);
  general_of_.assign(to_size(count), -1);
  std::vector<char> is_simple(to_size(count));
  const auto place = [&](Index task, int) {
    std::vector<int> order;
    const Index last = std::min(count, (task + 1) * kElementsOfATask);
    for (Index e = task * kElementsOfATask; e < last; ++e) {
      Index* reduced = reduced_.data() + to_size(e) * to_size(local_size_);
      bool simple = true;
      for (int i = 0; i < local_size_; ++i) {
        const Index x = element_dofs.block * element_dofs.nodes(e, i / element_dofs.block) +
                        i % element_dofs.block;
        const auto first = elimination.begin(x), last_entry = elimination.end(x);
        if (first == last_entry) continue;
        simple = simple && last_entry - first == 1 && first->coefficient == 1.0;
        reduced[i] = first->reduced;
      }
      // An unknown that occurs twice in an element needs both off-diagonal copies: general path.
      for (int i = 0; i < local_size_; ++i)
        for (int j = 0; j < i; ++j) simple = simple && (reduced[i] < 0 || reduced[i] != reduced[j]);
      is_simple[e] = simple;
      if (simple)
        find_slots(reduced, pattern, order, direct_.data() + to_size(e) * to_size(packed_size_));
    }
  };
  parallel_tasks((count + kElementsOfATask - 1) / kElementsOfATask, place);
  for (Index e = 0; e < count; ++e)
    if (!is_simple[e]) build_general(e, element_dofs, elimination, pattern);
}

// Each column is read but once: its rows and the element's unknowns are both ascending.
void ScatterMap::find_slots(const Index* reduced, const SparsePattern& pattern,
                            std::vector<int>& order, Index* direct) const {
  order.clear();
  for (int i = 0; i < local_size_; ++i)
    if (reduced[i] >= 0) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](int i, int j) { return reduced[i] < reduced[j]; });
  for (auto column = order.begin(); column != order.end(); ++column) {
    Index slot = pattern.diagonal_slot(reduced[*column]);
    for (auto row = column; row != order.end(); ++row) {
      while (pattern.rows[slot] < reduced[*row]) ++slot;
      const auto [low, high] = std::minmax(*row, *column);
      direct[high * (high + 1) / 2 + low] = slot;
    }
  }
}

ScatterMap ScatterMap::moved(const std::vector<Index>& places) const {
  ScatterMap out = *this;
  for (Index& slot : out.direct_)
    if (slot >= 0) slot = places[slot];
  for (auto& contributions : out.general_)
    for (Contribution& c : contributions) c.slot = places[c.slot];
  return out;
}

void ScatterMap::build_general(Index e, const ElementDofs& s, const Elimination& z,
                               const SparsePattern& pattern) {
  general_of_[e] = static_cast<Index>(general_.size());
  std::vector<Contribution> contributions;
  std::vector<std::pair<int, Target>> gradient;
  const auto full = [&](int i) { return s.block * s.nodes(e, i / s.block) + i % s.block; };
  for (int i = 0; i < local_size_; ++i) {
    for (auto p = z.begin(full(i)); p != z.end(full(i)); ++p) {
      gradient.push_back({i, {p->reduced, p->coefficient}});
      for (int j = 0; j < local_size_; ++j) {
        const int packed = std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j);
        for (auto q = z.begin(full(j)); q != z.end(full(j)); ++q)
          if (p->reduced >= q->reduced)
            contributions.push_back(
                {packed, pattern.slot(p->reduced, q->reduced), p->coefficient * q->coefficient});
      }
    }
  }
  general_.push_back(std::move(contributions));
  general_gradient_.push_back(std::move(gradient));
}

void ScatterMap::add_hessian(Index element, const LocalSystem& local, int p, double factor,
                             double* values) const {
  if (const Index g = general_of_[element]; g >= 0) {
    for (const Contribution& c : general_[g])
      values[c.slot] += factor * c.coefficient * local.hessian[c.local * LocalSystem::stride + p];
    return;
  }
  const Index* slot = direct_.data() + to_size(element) * to_size(packed_size_);
  const double* h = local.hessian + p;
  for (int k = 0; k < packed_size_; ++k, h += LocalSystem::stride)
    if (slot[k] >= 0) values[slot[k]] += factor * *h;
}

void ScatterMap::add_gradient(Index element, const LocalSystem& local, int p, double factor,
                              double* gradient) const {
  if (const Index g = general_of_[element]; g >= 0) {
    for (const auto& [i, target] : general_gradient_[g])
      gradient[target.reduced] +=
          factor * target.coefficient * local.gradient[i * LocalSystem::stride + p];
    return;
  }
  const Index* reduced = reduced_.data() + to_size(element) * to_size(local_size_);
  for (int i = 0; i < local_size_; ++i)
    if (reduced[i] >= 0)
      gradient[reduced[i]] += factor * local.gradient[i * LocalSystem::stride + p];
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
