#include "majorant/quads/internal/branch_and_bound.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace majorant {
namespace {

class BranchAndBound {
  static constexpr double kGain = 1e-9;  // relative difference of costs that counts

 public:
  BranchAndBound(TwoSidedSearch& search, SearchEffort effort, const StopCheck& stop)
      : search_(search), effort_(effort), stop_(stop) {}

  // Returns nothing if there are no integers. flow: balanced.
  std::vector<Index> solve(MinCostFlow flow) {
    const bool is_rounded = rounds(flow);
    // Accepts other solutions with the same cost, which are nearer to the flow.
    if (is_rounded) least_ += 2 * kGain * std::max(1.0, least_);
    if (!is_rounded || effort_ == SearchEffort::Least) descend(flow);
    return best_;
  }

 private:
  // The branches of an arc: at most the integer below its half, or at least the one above. Each has
  // a lower bound of its cost; kNever: it cannot be better than the best solution.
  struct Branches {
    Index arc;
    double below, above;
    std::pair<double, double> bounds() const { return std::minmax(below, above); }
  };

  // Rounds halves to the nearer integer, one after the other. Returns false if no flow is left.
  bool rounds(MinCostFlow flow) {
    for (Index a = 0; a < flow.arc_count(); ++a) {
      if (flow.twice(a) % 2 == 0) continue;
      flow.set_bounds(a, flow.rounded(a));
      if (!flow.balance(search_, stop_)) return false;
      a = -1;  // rounding an arc may turn others into halves
    }
    keep(flow);
    return true;
  }

  void keep(const MinCostFlow& whole) {
    least_ = whole.cost();
    best_.clear();
    for (Index a = 0; a < whole.arc_count(); ++a) best_.push_back(whole.twice(a) / 2);
  }

  // flow: balanced.
  void descend(MinCostFlow& flow) {
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
  void descend_to(MinCostFlow flow, Index arc, MinCostFlow::Bounds bounds) {
    flow.set_bounds(arc, bounds);
    if (flow.balance(search_, stop_, least_)) descend(flow);
  }

  // Returns the branches of one of these arcs.
  Branches best_branches(MinCostFlow& flow, const std::vector<Index>& halves) {
    // The number of arcs that are tried. 8 need a quarter more descents, 32 as many
    // (bench/quantization).
    const std::size_t tried =
        std::min<std::size_t>(effort_ == SearchEffort::Least ? 16 : 1, halves.size());
    Branches best{};
    double best_score = 0;
    for (std::size_t k = 0; k < tried; ++k) {
      stop_.poll();
      const Index arc = halves[k * halves.size() / tried];
      const Branches found{arc, flow.cost_within(arc, flow.below(arc), search_, least_),
                           flow.cost_within(arc, flow.above(arc), search_, least_)};
      // Arcs that are halves together raise bounds equally, up to rounding; the first is taken.
      if (const double score = score_of(found, flow.cost()); score > best_score * (1 + kGain)) {
        best = found;
        best_score = score;
      }
      if (!is_gain(found.bounds().first)) return found;  // no integers are better
    }
    return best;
  }

  // Returns the product by which both branches raise the bound [Ach07]; a branch that does not
  // raise it counts little.
  double score_of(const Branches& branches, double cost) const {
    constexpr double kLeastRise = 1e-6;
    const auto rise = [&](double bound) {
      return std::max(std::min(bound, least_) - cost, kLeastRise);
    };
    return rise(branches.below) * rise(branches.above);
  }

  long most_descents() const { return effort_ == SearchEffort::Least ? kMaxDescents : 1; }
  bool is_gain(double cost) const { return cost < least_ - kGain * std::max(1.0, cost); }

  TwoSidedSearch& search_;
  const SearchEffort effort_;
  const StopCheck& stop_;
  long descents_ = 0;
  double least_ = kNever;
  std::vector<Index> best_;
};

}  // namespace

std::vector<Index> branch_and_bound(const MinCostFlow& flow, TwoSidedSearch& search,
                                    SearchEffort effort, const StopCheck& stop) {
  return BranchAndBound(search, effort, stop).solve(flow);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
