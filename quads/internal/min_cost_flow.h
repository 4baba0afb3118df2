// A flow x >= least of least cost in the network of a quantization:
//     min sum_e (x_e - w_e)^2 weight_e / 2   over both edges e of every arc,
//     excess(v) = 0 at every node v with an equation,   least_e <= x_e <= most_e.
// It is computed by successive shortest paths with potentials p. Every step that the bounds allow
// has a reduced cost, its marginal cost + p(from) - p(to), of at least 0. By duality, cost - sum_v
// excess(v) p(v) / 2 is a lower bound of the cost.
//
//   const std::vector<Index> least(12, 1);                    // by arc
//   const std::vector<MinCostFlow::Cost> costs(12);
//   MinCostFlow flow(network, least);
//   flow.set_costs(costs);
//   if (flow.balance(search, stop)) std::cout << flow.twice(0) / 2.0 << " edges on arc 0\n";
#pragma once

#include <limits>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/quads/internal/flow_network.h"
#include "majorant/quads/internal/two_sided_search.h"

namespace majorant {

// A flow of least cost, which is updated when bounds become tighter or costs change: flow that new
// bounds forbid is rerouted along cheapest paths.
class MinCostFlow {
 public:
  // The number n of an arc costs (n - target)^2 weight.
  struct Cost {
    double target = 0, weight = 1;
  };

  MinCostFlow(const FlowNetwork& network, const std::vector<Index>& least)
      : network_(&network),
        least_(least),
        most_(least.size(), std::numeric_limits<Index>::max()),
        flow_(2 * least.size(), 0),
        price_(2 * flow_.size(), 0),
        excess_(to_size(network.node_count()), 0),
        potential_(to_size(network.node_count()), 0) {}

  // Sets costs by arc, which must outlive this. Every edge gets the flow that is cheapest at some
  // potentials; if costs change little, that is mostly the previous flow.
  void set_costs(const std::vector<Cost>& costs);

  // Balances the flow. Returns false if there is no flow, or none that costs less than `most`.
  bool balance(TwoSidedSearch& search, const StopCheck& stop, double most = kNever);

  // The smallest and the largest number of an arc.
  struct Bounds {
    Index least, most;
  };
  void set_bounds(Index arc, Bounds bounds);
  void set_least(Index arc, Index least) { set_bounds(arc, {least, most_[arc]}); }

  // These return bounds of an arc that is a half: at most the integer below, or at least the one
  // above.
  Bounds below(Index arc) const { return {least_[arc], twice(arc) / 2}; }
  Bounds above(Index arc) const { return {twice(arc) / 2 + 1, most_[arc]}; }
  // Returns the bounds whose integer is nearer to the target number.
  Bounds rounded(Index arc) const;

  // Returns a lower bound of the cost of a balanced flow with these bounds of an arc; kNever if it
  // is not below `most`. This flow, which is balanced, does not change.
  double cost_within(Index arc, Bounds bounds, TwoSidedSearch& search, double most);

  Index arc_count() const { return static_cast<Index>(least_.size()); }
  // Returns twice the number of an arc.
  Index twice(Index arc) const { return flow_[2 * arc] + flow_[2 * arc + 1]; }

  // Returns the cost of the arcs' numbers: half of the cost of the network's edges.
  double cost() const { return cost_; }

 private:
  // A shortest augmenting path: the node where the two searches met, and the cost up to which the
  // source side's potentials are updated.
  struct Path {
    Index middle = -1;
    double cost = kNever, from_source = 0;
  };

  Index edge_count() const { return static_cast<Index>(flow_.size()); }

  // Moves potentials to the middle of the range that steps to and from neighbours allow. Otherwise
  // many edges have two flows of equal cost after searches, and a small change of costs changes the
  // flow.
  void center_potentials();

  // Sets the flow of every edge to the cheapest one at the potentials.
  void take_cheapest();

  double cost_of(Index edge) const;

  // Sets the prices of one unit more and of one unit less; kNever if bounds forbid it.
  void set_prices(Index edge);

  // Changes the flow of an edge by any number, with its prices and the cost, but not the excess.
  void change_flow(Index edge, Index by);
  void change(Index edge, Index by);

  // Makes unbalanced_ sorted and unique, without nodes whose excess is 0.
  void list_unbalanced();

  // Returns a lower bound of the cost of a balanced flow. By duality, each unit sent costs at least
  // the difference of the potentials of its ends; as in cost(), this is halved. Call
  // list_unbalanced() first.
  double bound() const;

  // Returns the bound after the next unit is sent; kNever if it is not below `most`.
  double bound_of_next(TwoSidedSearch& search, double most);

  // Returns a path to the nearest node that lacks a unit, if it is nearer than `farthest`, the
  // remaining increase of the bound. The search runs from both ends. The cheapest path is known
  // when both sides together have reached its cost, since any other path costs no less. So a side
  // need not continue where the other one is final, or where everything left is too far.
  Path path_from(Index source, TwoSidedSearch& search, double farthest) const;

  // Extends a side from its next node. Direction: 1: along steps, -1: against them. far: the least
  // cost of nodes that are not final on the other side.
  template <int Direction>
  void go_on(Frontier& side, const Frontier& other, double far, Path& best) const;

  // Sends a unit. With the new potentials, steps along its path cost nothing and no step has a
  // negative cost.
  void send(const Path& path, const TwoSidedSearch& search);
  // Takes a step between nodes whose excess does not change, or is set by the caller.
  void take(Index step) { change_flow(step / 2, step % 2 == 0 ? 1 : -1); }

  const FlowNetwork* network_;
  const std::vector<Cost>* costs_ = nullptr;
  std::vector<Index> least_, most_;  // by arc
  std::vector<Index> flow_;          // by edge of the network
  std::vector<double> price_;        // by step
  double cost_ = 0;
  std::vector<Index> excess_;      // by node
  std::vector<Index> unbalanced_;  // all nodes with an excess, and maybe others
  // By node. No change that the bounds allow costs less than the difference of its nodes'
  // potentials.
  std::vector<double> potential_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
