#include "majorant/framework/internal/covered_nodes.h"

#include <algorithm>
#include <span>
#include <utility>

namespace majorant {
namespace {

// The number of nodes of the sample, evenly spaced, and the mean number of nodes that one of them
// covers from which on many nodes are covered. The mean is at least 1.5 on elements of degree 2,
// and at most 0.1 on straight ones.
constexpr Index kSampleNodes = 1000;
constexpr double kManyCovered = 0.5;

// Finds the nodes that a node covers.
class CoverSearch {
 public:
  explicit CoverSearch(const BlockNeighbours& near)
      : near_(near), mark_(to_size(near.size()), -1) {}

  // Calls use(x) for each neighbour x that the node covers and for which open(x) is true.
  template <class Open, class Use>
  void visit(Index node, const Open& open, const Use& use) {
    const std::span<const Index> around = near_.of(node);
    bool is_marked = false;
    for (const Index x : around) {
      const std::span<const Index> others = near_.of(x);
      // Nodes with the same neighbours cover each other: the first one covers the others.
      if (others.size() > around.size() || (others.size() == around.size() && x < node)) continue;
      if (!open(x)) continue;
      if (!std::exchange(is_marked, true)) {
        for (const Index y : around) mark_[y] = node;
        mark_[node] = node;
      }
      if (std::all_of(others.begin(), others.end(), [&](Index y) { return mark_[y] == node; }))
        use(x);
    }
  }

 private:
  const BlockNeighbours& near_;
  std::vector<Index> mark_;  // the node whose neighbours were marked last
};

}  // namespace

bool has_many_covered_nodes(const BlockNeighbours& near) {
  if (near.size() == 0) return false;
  CoverSearch search(near);
  const Index samples = std::min(kSampleNodes, near.size());
  Index covered = 0;
  for (Index k = 0; k < samples; ++k)
    search.visit(
        static_cast<Index>(static_cast<std::int64_t>(near.size()) * k / samples),
        [](Index) { return true; }, [&](Index) { ++covered; });
  return covered >= kManyCovered * samples;
}

std::vector<Index> uncovered_nodes(const BlockNeighbours& near) {
  std::vector<char> is_covered(to_size(near.size()), 0);
  CoverSearch search(near);
  for (Index node = 0; node < near.size(); ++node)
    search.visit(
        node, [&](Index x) { return !is_covered[x]; }, [&](Index x) { is_covered[x] = 1; });
  std::vector<Index> out;
  for (Index node = 0; node < near.size(); ++node)
    if (!is_covered[node]) out.push_back(node);
  return out;
}

std::vector<Index> order_with_covered(const BlockNeighbours& near,
                                      const std::vector<Index>& uncovered) {
  std::vector<char> is_covered(to_size(near.size()), 1);
  for (const Index node : uncovered) is_covered[node] = 0;
  std::vector<Index> order;
  order.reserve(to_size(near.size()));
  CoverSearch search(near);
  for (const Index node : uncovered) {
    const auto first = static_cast<std::ptrdiff_t>(order.size());
    search.visit(
        node, [&](Index x) { return is_covered[x] != 0; },
        [&](Index x) {
          order.push_back(x);
          is_covered[x] = 0;
        });
    // The nodes of interiors of elements come before those of edges.
    std::stable_sort(order.begin() + first, order.end(),
                     [&](Index a, Index b) { return near.of(a).size() < near.of(b).size(); });
    order.push_back(node);
  }
  return order;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
