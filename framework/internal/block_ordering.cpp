#include "majorant/framework/internal/block_ordering.h"

#include <amd.h>
#include <metis.h>

#include <cmath>
#include <new>
#include <numeric>
#include <type_traits>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/internal/block_neighbours.h"
#include "majorant/framework/internal/covered_nodes.h"
#include "majorant/framework/internal/metis_scope.h"

namespace majorant {
namespace {

static_assert(std::is_same_v<idx_t, Index>, "METIS is compiled with 32 bit indices");
static_assert(std::is_same_v<int, Index>, "AMD's other functions have 64 bits");

// Operations of a factorization by AMD's order, for each edge of the graph, from which on METIS
// pays within about five factorizations: it takes a microsecond an edge and saves a third to a half
// of the operations. Surfaces come there with some 300,000 faces, solids with 3,000 nodes.
constexpr double kMetisOperationsPerEdge = 2000;

// Nodes of a graph below which its corners are not looked for: its order takes no time.
constexpr Index kFewNodes = 100;

std::vector<Index> as_numbered(Index size) {
  std::vector<Index> order(to_size(size));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

// AMD eats the graph.
MinimumDegreeOrder minimum_degree_order(BlockNeighbours near) {
  const Index n = near.size();
  std::vector<Index> lengths(to_size(n)), order(to_size(n));
  for (std::size_t k = 0; k < lengths.size(); ++k) lengths[k] = near.starts[k + 1] - near.starts[k];
  const auto used = static_cast<Index>(near.nodes.size());
  const std::size_t room = near.nodes.size() + near.nodes.size() / 2 + to_size(n);  // to work in
  counted("numbers that AMD works on", room);
  near.nodes.resize(room);
  // Six arrays of scratch memory; their use is AMD's own.
  std::vector<Index> scratch(6 * to_size(n));
  const auto array = [&](std::size_t k) { return scratch.data() + k * to_size(n); };
  double info[AMD_INFO];
  amd_2(n, near.starts.data(), near.nodes.data(), lengths.data(),
        static_cast<Index>(near.nodes.size()), used, array(0), array(1), order.data(), array(2),
        array(3), array(4), array(5), nullptr, info);
  return {std::move(order), info[AMD_NMULTSUBS_LDL]};
}

}  // namespace

MinimumDegreeOrder minimum_degree_order(const BlockGraph& graph) {
  if (graph.edges() == 0) return {as_numbered(graph.size())};
  BlockNeighbours near(graph);
  if (near.size() < kFewNodes || !has_many_covered_nodes(near))
    return minimum_degree_order(std::move(near));
  const std::vector<Index> corners = uncovered_nodes(near);
  MinimumDegreeOrder found = minimum_degree_order(near.among(corners));
  for (Index& k : found.order) k = corners[k];
  // On surfaces, separators grow as the root of the nodes, factorizations as their cube.
  found.operations *= std::pow(static_cast<double>(near.size()) / corners.size(), 1.5);
  found.order = order_with_covered(near, found.order);
  return found;
}

std::vector<Index> nested_dissection_order(const BlockGraph& graph) {
  if (graph.edges() == 0) return as_numbered(graph.size());
  BlockNeighbours near(graph);
  Index n = graph.size();
  std::vector<Index> order(to_size(n)), inverse(to_size(n));
  const MetisScope scope;
  if (METIS_NodeND(&n, near.starts.data(), near.nodes.data(), nullptr, nullptr, order.data(),
                   inverse.data()) != METIS_OK)
    throw std::bad_alloc();
  return order;
}

FillReducingOrder fill_reducing_order(const BlockGraph& graph, Ordering method) {
  if (method != Ordering::Metis) {
    MinimumDegreeOrder found = minimum_degree_order(graph);
    if (method == Ordering::Amd ||
        found.operations <= kMetisOperationsPerEdge * static_cast<double>(graph.edges()))
      return {Ordering::Amd, std::move(found.order)};
  }
  return {Ordering::Metis, nested_dissection_order(graph)};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
