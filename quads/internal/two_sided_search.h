// A bidirectional Dijkstra search for a cheapest path.
//
//   TwoSidedSearch search(network.node_count());
//   search.ahead.reach(0, 0, -1);   // from node 0
//   search.back.reach(7, 0, -1);    // to node 7
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "majorant/mesh/surface_mesh.h"

namespace majorant {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

// One side of a search: cheapest paths from some nodes, or to them, found in the order of their
// costs.
class Frontier {
 public:
  struct Reached {
    double cost = kNever;
    Index step = -1;  // last step of its path; -1 for a start node
    bool is_final = false;
  };

  explicit Frontier(Index nodes) : reached_(to_size(nodes)) {}

  void clear();
  void reach(Index node, double cost, Index step);
  // Returns the cost of the next node; kNever if there is none.
  double least_cost();
  // Returns the next node. Call it after least_cost().
  Index take();

  const Reached& at(Index node) const { return reached_[node]; }
  const std::vector<Index>& touched() const { return touched_; }
  std::size_t width() const { return queue_.size(); }

 private:
  Index pop();

  std::vector<Reached> reached_;  // by node
  std::vector<Index> touched_;
  std::vector<std::pair<double, Index>> queue_;  // a heap
};

struct TwoSidedSearch {
  explicit TwoSidedSearch(Index nodes) : ahead(nodes), back(nodes) {}
  Frontier ahead, back;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
