// Separators of graphs, tested by their definition, and orders by them for any graph and number of
// threads. covered_nodes_test.cpp tests their quality.
#include "majorant/framework/internal/surface_dissection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>
#include <set>

#include "framework/random_matrix.h"
#include "majorant/framework/internal/coarse_graph.h"
#include "majorant/framework/internal/vertex_cut.h"
#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

using Edges = std::set<std::pair<Index, Index>>;  // the smaller node first

BlockNeighbours graph_of(Index nodes, const Edges& edges) {
  SparsePattern pattern;
  for (Index node = 0; node < nodes; ++node) {
    std::vector<Index> column;
    for (const auto& [a, b] : edges)
      if (a == node) column.push_back(b);
    pattern.append_column(column);
  }
  pattern.order_in_blocks(1);
  return BlockNeighbours(BlockGraph(pattern));
}

Edges random_edges(test::Random& random, Index nodes, Index count) {
  Edges edges;
  for (Index k = 0; k < count; ++k) {
    const Index a = random.integer(0, nodes - 1), b = random.integer(0, nodes - 1);
    if (a != b) edges.insert(std::minmax(a, b));
  }
  return edges;
}

// Returns whether without `removed`, a set of bits, no path leads from a source to a sink.
bool separates(const BlockNeighbours& near, const std::vector<VertexCut::Terminal>& terminals,
               unsigned removed) {
  std::vector<Index> open;
  unsigned seen = removed;
  const auto reach = [&](Index node) {
    if ((seen >> node & 1U) != 0) return;
    seen |= 1U << node;
    open.push_back(node);
  };
  for (Index k = 0; k < near.size(); ++k)
    if (terminals[k] == VertexCut::Terminal::Source) reach(k);
  while (!open.empty()) {
    const Index node = open.back();
    open.pop_back();
    if (terminals[node] == VertexCut::Terminal::Sink) return false;
    for (const Index other : near.of(node)) reach(other);
  }
  return true;
}

TEST(VertexCut, IsTheSmallestSeparator) {
  using enum VertexCut::Terminal;
  using Side = VertexCut::Side;
  test::Random random(7);
  int different = 0;
  for (int run = 0; run < 400; ++run) {
    SCOPED_TRACE(run);
    const Index nodes = 2 + random.integer(0, 9);
    const BlockNeighbours near =
        graph_of(nodes, random_edges(random, nodes, nodes + random.integer(0, 11)));
    std::vector<VertexCut::Terminal> terminals(to_size(nodes), None);
    for (auto& terminal : terminals)
      if (const Index kind = random.integer(0, 3); kind < 2) terminal = kind == 0 ? Source : Sink;
    int fewest = nodes;
    for (unsigned set = 0; set < 1U << nodes; ++set)
      if (std::popcount(set) < fewest && separates(near, terminals, set))
        fewest = std::popcount(set);

    const VertexCut cut(near, terminals);
    different += cut.near_sources() != cut.near_sinks();
    for (const std::vector<Side>* sides : {&cut.near_sources(), &cut.near_sinks()}) {
      ASSERT_EQ(sides->size(), to_size(nodes));
      EXPECT_EQ(std::ranges::count(*sides, Side::Separator), fewest);
      for (Index k = 0; k < nodes; ++k) {
        const Side side = (*sides)[k];
        if (terminals[k] == Source) {
          EXPECT_NE(side, Side::Sinks);
        }
        if (terminals[k] == Sink) {
          EXPECT_NE(side, Side::Sources);
        }
        if (side != Side::Sources) continue;
        for (const Index other : near.of(k)) EXPECT_NE((*sides)[other], Side::Sinks);
      }
    }
    for (Index k = 0; k < nodes; ++k)
      if (cut.near_sources()[k] == Side::Sources) {
        EXPECT_EQ(cut.near_sinks()[k], Side::Sources) << "nearer to the sinks";
      }
  }
  EXPECT_GT(different, 50);
}

// Returns the edges of a grid of squares, cut along a diagonal.
Edges grid_edges(Index side) {
  Edges edges;
  for (Index y = 0; y < side; ++y)
    for (Index x = 0; x < side; ++x) {
      const Index node = y * side + x;
      if (x + 1 < side) edges.insert({node, node + 1});
      if (y + 1 < side) edges.insert({node, node + side});
      if (x + 1 < side && y + 1 < side) edges.insert({node, node + side + 1});
    }
  return edges;
}

BlockNeighbours grid(Index side) {
  BlockNeighbours out;
  std::vector<std::vector<Index>> near(to_size(side * side));
  for (const auto& [a, b] : grid_edges(side)) {
    near[a].push_back(b);
    near[b].push_back(a);
  }
  for (const std::vector<Index>& of_one : near) {
    out.nodes.insert(out.nodes.end(), of_one.begin(), of_one.end());
    out.starts.push_back(static_cast<Index>(out.nodes.size()));
  }
  return out;
}

TEST(CoarseGraph, CountsNodesAndEdges) {
  const Edges edges = grid_edges(30);
  const BlockNeighbours near = graph_of(900, edges);
  EXPECT_EQ(CoarseGraph(near, 900).graph.near.nodes, near.nodes) << "few enough";
  const CoarseGraph coarse(near, 100);
  const Index size = coarse.graph.size();
  EXPECT_LE(size, 100);
  std::vector<Index> weights(to_size(size), 0);
  for (const Index node : coarse.node_of) ++weights[node];
  EXPECT_EQ(coarse.graph.weights, weights);
  std::map<std::pair<Index, Index>, Index> expected, found;
  for (const auto& [a, b] : edges)
    if (const Index p = coarse.node_of[a], q = coarse.node_of[b]; p != q)
      ++expected[{p, q}], ++expected[{q, p}];
  for (Index p = 0; p < size; ++p)
    for (Index e = coarse.graph.near.starts[p]; e < coarse.graph.near.starts[p + 1]; ++e)
      EXPECT_TRUE(
          found.insert({{p, coarse.graph.near.nodes[e]}, coarse.graph.edge_weights[e]}).second);
  EXPECT_EQ(found, expected);
}

void expect_permutation(std::vector<Index> order, Index nodes) {
  std::ranges::sort(order);
  std::vector<Index> all(to_size(nodes));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
}

TEST(SurfaceDissection, OrdersEveryGraph) {
  const auto expect_ordered = [](Index nodes, const Edges& edges) {
    SCOPED_TRACE(nodes);
    expect_permutation(surface_dissection(graph_of(nodes, edges)), nodes);
  };
  expect_ordered(0, {});
  expect_ordered(1, {});
  expect_ordered(2500, {});
  Edges star, path, two, dense;
  for (Index k = 1; k < 3000; ++k) {
    star.insert({0, k});
    path.insert({k - 1, k});
    if (k != 1500) two.insert({k - 1, k});
  }
  for (Index a = 0; a < 60; ++a)
    for (Index b = a + 1; b < 60; ++b) dense.insert({a, b});
  expect_ordered(3000, star);
  expect_ordered(3000, path);
  expect_ordered(3000, two);
  expect_ordered(2200, dense);
  test::Random random(11);
  for (const Index edges : {500, 3000, 20000})
    expect_ordered(4000, random_edges(random, 4000, edges));
}

TEST(SurfaceDissection, IsTheSameOnAnyNumberOfThreads) {
  const BlockNeighbours near = grid(120);
  std::vector<std::vector<Index>> orders;
  for (const int threads : {1, 2, 3}) {
    const ThreadCount count(threads);
    orders.push_back(surface_dissection(near));
  }
  expect_permutation(orders[0], near.size());
  EXPECT_EQ(orders[1], orders[0]);
  EXPECT_EQ(orders[2], orders[0]);
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
