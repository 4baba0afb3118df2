#include "majorant/framework/internal/chunk_plan.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace majorant {
namespace {

struct NodeToElements {
  std::vector<std::size_t> starts;
  std::vector<Index> elements;

  explicit NodeToElements(const Cells& nodes) {
    const Index count = nodes.size() ? nodes.maxCoeff() + 1 : 0;
    starts.assign(at(count) + 1, 0);
    for (Eigen::Index k = 0; k < nodes.size(); ++k) ++starts[at(nodes.data()[k]) + 1];
    for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
    elements.resize(static_cast<std::size_t>(nodes.size()));
    std::vector<std::size_t> place(starts.begin(), starts.end() - (starts.empty() ? 0 : 1));
    for (Index e = 0; e < nodes.rows(); ++e)
      for (Index k = 0; k < nodes.cols(); ++k) elements[place[at(nodes(e, k))]++] = e;
  }
};

// Breadth-first order of the elements over shared nodes: neighbours come close together.
std::vector<Index> local_order(const Cells& nodes) {
  const NodeToElements around(nodes);
  std::vector<Index> order;
  order.reserve(static_cast<std::size_t>(nodes.rows()));
  std::vector<char> seen(static_cast<std::size_t>(nodes.rows()), 0);
  for (Index seed = 0; seed < nodes.rows(); ++seed) {
    if (seen[at(seed)]) continue;
    seen[at(seed)] = 1;
    std::size_t head = order.size();
    order.push_back(seed);
    for (; head < order.size(); ++head) {
      for (Index k = 0; k < nodes.cols(); ++k) {
        const auto n = at(nodes(order[head], k));
        for (std::size_t q = around.starts[n]; q < around.starts[n + 1]; ++q) {
          const Index e = around.elements[q];
          if (seen[at(e)]) continue;
          seen[at(e)] = 1;
          order.push_back(e);
        }
      }
    }
  }
  return order;
}

// Elements. Origin: more than are around almost any vertex.
constexpr Index kWide = 24;

// Calls visit(j) for the reduced unknowns of an element, repeatedly where they occur repeatedly.
template <class Visit>
void visit_unknowns(const Stencils& s, const Elimination& z, Index e, const Visit& visit) {
  for (Index k = 0; k < s.nodes.cols(); ++k)
    for (int c = 0; c < s.block; ++c) {
      const Index x = s.block * s.nodes(e, k) + c;
      for (auto q = z.begin(x); q != z.end(x); ++q) visit(q->reduced);
    }
}

// By element: its first unknown that more than kWide elements have, or -1.
std::vector<Index> wide_unknowns(const Stencils& s, const Elimination& z) {
  std::vector<Index> count(at(z.reduced_size()), 0), last(at(z.reduced_size()), -1);
  for (Index e = 0; e < s.element_count(); ++e)
    visit_unknowns(s, z, e, [&](Index j) {
      if (last[at(j)] != e) ++count[at(j)];
      last[at(j)] = e;
    });
  std::vector<Index> wide(at(s.element_count()), -1);
  for (Index e = 0; e < s.element_count(); ++e)
    visit_unknowns(s, z, e, [&](Index j) {
      if (count[at(j)] > kWide && (wide[at(e)] < 0 || j < wide[at(e)])) wide[at(e)] = j;
    });
  return wide;
}

}  // namespace

// Greedy: the lowest colour that no chunk sharing anything has. Colours are bits of a mask per
// shared thing; should 64 not suffice, the remaining chunks get a colour each.
template <class Touched>
void ChunkPlan::colour(Index count, const Touched& touched) {
  std::vector<std::uint64_t> used(at(count));
  for (Index c = 0; c < chunk_count(); ++c) {
    std::uint64_t taken = 0;
    for (const Index e : chunk(c).elements) touched(e, [&](Index k) { taken |= used[at(k)]; });
    const auto lowest = at(std::countr_one(taken));
    if (lowest >= 64) {
      colours_.push_back({c});
      continue;
    }
    if (colours_.size() <= lowest) colours_.resize(lowest + 1);
    colours_[lowest].push_back(c);
    for (const Index e : chunk(c).elements)
      touched(e, [&](Index k) { used[at(k)] |= std::uint64_t(1) << lowest; });
  }
}

ChunkPlan::ChunkPlan(const Stencils& stencils, const std::vector<RuleId>& element_rule) {
  make_chunks(stencils, element_rule, {});
  const Cells& nodes = stencils.nodes;
  colour(nodes.size() ? nodes.maxCoeff() + 1 : 0, [&](Index e, const auto& visit) {
    for (Index k = 0; k < nodes.cols(); ++k) visit(nodes(e, k));
  });
}

ChunkPlan::ChunkPlan(const Stencils& stencils, const std::vector<RuleId>& element_rule,
                     const Elimination& elimination) {
  make_chunks(stencils, element_rule, wide_unknowns(stencils, elimination));
  colour(elimination.reduced_size(),
         [&](Index e, const auto& visit) { visit_unknowns(stencils, elimination, e, visit); });
}

void ChunkPlan::make_chunks(const Stencils& stencils, const std::vector<RuleId>& element_rule,
                            const std::vector<Index>& group) {
  const auto key = [&](Index e) {
    const auto k = at(e);
    return std::pair(element_rule.empty() ? 0 : element_rule[k], group.empty() ? 0 : group[k]);
  };
  const auto rule = [&](Index e) { return element_rule.empty() ? 0 : element_rule[at(e)]; };
  elements_ = local_order(stencils.nodes);
  const auto before = [&](Index a, Index b) { return key(a) < key(b); };
  if (!std::is_sorted(elements_.begin(), elements_.end(), before))
    std::stable_sort(elements_.begin(), elements_.end(), before);
  starts_.push_back(0);
  for (std::size_t k = 0; k < elements_.size();) {
    std::size_t end = k + 1;
    while (end < elements_.size() && end - k < Chunk::kMaxSize &&
           rule(elements_[end]) == rule(elements_[k]))
      ++end;
    rules_.push_back(rule(elements_[k]));
    starts_.push_back(end);
    k = end;
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
