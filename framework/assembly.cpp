#include "majorant/framework/assembly.h"

#include <algorithm>
#include <cstdint>
#include <span>

#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

constexpr Index kElementsOfATask = 1024;  // too few to wake a thread for

// Appends the reduced unknowns of an element; an unknown may be appended several times.
void append_reduced_unknowns(const ElementDofs& s, const Elimination& z, Index e,
                             std::vector<Index>& out) {
  for (Index k = 0; k < s.nodes.cols(); ++k)
    for (int c = 0; c < s.block; ++c) {
      const Index i = s.block * s.nodes(e, k) + c;
      for (const auto& q : z.row(i)) out.push_back(q.reduced);
    }
}

}  // namespace

SparsePattern reduced_pattern(const std::vector<const ElementDofs*>& terms,
                              const Elimination& elimination) {
  const Index n = elimination.reduced_size();
  // The unknowns of all elements, one element after the other, and the elements of each unknown.
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
  p.column_starts.reserve(to_size(n) + 1);
  std::vector<Index> mark(to_size(n), -1), below;
  const auto elements_of = [&](Index c) {
    return std::span(elements).subspan(element_starts[c],
                                       element_starts[c + 1] - element_starts[c]);
  };
  for (Index c = 0; c < n; ++c) {
    const auto with = elements_of(c);
    below.clear();
    if (c > 0 && !with.empty() && std::ranges::equal(with, elements_of(c - 1))) {
      // The unknown before is of the same node: its column holds the rows of this one, after its
      // diagonal and the row of this unknown.
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
  p.rows.shrink_to_fit();
  p.block_of = node_blocks(terms, elimination);
  return p;
}

std::vector<Index> node_blocks(const std::vector<const ElementDofs*>& terms,
                               const Elimination& elimination) {
  // A node has as many unknowns as in the term with most unknowns a node.
  int block = 1;
  for (const ElementDofs* s : terms) block = std::max(block, s->block);
  std::vector<Index> block_of;
  block_of.reserve(to_size(elimination.reduced_size()));
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
    : nodes_(static_cast<int>(element_dofs.nodes.cols())), block_(element_dofs.block) {
  const Index count = element_dofs.element_count();
  unknown_.assign(to_size(count) * to_size(nodes_), -1);
  slot_.assign(to_size(count) * pairs() * to_size(block_), -1);
  std::vector<char> is_direct(to_size(count));
  const auto place = [&](Index task, int) {
    std::vector<int> order;
    const Index last = std::min(count, (task + 1) * kElementsOfATask);
    for (Index e = task * kElementsOfATask; e < last; ++e) {
      is_direct[e] = find_unknowns(e, element_dofs, elimination);
      if (is_direct[e]) find_slots(e, pattern, order);
    }
  };
  parallel_tasks((count + kElementsOfATask - 1) / kElementsOfATask, place);
  for (Index e = 0; e < count; ++e)
    if (!is_direct[e]) build_general(e, element_dofs, elimination, pattern);
}

bool ScatterMap::find_unknowns(Index e, const ElementDofs& s, const Elimination& z) {
  Index* unknown = unknown_.data() + to_size(e) * to_size(nodes_);
  for (int k = 0; k < s.node_count(e); ++k) {
    for (int c = 0; c < block_; ++c) {
      const Index x = block_ * s.nodes(e, k) + c;
      const Elimination::Row row = z.row(x);
      const bool is_fixed = row.size() == 0;
      if (!is_fixed && (row.size() > 1 || row.begin()->coefficient != 1.0)) return false;
      const Index reduced = is_fixed ? -1 : row.begin()->reduced - c;
      // A later unknown of the node is reduced unknown 0, so its first unknown is fixed.
      if (!is_fixed && reduced < 0) return false;
      if (c > 0 && reduced != unknown[k]) return false;
      unknown[k] = reduced;
    }
    // An unknown that occurs twice in an element needs both off-diagonal copies: general path.
    for (int j = 0; j < k; ++j)
      if (unknown[k] >= 0 && unknown[j] >= 0 && std::abs(unknown[k] - unknown[j]) < block_)
        return false;
  }
  return true;
}

// Reads each column once: its rows and the element's unknowns are both ascending.
void ScatterMap::find_slots(Index e, const SparsePattern& pattern, std::vector<int>& order) {
  const Index* unknown = unknown_.data() + to_size(e) * to_size(nodes_);
  Index* slots = slot_.data() + to_size(e) * pairs() * to_size(block_);
  order.clear();
  for (int k = 0; k < nodes_; ++k)
    if (unknown[k] >= 0) order.push_back(k);
  std::ranges::sort(order, {}, [&](int k) { return unknown[k]; });
  for (auto column = order.begin(); column != order.end(); ++column)
    for (int c = 0; c < block_; ++c) {
      Index slot = pattern.diagonal_slot(unknown[*column] + c);
      for (auto row = column; row != order.end(); ++row) {
        while (row != column && pattern.rows[slot] < unknown[*row]) ++slot;
        const auto [low, high] = std::minmax(*row, *column);
        slots[(high * (high + 1) / 2 + low) * block_ + c] = slot;
      }
    }
}

ScatterMap ScatterMap::moved(const std::vector<Index>& places) const {
  ScatterMap out = *this;
  for (Index& slot : out.slot_)
    if (slot >= 0) slot = places[slot];
  for (auto& contributions : out.general_)
    for (Contribution& c : contributions) c.slot = places[c.slot];
  return out;
}

void ScatterMap::build_general(Index e, const ElementDofs& s, const Elimination& z,
                               const SparsePattern& pattern) {
  general_of_.resize(to_size(s.element_count()), -1);
  general_of_[e] = static_cast<Index>(general_.size());
  std::vector<Contribution> contributions;
  std::vector<std::pair<int, Target>> gradient;
  const auto full = [&](int i) { return s.block * s.nodes(e, i / s.block) + i % s.block; };
  const int local_size = s.node_count(e) * block_;
  for (int i = 0; i < local_size; ++i) {
    for (const auto& p : z.row(full(i))) {
      gradient.push_back({i, {p.reduced, p.coefficient}});
      for (int j = 0; j < local_size; ++j) {
        const int packed = std::max(i, j) * (std::max(i, j) + 1) / 2 + std::min(i, j);
        for (const auto& q : z.row(full(j)))
          if (p.reduced >= q.reduced)
            contributions.push_back(
                {packed, pattern.slot(p.reduced, q.reduced), p.coefficient * q.coefficient});
      }
    }
  }
  general_.push_back(std::move(contributions));
  general_gradient_.push_back(std::move(gradient));
}

ScatterMap::Slots ScatterMap::share(const SparsePattern& pattern, Index part, Index parts) {
  const auto before = [&](Index k) {
    const auto slots = static_cast<std::int64_t>(pattern.nonzeros()) * k / parts;
    return *std::lower_bound(pattern.column_starts.begin(), pattern.column_starts.end(), slots);
  };
  return {before(part), before(part + 1)};
}

void ScatterMap::add_hessian(Index element, const LocalSystem& local, int p, double factor,
                             double* values, const Slots& own) const {
  if (const Index g = general_of(element); g >= 0) {
    for (const Contribution& c : general_[g])
      if (own.has(c.slot))
        values[c.slot] += factor * c.coefficient * local.hessian[c.local * LocalSystem::stride + p];
    return;
  }
  const Index* unknown = unknown_.data() + to_size(element) * to_size(nodes_);
  const Index* slot = slot_.data() + to_size(element) * pairs() * to_size(block_);
  const auto entry = [&](int row, int column) {
    return factor * local.hessian[(row * (row + 1) / 2 + column) * LocalSystem::stride + p];
  };
  for (int k = 0; k < nodes_; ++k)
    for (int j = 0; j <= k; ++j, slot += block_) {
      if (slot[0] < 0) continue;
      const int row = k * block_, column = j * block_;
      for (int c = 0; c < block_; ++c) {
        if (!own.has(slot[c])) continue;
        double* to = values + slot[c];
        if (j == k)
          for (int r = c; r < block_; ++r) *to++ += entry(row + r, column + c);
        else if (unknown[j] < unknown[k])
          for (int r = 0; r < block_; ++r) *to++ += entry(row + r, column + c);
        else
          for (int r = 0; r < block_; ++r) *to++ += entry(row + c, column + r);
      }
    }
}

void ScatterMap::add_gradient(Index element, const LocalSystem& local, int p, double factor,
                              double* gradient) const {
  if (const Index g = general_of(element); g >= 0) {
    for (const auto& [i, target] : general_gradient_[g])
      gradient[target.reduced] +=
          factor * target.coefficient * local.gradient[i * LocalSystem::stride + p];
    return;
  }
  const Index* unknown = unknown_.data() + to_size(element) * to_size(nodes_);
  const double* g = local.gradient + p;
  for (int k = 0; k < nodes_; ++k)
    for (int c = 0; c < block_; ++c, g += LocalSystem::stride)
      if (unknown[k] >= 0) gradient[unknown[k] + c] += factor * *g;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
