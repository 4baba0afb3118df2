#include "majorant/quads/internal/min_cost_flow.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace majorant {

void MinCostFlow::set_costs(const std::vector<Cost>& costs) {
  costs_ = &costs;
  cost_ = 0;
  for (Index e = 0; e < edge_count(); ++e) {
    cost_ += cost_of(e);
    set_prices(e);
  }
  center_potentials();
  take_cheapest();
}

bool MinCostFlow::balance(TwoSidedSearch& search, const StopCheck& stop, double most) {
  list_unbalanced();
  for (const Index v : unbalanced_)
    while (excess_[v] > 0) {
      stop.poll();
      const Path path = path_from(v, search, 2 * (most - bound()));
      if (path.middle < 0) return false;
      send(path, search);
    }
  return true;
}

void MinCostFlow::set_bounds(Index arc, Bounds bounds) {
  least_[arc] = bounds.least;
  most_[arc] = bounds.most;
  for (const Index e : {2 * arc, 2 * arc + 1})
    change(e, std::clamp(flow_[e], bounds.least, bounds.most) - flow_[e]);
}

MinCostFlow::Bounds MinCostFlow::rounded(Index arc) const {
  return (*costs_)[arc].target < twice(arc) / 2 + 0.5 ? below(arc) : above(arc);
}

double MinCostFlow::cost_within(Index arc, Bounds bounds, TwoSidedSearch& search, double most) {
  const Bounds bounds_before{least_[arc], most_[arc]};
  const std::array<Index, 2> flow{flow_[2 * arc], flow_[2 * arc + 1]};
  const double cost_before = cost_;
  set_bounds(arc, bounds);
  const double cost = bound_of_next(search, most);
  least_[arc] = bounds_before.least;
  most_[arc] = bounds_before.most;
  for (const Index k : {0, 1}) change(2 * arc + k, flow[k] - flow_[2 * arc + k]);
  unbalanced_.clear();
  cost_ = cost_before;
  return cost;
}

void MinCostFlow::center_potentials() {
  // Sweeps that center potentials. More sweeps leave fewer units to send: with 1, 3, 10 and 50
  // sweeps 44, 20, 12 and 8 % of those without sweeps (bench/quantization).
  constexpr int kSweeps = 10;
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (Index v = 0; v < network_->node_count(); ++v) {
      double low = -kNever, high = kNever;
      for (const auto& [step, to] : network_->leaving(v)) {
        low = std::max(low, potential_[to] - price_[step]);
        high = std::min(high, potential_[to] + price_[undone(step)]);
      }
      if (low > -kNever && high < kNever) potential_[v] = (low + high) / 2;
    }
}

void MinCostFlow::take_cheapest() {
  constexpr double kEqual = 1e-9;  // of a unit of flow; smaller differences count as ties
  for (Index e = 0; e < edge_count(); ++e) {
    const auto& [from, to] = network_->edges()[e];
    const auto& [target, weight] = (*costs_)[e / 2];
    const double cheapest = target + (potential_[to] - potential_[from]) / (2 * weight);
    const double low = std::ceil(cheapest - 0.5 - kEqual);
    const double high = std::max(low, std::floor(cheapest + 0.5 + kEqual));
    const double bounded = std::clamp(std::clamp(double(flow_[e]), low, high),
                                      double(least_[e / 2]), double(most_[e / 2]));
    change(e, static_cast<Index>(bounded) - flow_[e]);
  }
}

double MinCostFlow::cost_of(Index edge) const {
  const auto& [target, weight] = (*costs_)[edge / 2];
  const double off = flow_[edge] - target;
  return off * off * weight / 2;
}

void MinCostFlow::set_prices(Index edge) {
  const auto& [target, weight] = (*costs_)[edge / 2];
  const double slope = 2 * (flow_[edge] - target);
  price_[2 * edge] = flow_[edge] < most_[edge / 2] ? weight * (slope + 1) : kNever;
  price_[2 * edge + 1] = flow_[edge] > least_[edge / 2] ? weight * (1 - slope) : kNever;
}

void MinCostFlow::change_flow(Index edge, Index by) {
  cost_ -= cost_of(edge);
  flow_[edge] += by;
  cost_ += cost_of(edge);
  set_prices(edge);
}

void MinCostFlow::change(Index edge, Index by) {
  change_flow(edge, by);
  if (by == 0) return;
  const auto& [from, to] = network_->edges()[edge];
  excess_[from] -= by;
  excess_[to] += by;
  unbalanced_.insert(unbalanced_.end(), {from, to});
}

void MinCostFlow::list_unbalanced() {
  std::sort(unbalanced_.begin(), unbalanced_.end());
  unbalanced_.erase(std::unique(unbalanced_.begin(), unbalanced_.end()), unbalanced_.end());
  std::erase_if(unbalanced_, [&](Index v) { return excess_[v] == 0; });
}

double MinCostFlow::bound() const {
  double sum = cost_;
  for (const Index v : unbalanced_) sum -= excess_[v] * potential_[v] / 2;
  return sum;
}

double MinCostFlow::bound_of_next(TwoSidedSearch& search, double most) {
  list_unbalanced();
  for (const Index v : unbalanced_)
    if (excess_[v] > 0) {
      const Path path = path_from(v, search, 2 * (most - bound()));
      return path.middle < 0 ? kNever : bound() + path.cost / 2;
    }
  return cost_ < most ? cost_ : kNever;
}

MinCostFlow::Path MinCostFlow::path_from(Index source, TwoSidedSearch& search,
                                         double farthest) const {
  Frontier &ahead = search.ahead, &back = search.back;
  ahead.clear();
  back.clear();
  ahead.reach(source, 0, -1);
  for (const Index v : unbalanced_)
    if (excess_[v] < 0) back.reach(v, 0, -1);
  Path best;
  best.cost = farthest;
  double least_ahead = 0;
  for (;;) {
    const double from_source = ahead.least_cost(), to_target = back.least_cost();
    if (from_source + to_target >= best.cost) break;
    least_ahead = from_source;
    if (ahead.width() <= back.width())
      go_on<1>(ahead, back, to_target, best);
    else
      go_on<-1>(back, ahead, from_source, best);
  }
  // On both sides all nodes nearer than these costs are final.
  best.from_source = std::max(least_ahead, best.cost - back.least_cost());
  return best;
}

template <int Direction>
void MinCostFlow::go_on(Frontier& side, const Frontier& other, double far, Path& best) const {
  const Index v = side.take();
  const double cost = side.at(v).cost;
  for (const auto& [leaving, to] : network_->leaving(v)) {
    if (other.at(to).is_final) continue;  // the other side's path to it is known
    const Index step = Direction > 0 ? leaving : undone(leaving);
    const double rise = Direction * (potential_[v] - potential_[to]);
    const double total = cost + std::max(0.0, price_[step] + rise);
    if (total >= side.at(to).cost || total + far >= best.cost) continue;
    side.reach(to, total, step);
    if (const double whole = total + other.at(to).cost; whole < best.cost) {
      best.middle = to;
      best.cost = whole;
    }
  }
}

void MinCostFlow::send(const Path& path, const TwoSidedSearch& search) {
  const double to_target = path.cost - path.from_source;
  for (const Index v : search.ahead.touched())
    if (search.ahead.at(v).is_final)
      potential_[v] += std::min(0.0, search.ahead.at(v).cost - path.from_source);
  for (const Index v : search.back.touched())
    if (search.back.at(v).is_final)
      potential_[v] += std::max(0.0, to_target - search.back.at(v).cost);
  Index source = path.middle, target = path.middle;
  for (Index step; (step = search.ahead.at(source).step) >= 0; source = network_->start(step))
    take(step);
  for (Index step; (step = search.back.at(target).step) >= 0; target = network_->end(step))
    take(step);
  --excess_[source];
  ++excess_[target];
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
