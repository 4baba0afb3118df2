#include "majorant/framework/internal/colored_batches.h"

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
    starts.assign(to_size(count) + 1, 0);
    for (Eigen::Index k = 0; k < nodes.size(); ++k) ++starts[to_size(nodes.data()[k]) + 1];
    for (std::size_t k = 1; k < starts.size(); ++k) starts[k] += starts[k - 1];
    elements.resize(static_cast<std::size_t>(nodes.size()));
    std::vector<std::size_t> place(starts.begin(), starts.end() - (starts.empty() ? 0 : 1));
    for (Index e = 0; e < nodes.rows(); ++e)
      for (Index k = 0; k < nodes.cols(); ++k) elements[place[nodes(e, k)]++] = e;
  }
};

// Returns a breadth-first order of the elements over shared nodes, which keeps neighbours close.
std::vector<Index> local_order(const Cells& nodes) {
  const NodeToElements around(nodes);
  std::vector<Index> order;
  order.reserve(static_cast<std::size_t>(nodes.rows()));
  std::vector<char> seen(static_cast<std::size_t>(nodes.rows()), 0);
  for (Index seed = 0; seed < nodes.rows(); ++seed) {
    if (seen[seed]) continue;
    seen[seed] = 1;
    std::size_t head = order.size();
    order.push_back(seed);
    for (; head < order.size(); ++head) {
      for (Index k = 0; k < nodes.cols(); ++k) {
        const auto n = to_size(nodes(order[head], k));
        for (std::size_t q = around.starts[n]; q < around.starts[n + 1]; ++q) {
          const Index e = around.elements[q];
          if (seen[e]) continue;
          seen[e] = 1;
          order.push_back(e);
        }
      }
    }
  }
  return order;
}

// An unknown of more elements is wide; almost no vertex has as many.
constexpr Index kWide = 24;

// Calls visit(j) for the reduced unknowns of an element, repeatedly where they occur repeatedly.
template <class Visit>
void visit_unknowns(const ElementDofs& s, const Elimination& z, Index e, const Visit& visit) {
  for (Index k = 0; k < s.nodes.cols(); ++k)
    for (int c = 0; c < s.block; ++c) {
      const Index x = s.block * s.nodes(e, k) + c;
      for (const auto& q : z.row(x)) visit(q.reduced);
    }
}

// Returns for each element its first unknown that more than kWide elements have, or -1.
std::vector<Index> wide_unknowns(const ElementDofs& s, const Elimination& z) {
  std::vector<Index> count(to_size(z.reduced_size()), 0), last(to_size(z.reduced_size()), -1);
  for (Index e = 0; e < s.element_count(); ++e)
    visit_unknowns(s, z, e, [&](Index j) {
      if (last[j] != e) ++count[j];
      last[j] = e;
    });
  std::vector<Index> wide(to_size(s.element_count()), -1);
  for (Index e = 0; e < s.element_count(); ++e)
    visit_unknowns(s, z, e, [&](Index j) {
      if (count[j] > kWide && (wide[e] < 0 || j < wide[e])) wide[e] = j;
    });
  return wide;
}

}  // namespace

// Greedy colouring: each batch gets the lowest colour that no batch sharing anything has. Each
// shared thing has a mask with a bit for each colour; batches that find none of 64 get a colour
// each.
template <class Touched>
void ColoredBatches::colour(Index count, const Touched& touched) {
  std::vector<std::uint64_t> used(to_size(count));
  for (Index c = 0; c < batch_count(); ++c) {
    std::uint64_t taken = 0;
    for (const Index e : batch(c).elements) touched(e, [&](Index k) { taken |= used[k]; });
    const auto lowest = to_size(std::countr_one(taken));
    if (lowest >= 64) {
      colours_.push_back({c});
      continue;
    }
    if (colours_.size() <= lowest) colours_.resize(lowest + 1);
    colours_[lowest].push_back(c);
    for (const Index e : batch(c).elements)
      touched(e, [&](Index k) { used[k] |= std::uint64_t(1) << lowest; });
  }
}

ColoredBatches::ColoredBatches(const ElementDofs& element_dofs,
                               const std::vector<RuleId>& element_rule) {
  make_batches(element_dofs, element_rule, {});
  const Cells& nodes = element_dofs.nodes;
  colour(nodes.size() ? nodes.maxCoeff() + 1 : 0, [&](Index e, const auto& visit) {
    for (Index k = 0; k < nodes.cols(); ++k) visit(nodes(e, k));
  });
}

ColoredBatches::ColoredBatches(const ElementDofs& element_dofs,
                               const std::vector<RuleId>& element_rule,
                               const Elimination& elimination) {
  make_batches(element_dofs, element_rule, wide_unknowns(element_dofs, elimination));
  colour(elimination.reduced_size(),
         [&](Index e, const auto& visit) { visit_unknowns(element_dofs, elimination, e, visit); });
}

void ColoredBatches::make_batches(const ElementDofs& element_dofs,
                                  const std::vector<RuleId>& element_rule,
                                  const std::vector<Index>& group) {
  const auto key = [&](Index e) {
    const auto k = to_size(e);
    return std::pair(element_rule.empty() ? 0 : element_rule[k], group.empty() ? 0 : group[k]);
  };
  const auto rule = [&](Index e) { return element_rule.empty() ? 0 : element_rule[e]; };
  elements_ = local_order(element_dofs.nodes);
  const auto before = [&](Index a, Index b) { return key(a) < key(b); };
  if (!std::is_sorted(elements_.begin(), elements_.end(), before))
    std::stable_sort(elements_.begin(), elements_.end(), before);
  starts_.push_back(0);
  for (std::size_t k = 0; k < elements_.size();) {
    std::size_t end = k + 1;
    while (end < elements_.size() && end - k < ElementBatch::kMaxSize &&
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
