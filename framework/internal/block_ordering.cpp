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
#include "majorant/framework/internal/surface_dissection.h"

namespace majorant {
namespace {

static_assert(std::is_same_v<idx_t, Index>, "METIS is compiled with 32 bit indices");
static_assert(std::is_same_v<int, Index>, "AMD's other functions have 64 bits");

// METIS pays within about five factorizations if AMD's order takes at least this many operations
// for each edge of the graph. METIS takes a microsecond an edge and saves a third to a half of the
// operations. Surfaces of 300,000 faces and solids of 3,000 nodes are at this limit.
constexpr double kMetisOperationsPerEdge = 2000;

// A graph with at most kSurfaceEdges edges for each node is that of a surface. Two conditions must
// hold for a dissection: the graph has at least kFewCorners corners, and the number of nodes on a
// separator is at least kDissectionRoot. That number is estimated as the root of the corners times
// the nodes of each edge. Smaller factors save less time than the dissection takes: surfaces below
// 300,000 faces at degree 1, below 16,000 above.
constexpr double kSurfaceEdges = 4.5, kFewCorners = 8000, kDissectionRoot = 390;

// Graphs with fewer nodes are ordered whole, without a search for corners: it takes no time.
constexpr Index kFewNodes = 100;

std::vector<Index> as_numbered(Index size) {
  std::vector<Index> order(to_size(size));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

MinimumDegreeOrder minimum_degree_order(BlockNeighbours near) {  // AMD overwrites the graph
  const Index n = near.size();
  std::vector<Index> lengths(to_size(n)), order(to_size(n));
  for (std::size_t k = 0; k < lengths.size(); ++k) lengths[k] = near.starts[k + 1] - near.starts[k];
  const auto used = static_cast<Index>(near.nodes.size());
  const std::size_t room = near.nodes.size() + near.nodes.size() / 2 + to_size(n);  // working
                                                                                    // memory
  counted("numbers that AMD works on", room);
  near.nodes.resize(room);
  // Six arrays of scratch memory that AMD needs.
  std::vector<Index> scratch(6 * to_size(n));
  const auto array = [&](std::size_t k) { return scratch.data() + k * to_size(n); };
  double info[AMD_INFO];
  amd_2(n, near.starts.data(), near.nodes.data(), lengths.data(),
        static_cast<Index>(near.nodes.size()), used, array(0), array(1), order.data(), array(2),
        array(3), array(4), array(5), nullptr, info);
  return {std::move(order), info[AMD_NMULTSUBS_LDL]};
}

// The graph of the nodes that are ordered; covered nodes follow them (covered_nodes.h).
class CornerGraph {
 public:
  explicit CornerGraph(const BlockGraph& graph) : near_(graph) {
    if (near_.size() < kFewNodes || !has_many_covered_nodes(near_)) return;
    corners_ = uncovered_nodes(near_);
    among_corners_ = near_.among(corners_);
  }
  const BlockNeighbours& near() const { return corners_.empty() ? near_ : among_corners_; }
  // The number of all nodes for each node of near().
  double share() const { return static_cast<double>(near_.size()) / near().size(); }
  std::vector<Index> all(std::vector<Index> order) const {
    if (corners_.empty()) return order;
    for (Index& k : order) k = corners_[k];
    return order_with_covered(near_, order);
  }

 private:
  BlockNeighbours near_, among_corners_;
  std::vector<Index> corners_;  // empty: all nodes
};

MinimumDegreeOrder minimum_degree_order(const CornerGraph& corners) {
  if (corners.near().nodes.empty()) return {corners.all(as_numbered(corners.near().size()))};
  MinimumDegreeOrder found = minimum_degree_order(corners.near());
  // On surfaces, separators grow as the root of the nodes, and factorizations as the cube of that.
  found.operations *= std::pow(corners.share(), 1.5);
  found.order = corners.all(std::move(found.order));
  return found;
}

// Surfaces have at most three edges for each node, and four where their cells are quadrilaterals.
bool is_surface(const BlockNeighbours& near) {
  return static_cast<double>(near.nodes.size()) / 2 <= kSurfaceEdges * near.size();
}

// The length of a separator of a surface is about the root of its nodes, times the nodes of an
// edge.
bool is_worth_dissection(const CornerGraph& corners) {
  const double nodes = corners.near().size();
  return nodes >= kFewCorners && is_surface(corners.near()) &&
         std::pow(corners.share(), 1.5) * std::sqrt(nodes) >= kDissectionRoot;
}

}  // namespace

MinimumDegreeOrder minimum_degree_order(const BlockGraph& graph) {
  return minimum_degree_order(CornerGraph(graph));
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
  if (method == Ordering::Metis) return {method, nested_dissection_order(graph)};
  const CornerGraph corners(graph);
  if (method == Ordering::Dissection ||
      (method == Ordering::Automatic && is_worth_dissection(corners)))
    return {Ordering::Dissection, corners.all(surface_dissection(corners.near()))};
  MinimumDegreeOrder found = minimum_degree_order(corners);
  if (method == Ordering::Amd ||
      found.operations <= kMetisOperationsPerEdge * static_cast<double>(graph.edges()))
    return {Ordering::Amd, std::move(found.order)};
  return {Ordering::Metis, nested_dissection_order(graph)};
}

std::string_view name_of(Ordering ordering) {
  switch (ordering) {
    case Ordering::Metis:
      return "METIS";
    case Ordering::Dissection:
      return "nested dissection";
    default:
      return "AMD";
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
