#include "majorant/quads/internal/quantization.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <queue>
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
  struct Edge {
    Index from, to;  // a unit of flow lowers the excess of one and raises that of the other
  };
  // Flow of one unit more (by: 1) or less (-1) on an edge leads to a node.
  struct Way {
    Index edge, to;
    int by;
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
      leaving[from].push_back({e, to, 1});
      leaving[to].push_back({e, from, -1});
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

// A search for cheapest paths, as large as what it reaches.
class PathSearch {
 public:
  struct Reached {
    double cost = std::numeric_limits<double>::infinity();
    const DoubleCover::Way* way = nullptr;  // it is reached by
    bool is_final = false;
  };

  explicit PathSearch(Index nodes) : reached_(to_size(nodes)) {}

  void begin(Index source) {
    for (const Index v : touched_) reached_[v] = {};
    touched_.clear();
    finals_.clear();
    queue_ = {};
    reach(source, 0, nullptr);
  }
  void reach(Index node, double cost, const DoubleCover::Way* way) {
    if (reached_[node].cost == std::numeric_limits<double>::infinity()) touched_.push_back(node);
    reached_[node] = {cost, way, false};
    queue_.emplace(cost, node);
  }
  // The next node in order of cost, or -1.
  Index take() {
    while (!queue_.empty()) {
      const Index v = queue_.top().second;
      queue_.pop();
      if (reached_[v].is_final) continue;
      reached_[v].is_final = true;
      finals_.push_back(v);
      return v;
    }
    return -1;
  }

  const Reached& at(Index node) const { return reached_[node]; }
  const std::vector<Index>& finals() const { return finals_; }

 private:
  std::vector<Reached> reached_;  // by node
  std::vector<Index> touched_, finals_;
  std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>,
                      std::greater<>>
      queue_;
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
        price_(flow_.size()),
        excess_(to_size(cover.node_count()), 0),
        potential_(to_size(cover.node_count()), 0) {}

  // costs: by arc; they outlive this. Every edge gets the flow that is the cheapest one at the
  // potentials of before, or at none: that of which less is out of balance.
  void set_costs(const std::vector<Cost>& costs) {
    costs_ = &costs;
    take_cheapest();
    const long excess = out_of_balance();
    std::vector<double> before(potential_.size(), 0);
    before.swap(potential_);
    take_cheapest();
    if (out_of_balance() <= excess) return;
    potential_.swap(before);
    take_cheapest();
  }

  // False where there is no flow, or none that costs less than `most`.
  bool balance(PathSearch& search, const StopCheck& stop,
               double most = std::numeric_limits<double>::infinity()) {
    const bool is_bounded = most < std::numeric_limits<double>::infinity();
    for (Index v = 0; v < cover_->node_count(); ++v)
      while (excess_[v] > 0) {
        stop.poll();
        if (!send_from(v, search, is_bounded ? 2 * (most - bound()) : most)) return false;
      }
    return true;
  }

  void set_least(Index arc, Index least) {
    least_[arc] = least;
    for (const Index e : {2 * arc, 2 * arc + 1}) change(e, std::max(least - flow_[e], 0));
  }
  void set_most(Index arc, Index most) {
    most_[arc] = most;
    for (const Index e : {2 * arc, 2 * arc + 1}) change(e, std::min(most - flow_[e], 0));
  }

  // Of a half: the nearer number, or further away.
  void round(Index arc) {
    const Index below = twice(arc) / 2;
    if ((*costs_)[arc].wanted < below + 0.5)
      set_most(arc, below);
    else
      set_least(arc, below + 1);
  }

  Index arc_count() const { return static_cast<Index>(least_.size()); }
  // Of an arc, in halves.
  Index twice(Index arc) const { return flow_[2 * arc] + flow_[2 * arc + 1]; }

  // Of the numbers of arcs: half of that of the edges of the cover.
  double cost() const {
    double sum = 0;
    for (std::size_t e = 0; e < flow_.size(); ++e) {
      const auto& [wanted, weight] = (*costs_)[e / 2];
      const double off = flow_[e] - wanted;
      sum += off * off * weight / 2;
    }
    return sum;
  }

 private:
  // Of one unit more and of one less; infinite where bounds forbid it.
  struct Price {
    double more = 0, less = 0;
    double of(int by) const { return by > 0 ? more : less; }
  };

  // At the potentials.
  void take_cheapest() {
    constexpr double kEqual = 1e-9;  // of a unit of flow, where two numbers are as cheap
    for (Index e = 0; e < static_cast<Index>(flow_.size()); ++e) {
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

  long out_of_balance() const {
    long sum = 0;
    for (const Index excess : excess_) sum += std::max(excess, 0);
    return sum;
  }

  // Of any number, 0 too; keeps the edge's price.
  void change(Index edge, Index by) {
    const auto& [from, to] = cover_->edges()[edge];
    flow_[edge] += by;
    excess_[from] -= by;
    excess_[to] += by;
    constexpr double kForbidden = std::numeric_limits<double>::infinity();
    const auto& [wanted, weight] = (*costs_)[edge / 2];
    const double slope = 2 * (flow_[edge] - wanted);
    price_[edge] = {flow_[edge] < most_[edge / 2] ? weight * (slope + 1) : kForbidden,
                    flow_[edge] > least_[edge / 2] ? weight * (1 - slope) : kForbidden};
  }

  // From below, of the cost of a balanced flow: by duality, each unit that is sent costs at least
  // the difference of the potentials of its ends; as in cost(), half of that.
  double bound() const {
    double sum = cost();
    for (std::size_t v = 0; v < excess_.size(); ++v) sum -= excess_[v] * potential_[v] / 2;
    return sum;
  }

  // One unit, to the nearest node that lacks one; false where none is nearer than `farthest`, by
  // which the bound may rise then.
  bool send_from(Index source, PathSearch& search, double farthest) {
    search.begin(source);
    Index target = search.take();
    for (; target >= 0 && excess_[target] >= 0; target = search.take()) {
      // What a node has too much of leaves it.
      const double so_far = search.at(target).cost, potential = potential_[target];
      if (so_far >= farthest) return false;
      for (const DoubleCover::Way& way : cover_->leaving(target)) {
        if (search.at(way.to).is_final) continue;
        const double price = price_[way.edge].of(way.by);
        const double total = so_far + std::max(0.0, price + potential - potential_[way.to]);
        if (total < search.at(way.to).cost) search.reach(way.to, total, &way);
      }
    }
    if (target < 0) return false;
    for (const Index v : search.finals())
      potential_[v] += search.at(v).cost - search.at(target).cost;
    for (Index v = target; v != source;) {
      const auto [edge, to, by] = *search.at(v).way;
      change(edge, by);
      v = by > 0 ? cover_->edges()[edge].from : cover_->edges()[edge].to;
    }
    return true;
  }

  const DoubleCover* cover_;
  const std::vector<Cost>* costs_ = nullptr;
  std::vector<Index> least_, most_;  // by arc
  std::vector<Index> flow_;          // by edge of the cover
  std::vector<Price> price_;
  std::vector<Index> excess_;  // by node
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
  std::vector<Index> solve(const LeastCostFlow& flow) {
    const bool is_rounded = rounds(flow);
    // Others as good as these are taken: they are nearer to the flow.
    if (is_rounded) least_ += 2 * kGain * std::max(1.0, least_);
    if (!is_rounded || effort_ == Effort::Least) descend(flow);
    return best_;
  }

 private:
  struct Branches {
    LeastCostFlow below, above;
    double cost_below, cost_above;  // infinite where no flow is better than what is known
    std::pair<double, double> bounds() const { return std::minmax(cost_below, cost_above); }
  };

  // Halves to the nearer number, one after the other; false where that leaves no flow.
  bool rounds(LeastCostFlow flow) {
    for (Index a = 0; a < flow.arc_count(); ++a) {
      if (flow.twice(a) % 2 == 0) continue;
      flow.round(a);
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
  void descend(const LeastCostFlow& flow) {
    std::vector<Index> halves;
    for (Index a = 0; a < flow.arc_count(); ++a)
      if (flow.twice(a) % 2 != 0) halves.push_back(a);
    if (halves.empty()) {
      keep(flow);
      return;
    }
    ++descents_;
    const Branches branches = best_branches(flow, halves);
    const bool is_below_first = branches.cost_below <= branches.cost_above;
    const auto [less, more] = branches.bounds();
    if (is_gain(less)) descend(is_below_first ? branches.below : branches.above);
    if (descents_ < most_descents() && is_gain(more))
      descend(is_below_first ? branches.above : branches.below);
  }

  // Of some of these arcs, those that raise the bound most.
  Branches best_branches(const LeastCostFlow& flow, const std::vector<Index>& halves) {
    // Chosen: with 16 the largest of the public meshes' searches end after some 150 descents, with
    // 4 they do not in 300.
    const std::size_t tried =
        std::min<std::size_t>(effort_ == Effort::Least ? 16 : 1, halves.size());
    std::optional<Branches> best;
    for (std::size_t k = 0; k < tried; ++k) {
      Branches found = branches_at(flow, halves[k * halves.size() / tried]);
      if (!best || best->bounds() < found.bounds()) best = std::move(found);
      if (!is_gain(best->bounds().first)) break;  // no whole numbers are better
    }
    return *std::move(best);
  }

  Branches branches_at(const LeastCostFlow& flow, Index arc) {
    Branches found{flow, flow, 0, 0};
    const Index below = flow.twice(arc) / 2;
    found.below.set_most(arc, below);
    found.above.set_least(arc, below + 1);
    for (auto [branch, cost] :
         {std::pair{&found.below, &found.cost_below}, std::pair{&found.above, &found.cost_above}})
      *cost = branch->balance(search_, stop_, least_) ? branch->cost()
                                                      : std::numeric_limits<double>::infinity();
    return found;
  }

  long most_descents() const { return effort_ == Effort::Least ? kMostDescents : 1; }
  bool is_gain(double cost) const { return cost < least_ - kGain * std::max(1.0, cost); }

  PathSearch& search_;
  const Effort effort_;
  const StopCheck& stop_;
  long descents_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
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
