#include "majorant/framework/internal/block_neighbours.h"

#include <numeric>

#include "majorant/framework/argument_check.h"

namespace majorant {

BlockNeighbours::BlockNeighbours(const BlockGraph& graph) : starts(to_size(graph.size()) + 1, 0) {
  counted("neighbours in the graph of a pattern", 2 * graph.edges());
  const auto visit = [&](const auto& use) {
    for (Index a = 0; a < graph.size(); ++a)
      for (const Index b : graph.larger(a)) use(a, b);
  };
  visit([&](Index a, Index b) { ++starts[a + 1], ++starts[b + 1]; });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  nodes.resize(to_size(starts.back()));
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  visit([&](Index a, Index b) {
    nodes[next[a]++] = b;
    nodes[next[b]++] = a;
  });
}

BlockNeighbours BlockNeighbours::among(const std::vector<Index>& some) const {
  std::vector<Index> number(to_size(size()), -1);
  for (std::size_t k = 0; k < some.size(); ++k) number[some[k]] = static_cast<Index>(k);
  BlockNeighbours out;
  out.starts.reserve(some.size() + 1);
  for (const Index node : some) {
    for (const Index other : of(node))
      if (number[other] >= 0) out.nodes.push_back(number[other]);
    out.starts.push_back(static_cast<Index>(out.nodes.size()));
  }
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
