#include "majorant/quads/internal/quantization.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "majorant/framework/error.h"

namespace majorant {

// Half-arc h lies on side s of a patch: in the equation 2 patch + s % 2, sum of the first side -
// sum of the second = 0, with this sign. Beyond the border there is no equation.
struct SideTerm {
  Index equation = -1;
  int sign = 0;
};

// A bidirected flow is a flow in the double cover of its graph: each equation is a node where its
// excess has its sign and one where it has the other, each arc an edge from node to node, and that
// edge's mirror image. What lies beyond the border is one node without an equation.
class DoubleCover {
 public:
  // A unit of flow lowers the excess of one node and raises that of the other.
  struct Edge {
    Index from, to;
  };
  // One unit more on an edge, 2 edge, or one less, 2 edge + 1, leads to a node.
  struct Way {
    Index step, to;
  };

  DoubleCover(const TMesh& mesh)
      : nodes_(static_cast<Index>(4 * mesh.patches.size() + 1)), edges_(2 * mesh.arcs.size()) {
    std::vector<SideTerm> terms(2 * mesh.arcs.size());
    for (std::size_t p = 0; p < mesh.patches.size(); ++p)
      for (std::size_t s = 0; s < 4; ++s)
        for (const Index h : mesh.patches[p].sides[s])
          terms[h] = {static_cast<Index>(2 * p + s % 2), s < 2 ? 1 : -1};
    for (std::size_t a = 0; a < mesh.arcs.size(); ++a) {
      const SideTerm &one = terms[2 * a], &other = terms[2 * a + 1];
      edges_[2 * a] = {node(other, -other.sign), node(one, one.sign)};
      edges_[2 * a + 1] = {node(one, -one.sign), node(other, other.sign)};
    }
    std::vector<std::vector<Way>> leaving(to_size(nodes_));
    for (Index e = 0; e < static_cast<Index>(edges_.size()); ++e) {
      const auto& [from, to] = edges_[e];
      if (from == to) continue;  // of both sides of a patch: any number will do
      leaving[from].push_back({2 * e, to});
      leaving[to].push_back({2 * e + 1, from});
    }
    for (const std::vector<Way>& of_node : leaving) {
      begin_.push_back(ways_.size());
      ways_.insert(ways_.end(), of_node.begin(), of_node.end());
    }
    begin_.push_back(ways_.size());
  }

  const std::vector<Edge>& edges() const { return edges_; }
  std::span<const Way> leaving(Index node) const {
    return {ways_.data() + begin_[node], ways_.data() + begin_[node + 1]};
  }
  Index start(Index step) const {
    return step % 2 == 0 ? edges_[step / 2].from : edges_[step / 2].to;
  }
  Index end(Index step) const { return start(step ^ 1); }
  Index node_count() const { return nodes_; }

 private:
  Index node(const SideTerm& term, int sign) const {
    return term.equation < 0 ? nodes_ - 1 : 2 * term.equation + (sign > 0);
  }

  Index nodes_;
  std::vector<Edge> edges_;  // 2 arc, and its mirror image 2 arc + 1
  std::vector<Way> ways_;    // by node they leave
  std::vector<std::size_t> begin_;
};
// The step back.
constexpr Index undone(Index step) { return step ^ 1; }

constexpr double kNever = std::numeric_limits<double>::infinity();

// Cheapest paths from some nodes, or to them, found in order of cost: one side of a search.
class Frontier {
 public:
  struct Reached {
    double cost = kNever;
    Index step = -1;  // of its path, the one at it; -1: it is one of those nodes
    bool is_final = false;
  };

  explicit Frontier(Index nodes) : reached_(to_size(nodes)) {}

  void clear() {
    for (const Index v : touched_) reached_[v] = {};
    touched_.clear();
    queue_.clear();
  }
  void reach(Index node, double cost, Index step) {
    if (reached_[node].cost == kNever) touched_.push_back(node);
    reached_[node] = {cost, step, false};
    queue_.emplace_back(cost, node);
    std::push_heap(queue_.begin(), queue_.end(), std::greater<>());
  }
  // That of the next node; kNever: there is none.
  double least_cost() {
    while (!queue_.empty() && reached_[queue_.front().second].is_final) pop();
    return queue_.empty() ? kNever : queue_.front().first;
  }
  // The next node, after least_cost().
  Index take() {
    const Index v = pop();
    reached_[v].is_final = true;
    return v;
  }

  const Reached& at(Index node) const { return reached_[node]; }
  const std::vector<Index>& touched() const { return touched_; }
  std::size_t width() const { return queue_.size(); }

 private:
  Index pop() {
    std::pop_heap(queue_.begin(), queue_.end(), std::greater<>());
    const Index v = queue_.back().second;
    queue_.pop_back();
    return v;
  }

  std::vector<Reached> reached_;  // by node
  std::vector<Index> touched_;
  std::vector<std::pair<double, Index>> queue_;  // a heap
};

// A search for a cheapest path from both of its ends.
struct PathSearch {
  explicit PathSearch(Index nodes) : ahead(nodes), back(nodes) {}
  Frontier ahead, back;
};

// A flow of least cost, kept one while bounds become tighter or costs change: flow that they forbid
// goes another way, along cheapest paths.
class LeastCostFlow {
 public:
  // A number of each arc by itself costs (n - wanted)^2 weight.
  struct Cost {
    double wanted = 0, weight = 1;
  };

  LeastCostFlow(const DoubleCover& cover, const std::vector<Index>& least)
      : cover_(&cover),
        least_(least),
        most_(least.size(), std::numeric_limits<Index>::max()),
        flow_(2 * least.size(), 0),
        price_(2 * flow_.size(), 0),
        excess_(to_size(cover.node_count()), 0),
        potential_(to_size(cover.node_count()), 0) {}

  // costs: by arc; they outlive this. Every edge gets the flow that is the cheapest one at some
  // potentials; where costs change little that is mostly the flow of before.
  void set_costs(const std::vector<Cost>& costs) {
    costs_ = &costs;
    cost_ = 0;
    for (Index e = 0; e < edge_count(); ++e) {
      cost_ += cost_of(e);
      set_prices(e);
    }
    center_potentials();
    take_cheapest();
  }

  // False where there is no flow, or none that costs less than `most`.
  bool balance(PathSearch& search, const StopCheck& stop, double most = kNever) {
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

  // Of an arc.
  struct Bounds {
    Index least, most;
  };
  void set_bounds(Index arc, Bounds bounds) {
    least_[arc] = bounds.least;
    most_[arc] = bounds.most;
    for (const Index e : {2 * arc, 2 * arc + 1})
      change(e, std::clamp(flow_[e], bounds.least, bounds.most) - flow_[e]);
  }
  void set_least(Index arc, Index least) { set_bounds(arc, {least, most_[arc]}); }

  // Of an arc that is a half: at most the number below, or at least the one above.
  Bounds below(Index arc) const { return {least_[arc], twice(arc) / 2}; }
  Bounds above(Index arc) const { return {twice(arc) / 2 + 1, most_[arc]}; }
  // That which is nearer, or further away.
  Bounds rounded(Index arc) const {
    return (*costs_)[arc].wanted < twice(arc) / 2 + 0.5 ? below(arc) : above(arc);
  }

  // From below, of what a balanced flow costs with these bounds of an arc; kNever where that is not
  // less than `most`. This one, which is balanced, stays as it is.
  double cost_within(Index arc, Bounds bounds, PathSearch& search, double most) {
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

  Index arc_count() const { return static_cast<Index>(least_.size()); }
  // Of an arc, in halves.
  Index twice(Index arc) const { return flow_[2 * arc] + flow_[2 * arc + 1]; }

  // Of the numbers of arcs: half of that of the edges of the cover.
  double cost() const { return cost_; }

 private:
  // Of a unit that is sent: where both sides of the search meet, and up to which cost potentials
  // change on that of the source.
  struct Path {
    Index middle = -1;
    double cost = kNever, from_source = 0;
  };

  Index edge_count() const { return static_cast<Index>(flow_.size()); }

  // To the middle of what the steps to and from a node's neighbours allow, node by node. Searches
  // leave potentials at which many edges have two flows that are as cheap, of which any change of
  // costs takes one or the other.
  void center_potentials() {
    // Chosen: over the runs of the public closed meshes 1, 3, 10 and 50 leave 44, 20, 12 and 8 % of
    // the units to be sent that there are without.
    constexpr int kSweeps = 10;
    for (int sweep = 0; sweep < kSweeps; ++sweep)
      for (Index v = 0; v < cover_->node_count(); ++v) {
        double low = -kNever, high = kNever;
        for (const auto& [step, to] : cover_->leaving(v)) {
          low = std::max(low, potential_[to] - price_[step]);
          high = std::min(high, potential_[to] + price_[undone(step)]);
        }
        if (low > -kNever && high < kNever) potential_[v] = (low + high) / 2;
      }
  }

  // At the potentials.
  void take_cheapest() {
    constexpr double kEqual = 1e-9;  // of a unit of flow, where two numbers are as cheap
    for (Index e = 0; e < edge_count(); ++e) {
      const auto& [from, to] = cover_->edges()[e];
      const auto& [wanted, weight] = (*costs_)[e / 2];
      const double cheapest = wanted + (potential_[to] - potential_[from]) / (2 * weight);
      const double low = std::ceil(cheapest - 0.5 - kEqual);
      const double high = std::max(low, std::floor(cheapest + 0.5 + kEqual));
      const double bounded = std::clamp(std::clamp(double(flow_[e]), low, high),
                                        double(least_[e / 2]), double(most_[e / 2]));
      change(e, static_cast<Index>(bounded) - flow_[e]);
    }
  }

  double cost_of(Index edge) const {
    const auto& [wanted, weight] = (*costs_)[edge / 2];
    const double off = flow_[edge] - wanted;
    return off * off * weight / 2;
  }

  // Of one unit more and of one less; never where bounds forbid it.
  void set_prices(Index edge) {
    const auto& [wanted, weight] = (*costs_)[edge / 2];
    const double slope = 2 * (flow_[edge] - wanted);
    price_[2 * edge] = flow_[edge] < most_[edge / 2] ? weight * (slope + 1) : kNever;
    price_[2 * edge + 1] = flow_[edge] > least_[edge / 2] ? weight * (1 - slope) : kNever;
  }

  // Of any number, 0 too; keeps the edge's prices and the cost. Between nodes whose excess stays.
  void change_flow(Index edge, Index by) {
    cost_ -= cost_of(edge);
    flow_[edge] += by;
    cost_ += cost_of(edge);
    set_prices(edge);
  }
  void change(Index edge, Index by) {
    change_flow(edge, by);
    if (by == 0) return;
    const auto& [from, to] = cover_->edges()[edge];
    excess_[from] -= by;
    excess_[to] += by;
    unbalanced_.insert(unbalanced_.end(), {from, to});
  }

  // unbalanced_: in order, each once.
  void list_unbalanced() {
    std::sort(unbalanced_.begin(), unbalanced_.end());
    unbalanced_.erase(std::unique(unbalanced_.begin(), unbalanced_.end()), unbalanced_.end());
    std::erase_if(unbalanced_, [&](Index v) { return excess_[v] == 0; });
  }

  // From below, of the cost of a balanced flow: by duality, each unit that is sent costs at least
  // the difference of the potentials of its ends; as in cost(), half of that. unbalanced_: listed.
  double bound() const {
    double sum = cost_;
    for (const Index v : unbalanced_) sum -= excess_[v] * potential_[v] / 2;
    return sum;
  }

  // The same after the next unit is sent; kNever where that is not below `most`.
  double bound_of_next(PathSearch& search, double most) {
    list_unbalanced();
    for (const Index v : unbalanced_)
      if (excess_[v] > 0) {
        const Path path = path_from(v, search, 2 * (most - bound()));
        return path.middle < 0 ? kNever : bound() + path.cost / 2;
      }
    return cost_ < most ? cost_ : kNever;
  }

  // To the nearest node that lacks a unit, if any is nearer than `farthest`, by which the bound may
  // rise then. From both ends: the cheapest path is known when both sides together have come as
  // far, since one that leaves them both costs no less. So a side need not go on where
  // the other one is final, nor where all that is left is too far.
  Path path_from(Index source, PathSearch& search, double farthest) const {
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
    // Both sides have all nodes that are nearer than this, and than the rest.
    best.from_source = std::max(least_ahead, best.cost - back.least_cost());
    return best;
  }

  // From the side's next node. Direction: 1: along steps, -1: against them. far: the least cost of
  // what is not final on the other side.
  template <int Direction>
  void go_on(Frontier& side, const Frontier& other, double far, Path& best) const {
    const Index v = side.take();
    const double cost = side.at(v).cost;
    for (const auto& [leaving, to] : cover_->leaving(v)) {
      if (other.at(to).is_final) continue;  // from there the other side has come here
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

  // A unit; steps along its path cost nothing at the new potentials, no step less.
  void send(const Path& path, const PathSearch& search) {
    const double to_target = path.cost - path.from_source;
    for (const Index v : search.ahead.touched())
      if (search.ahead.at(v).is_final)
        potential_[v] += std::min(0.0, search.ahead.at(v).cost - path.from_source);
    for (const Index v : search.back.touched())
      if (search.back.at(v).is_final)
        potential_[v] += std::max(0.0, to_target - search.back.at(v).cost);
    Index source = path.middle, target = path.middle;
    for (Index step; (step = search.ahead.at(source).step) >= 0; source = cover_->start(step))
      take(step);
    for (Index step; (step = search.back.at(target).step) >= 0; target = cover_->end(step))
      take(step);
    --excess_[source];
    ++excess_[target];
  }
  // Between nodes whose excess stays, or is set.
  void take(Index step) { change_flow(step / 2, step % 2 == 0 ? 1 : -1); }

  const DoubleCover* cover_;
  const std::vector<Cost>* costs_ = nullptr;
  std::vector<Index> least_, most_;  // by arc
  std::vector<Index> flow_;          // by edge of the cover
  std::vector<double> price_;        // by step
  double cost_ = 0;
  std::vector<Index> excess_;      // by node
  std::vector<Index> unbalanced_;  // all nodes with an excess, and others
  // By node, such that no change that the bounds allow costs less than the difference of those of
  // its nodes.
  std::vector<double> potential_;
};

// The least cost of a flow in the cover is a bound from below of that of whole numbers. Where its
// mean over an arc's two edges is no whole number, the arc's is at most the number below or at
// least the one above: both are searched, the cheaper one first.
class BranchAndBound {
  static constexpr double kGain = 1e-9;  // relative, of costs that differ

 public:
  BranchAndBound(PathSearch& search, Effort effort, const StopCheck& stop)
      : search_(search), effort_(effort), stop_(stop) {}

  // Empty where there are no whole numbers. flow: balanced.
  std::vector<Index> solve(LeastCostFlow flow) {
    const bool is_rounded = rounds(flow);
    // Others as good as these are taken: they are nearer to the flow.
    if (is_rounded) least_ += 2 * kGain * std::max(1.0, least_);
    if (!is_rounded || effort_ == Effort::Least) descend(flow);
    return best_;
  }

 private:
  // An arc at most at the number below its half, or at least at the one above; from below, what
  // flows cost then, kNever: none is better than what is known.
  struct Branches {
    Index arc;
    double below, above;
    std::pair<double, double> bounds() const { return std::minmax(below, above); }
  };

  // Halves to the nearer number, one after the other; false where that leaves no flow.
  bool rounds(LeastCostFlow flow) {
    for (Index a = 0; a < flow.arc_count(); ++a) {
      if (flow.twice(a) % 2 == 0) continue;
      flow.set_bounds(a, flow.rounded(a));
      if (!flow.balance(search_, stop_)) return false;
      a = -1;  // others may have become halves
    }
    keep(flow);
    return true;
  }

  void keep(const LeastCostFlow& whole) {
    least_ = whole.cost();
    best_.clear();
    for (Index a = 0; a < whole.arc_count(); ++a) best_.push_back(whole.twice(a) / 2);
  }

  // flow: balanced.
  void descend(LeastCostFlow& flow) {
    std::vector<Index> halves;
    for (Index a = 0; a < flow.arc_count(); ++a)
      if (flow.twice(a) % 2 != 0) halves.push_back(a);
    if (halves.empty()) {
      keep(flow);
      return;
    }
    ++descents_;
    const Branches branches = best_branches(flow, halves);
    const auto [arc, below, above] = branches;
    const auto [less, more] = branches.bounds();
    const bool is_below_first = below <= above;
    if (is_gain(less)) descend_to(flow, arc, is_below_first ? flow.below(arc) : flow.above(arc));
    if (descents_ < most_descents() && is_gain(more))
      descend_to(flow, arc, is_below_first ? flow.above(arc) : flow.below(arc));
  }
  void descend_to(LeastCostFlow flow, Index arc, LeastCostFlow::Bounds bounds) {
    flow.set_bounds(arc, bounds);
    if (flow.balance(search_, stop_, least_)) descend(flow);
  }

  // Of some of these arcs.
  Branches best_branches(LeastCostFlow& flow, const std::vector<Index>& halves) {
    // Chosen: with 8 the searches of the public meshes take a quarter more descents, with 32 as
    // many.
    const std::size_t tried =
        std::min<std::size_t>(effort_ == Effort::Least ? 16 : 1, halves.size());
    Branches best{};
    double best_score = 0;
    for (std::size_t k = 0; k < tried; ++k) {
      stop_.poll();
      const Index arc = halves[k * halves.size() / tried];
      const Branches found{arc, flow.cost_within(arc, flow.below(arc), search_, least_),
                           flow.cost_within(arc, flow.above(arc), search_, least_)};
      // Arcs that are halves together raise bounds as much, up to rounding: the first of them.
      if (const double score = score_of(found, flow.cost()); score > best_score * (1 + kGain)) {
        best = found;
        best_score = score;
      }
      if (!is_gain(found.bounds().first)) return found;  // no whole numbers are better
    }
    return best;
  }

  // By how much both raise the bound, multiplied [Ach07]; neither counts for nothing.
  double score_of(const Branches& branches, double cost) const {
    constexpr double kLeastRise = 1e-6;
    const auto rise = [&](double bound) {
      return std::max(std::min(bound, least_) - cost, kLeastRise);
    };
    return rise(branches.below) * rise(branches.above);
  }

  long most_descents() const { return effort_ == Effort::Least ? kMostDescents : 1; }
  bool is_gain(double cost) const { return cost < least_ - kGain * std::max(1.0, cost); }

  PathSearch& search_;
  const Effort effort_;
  const StopCheck& stop_;
  long descents_ = 0;
  double least_ = kNever;
  std::vector<Index> best_;
};

class Quantization::Relaxed {
 public:
  Relaxed(const TMesh& mesh, const std::vector<Index>& least)
      : cover_(mesh), search_(cover_.node_count()), flow_(cover_, least) {}

  void want(const std::vector<double>& wanted) {
    costs_.clear();
    for (const double w : wanted) costs_.push_back({w, 1 / std::max(w, 1.0)});
    flow_.set_costs(costs_);
  }
  void raise(Index arc, Index least) { flow_.set_least(arc, least); }

  std::vector<Index> numbers(Effort effort, const StopCheck& stop) {
    std::vector<Index> edges;
    if (flow_.balance(search_, stop)) edges = BranchAndBound(search_, effort, stop).solve(flow_);
    if (static_cast<Index>(edges.size()) < flow_.arc_count())
      throw Error(ErrorKind::Infeasible,
                  "no whole numbers of quads were found for the sides of all patches");
    return edges;
  }

 private:
  const DoubleCover cover_;
  std::vector<LeastCostFlow::Cost> costs_;
  PathSearch search_;
  LeastCostFlow flow_;
};

Quantization::Quantization(const TMesh& mesh, const std::vector<double>& wanted,
                           const std::vector<Index>& least)
    : relaxed_(std::make_unique<Relaxed>(mesh, least)) {
  want(wanted);
}

Quantization::~Quantization() = default;

void Quantization::want(const std::vector<double>& wanted) { relaxed_->want(wanted); }

void Quantization::raise(Index arc, Index least) { relaxed_->raise(arc, least); }

std::vector<Index> Quantization::numbers(Effort effort, const StopCheck& stop) {
  return relaxed_->numbers(effort, stop);
}

Index sum_of(const std::vector<Index>& half_arcs, const std::vector<Index>& edges) {
  Index sum = 0;
  for (const Index h : half_arcs) sum += edges[arc_of(h)];
  return sum;
}

long quad_count(const TMesh& mesh, const std::vector<Index>& edges) {
  long count = 0;
  for (const TPatch& patch : mesh.patches)
    count += long{sum_of(patch.sides[0], edges)} * sum_of(patch.sides[1], edges);
  return count;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
