#include "majorant/framework/internal/block_ordering.h"

#include <amd.h>
#include <metis.h>

#include <new>
#include <numeric>
#include <type_traits>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/internal/metis_scope.h"

namespace majorant {
namespace {

static_assert(std::is_same_v<idx_t, Index>, "METIS is compiled with 32 bit indices");
static_assert(std::is_same_v<int, Index>, "AMD's other functions have 64 bits");

// The neighbours of every node, smaller and larger ones.
struct Neighbours {
  std::vector<Index> starts, nodes;

  explicit Neighbours(const BlockGraph& graph) : starts(to_size(graph.size()) + 1, 0) {
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
};

// Blocks from which METIS pays for ten factorizations: below, it takes longer to order than it
// saves against AMD.
constexpr Index kMetisBlocks = 75000;

std::vector<Index> as_numbered(Index size) {
  std::vector<Index> order(to_size(size));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

}  // namespace

std::vector<Index> minimum_degree_order(const BlockGraph& graph) {
  if (graph.edges() == 0) return as_numbered(graph.size());
  Neighbours near(graph);  // amd_2 eats it
  const Index n = graph.size();
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
  return order;
}

std::vector<Index> nested_dissection_order(const BlockGraph& graph) {
  if (graph.edges() == 0) return as_numbered(graph.size());
  Neighbours near(graph);
  Index n = graph.size();
  std::vector<Index> order(to_size(n)), inverse(to_size(n));
  const MetisScope scope;
  if (METIS_NodeND(&n, near.starts.data(), near.nodes.data(), nullptr, nullptr, order.data(),
                   inverse.data()) != METIS_OK)
    throw std::bad_alloc();
  return order;
}

Ordering chosen_ordering(Ordering asked, const BlockGraph& graph) {
  if (asked != Ordering::Automatic) return asked;
  return graph.size() < kMetisBlocks ? Ordering::Amd : Ordering::Metis;
}

std::vector<Index> fill_reducing_order(const BlockGraph& graph, Ordering chosen) {
  return chosen == Ordering::Metis ? nested_dissection_order(graph) : minimum_degree_order(graph);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
