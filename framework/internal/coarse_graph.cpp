#include "majorant/framework/internal/coarse_graph.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace majorant {
namespace {

// Coarsening ends when a pass leaves more than this part of the nodes.
constexpr double kShrinks = 0.7;

struct Clusters {
  std::vector<Index> of;  // each node
  Index count = 0;
};

// Makes a cluster of each node whose neighbours are in no cluster, and of these neighbours. The
// remaining nodes join the smallest neighbouring cluster.
Clusters clusters_of(const BlockNeighbours& near) {
  Clusters out{std::vector<Index>(to_size(near.size()), -1)};
  const auto is_free = [&](Index node) { return out.of[node] < 0; };
  std::vector<Index> sizes, left;
  for (Index node = 0; node < near.size(); ++node) {
    if (!is_free(node) || !std::ranges::all_of(near.of(node), is_free)) continue;
    out.of[node] = out.count;
    for (const Index other : near.of(node)) out.of[other] = out.count;
    sizes.push_back(1 + static_cast<Index>(near.of(node).size()));
    ++out.count;
  }
  for (Index node = 0; node < near.size(); ++node)
    if (is_free(node)) left.push_back(node);
  // The remaining nodes choose among the first clusters only, so that clusters stay round.
  std::vector<Index> chosen;
  for (const Index node : left) {
    Index best = -1;
    for (const Index other : near.of(node))
      if (!is_free(other) && (best < 0 || sizes[out.of[other]] < sizes[best])) best = out.of[other];
    chosen.push_back(best);  // exists: otherwise the node had made a cluster
    ++sizes[best];
  }
  for (std::size_t k = 0; k < left.size(); ++k) out.of[left[k]] = chosen[k];
  return out;
}

WeightedGraph contracted(const WeightedGraph& graph, const Clusters& clusters) {
  std::vector<Index> starts(to_size(clusters.count) + 1, 0), nodes(to_size(graph.size()));
  for (const Index cluster : clusters.of) ++starts[cluster + 1];
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<Index> next(starts.begin(), starts.end() - 1);
  for (Index node = 0; node < graph.size(); ++node) nodes[next[clusters.of[node]]++] = node;

  WeightedGraph out;
  std::vector<Index> place(to_size(clusters.count), -1);  // the place of the edge to each cluster
  for (Index cluster = 0; cluster < clusters.count; ++cluster) {
    const auto first = static_cast<Index>(out.near.nodes.size());
    Index weight = 0;
    for (Index k = starts[cluster]; k < starts[cluster + 1]; ++k) {
      const Index node = nodes[k];
      weight += graph.weights[node];
      for (Index e = graph.near.starts[node]; e < graph.near.starts[node + 1]; ++e) {
        const Index other = clusters.of[graph.near.nodes[e]];
        if (other == cluster) continue;
        if (place[other] < first) {
          place[other] = static_cast<Index>(out.near.nodes.size());
          out.near.nodes.push_back(other);
          out.edge_weights.push_back(0);
        }
        out.edge_weights[place[other]] += graph.edge_weights[e];
      }
    }
    out.weights.push_back(weight);
    out.near.starts.push_back(static_cast<Index>(out.near.nodes.size()));
  }
  return out;
}

}  // namespace

WeightedGraph WeightedGraph::among(std::span<const Index> some) const {
  std::vector<Index> number(to_size(size()), -1);
  for (std::size_t k = 0; k < some.size(); ++k) number[some[k]] = static_cast<Index>(k);
  WeightedGraph out;
  for (const Index node : some) {
    out.weights.push_back(weights[node]);
    for (Index e = near.starts[node]; e < near.starts[node + 1]; ++e)
      if (const Index other = number[near.nodes[e]]; other >= 0) {
        out.near.nodes.push_back(other);
        out.edge_weights.push_back(edge_weights[e]);
      }
    out.near.starts.push_back(static_cast<Index>(out.near.nodes.size()));
  }
  return out;
}

CoarseGraph::CoarseGraph(const BlockNeighbours& near, Index few)
    : graph{near, std::vector<Index>(to_size(near.size()), 1),
            std::vector<Index>(near.nodes.size(), 1)},
      node_of(to_size(near.size())) {
  std::iota(node_of.begin(), node_of.end(), 0);
  while (graph.size() > few) {
    const Clusters clusters = clusters_of(graph.near);
    if (clusters.count > kShrinks * graph.size()) return;
    graph = contracted(graph, clusters);
    for (Index& node : node_of) node = clusters.of[node];
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
