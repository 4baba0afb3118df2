#include "majorant/quads/internal/quantization.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

// Half-arc h lies on side s of a patch: in the equation 2 patch + s % 2, sum of the first side -
// sum of the second = 0, with this sign. Beyond the border there is no equation.
struct Term {
  Index equation = -1;
  int sign = 0;
};

// A change of an arc by one.
struct Change {
  Index arc;
  int by;
};

class Quantizer {
 public:
  Quantizer(const TMesh& mesh, const std::vector<double>& wanted, const std::vector<Index>& least)
      : wanted_(wanted),
        least_(least),
        terms_(2 * mesh.arcs.size()),
        half_arcs_(2 * mesh.patches.size()),
        excess_(2 * mesh.patches.size(), 0) {
    for (std::size_t p = 0; p < mesh.patches.size(); ++p)
      for (std::size_t s = 0; s < 4; ++s)
        for (const Index h : mesh.patches[p].sides[s]) {
          terms_[h] = {static_cast<Index>(2 * p + s % 2), s < 2 ? 1 : -1};
          half_arcs_[2 * p + s % 2].push_back(h);
        }
    for (std::size_t a = 0; a < mesh.arcs.size(); ++a)
      edges_.push_back(std::max(least[a], static_cast<Index>(std::lround(wanted[a]))));
    for (const Term& term : terms_) has_border_ |= term.equation < 0;
    for (std::size_t h = 0; h < terms_.size(); ++h)
      if (terms_[h].equation >= 0) excess_[terms_[h].equation] += terms_[h].sign * edges_[h / 2];
  }

  std::vector<Index> solve(const StopCheck& stop) {
    for (Index e = 0; e < static_cast<Index>(excess_.size()); ++e)
      while (excess_[e] != 0) {
        stop.poll();
        const int need = excess_[e] > 0 ? -1 : 1;
        const auto fits = [&](Index there, int by) {
          return there < 0 || (excess_[there] + (there == e ? need : 0)) * by < 0;
        };
        const std::vector<Change> path =
            cheapest_path({e, need}, fits, -1, std::numeric_limits<double>::infinity());
        if (path.empty())
          throw Error(ErrorKind::Infeasible,
                      "no whole numbers of quads were found for the sides of all patches");
        for (const Change& change : path) apply(change);
      }
    improve(stop);
    return edges_;
  }

 private:
  double cost_of(Index arc, Index edges) const {
    const double off = edges - wanted_[arc];
    return off * off / std::max(wanted_[arc], 1.0);
  }
  double cost_of(const Change& c) const {
    return cost_of(c.arc, edges_[c.arc] + c.by) - cost_of(c.arc, edges_[c.arc]);
  }

  void apply(const Change& change) {
    edges_[change.arc] += change.by;
    for (const Index h : {2 * change.arc, 2 * change.arc + 1})
      if (terms_[h].equation >= 0) excess_[terms_[h].equation] += terms_[h].sign * change.by;
  }

  // An equation, and the change of its excess that is looked for.
  struct State {
    Index equation;
    int need;
    Index number() const { return 2 * equation + (need > 0); }
  };

  // Changes that go on from one equation to the next until fits(equation, change of its excess), of
  // the border equation -1; empty where there are none that cost less than `most`. Costs that are
  // gains count as nothing. `kept`: an arc that stays.
  template <class Fits>
  std::vector<Change> cheapest_path(State start, const Fits& fits, Index kept, double most) const {
    constexpr double kLeastCost = 1e-6;  // shorter paths before longer ones
    struct Step {
      double cost = std::numeric_limits<double>::infinity();
      Index from = -1;  // number of a state
      Change change{-1, 0};
    };
    std::vector<Step> reached(2 * excess_.size());
    std::pair<double, Index> found{most, -1};  // cost, state before the last change
    Change last{-1, 0};
    std::priority_queue<std::pair<double, Index>, std::vector<std::pair<double, Index>>,
                        std::greater<>>
        queue;
    reached[start.number()].cost = 0;
    queue.emplace(0, start.number());
    while (!queue.empty() && queue.top().first < found.first) {
      const auto [cost, number] = queue.top();
      queue.pop();
      if (cost > reached[number].cost) continue;
      const int need = number % 2 == 1 ? 1 : -1;
      for (const Index h : half_arcs_[number / 2]) {
        const Change change{h / 2, need * terms_[h].sign};
        if (change.arc == kept) continue;
        const int before = change_on_the_way(reached, number, change.arc);
        if (edges_[change.arc] + before + change.by < least_[change.arc]) continue;
        const double total = cost + std::max(kLeastCost, cost_of(change));
        if (total >= found.first) continue;
        const Term& there = terms_[h ^ 1];
        const int by = there.sign * change.by;
        if (fits(there.equation, by)) {
          found = {total, number};
          last = change;
        }
        if (there.equation < 0) continue;
        const State next{there.equation, -by};
        if (total < reached[next.number()].cost) {
          reached[next.number()] = {total, number, change};
          queue.emplace(total, next.number());
        }
      }
    }
    std::vector<Change> path;
    if (found.second < 0) return path;
    path.push_back(last);
    for (Index s = found.second; reached[s].from >= 0; s = reached[s].from)
      path.push_back(reached[s].change);
    return path;
  }

  // A path may change an arc more than once.
  template <class Steps>
  static int change_on_the_way(const Steps& reached, Index number, Index arc) {
    int sum = 0;
    for (Index s = number; reached[s].from >= 0; s = reached[s].from)
      if (reached[s].change.arc == arc) sum += reached[s].change.by;
    return sum;
  }

  // Every arc by one, and back to it through its two patches or from both to the border, as long as
  // that lowers the sum.
  void improve(const StopCheck& stop) {
    constexpr int kRounds = 20;
    bool has_improved = true;
    for (int round = 0; round < kRounds && has_improved; ++round) {
      has_improved = false;
      for (Index arc = 0; arc < static_cast<Index>(edges_.size()); ++arc)
        for (const int by : {1, -1}) {
          stop.poll();
          has_improved |= improves({arc, by});
        }
    }
  }

  // Changes are made one after the other, since some change an arc twice, and taken back where they
  // are no gain.
  bool improves(const Change& change) {
    constexpr double kGain = 1e-9;
    const auto& [arc, by] = change;
    const double most = -cost_of(change);
    if (edges_[arc] + by < least_[arc] || most <= 0) return false;
    double gain = 0;
    std::vector<Change> made;
    const auto make = [&](const std::vector<Change>& changes) {
      for (const Change& c : changes) {
        gain -= cost_of(c);
        apply(c);
        made.push_back(c);
      }
    };
    const Term &one = terms_[2 * arc], &other = terms_[2 * arc + 1];
    const auto is_border = [](Index there, int) { return there < 0; };
    bool is_whole = true;
    if (other.equation < 0) {
      make(cheapest_path({one.equation, -one.sign * by}, is_border, arc, most));
      is_whole = !made.empty();
    } else if (one.equation != other.equation || one.sign == other.sign) {
      const auto fits = [&](Index there, int change_there) {
        return there == other.equation && change_there == -other.sign * by;
      };
      make(cheapest_path({one.equation, -one.sign * by}, fits, arc, most));
      if (made.empty() && has_border_) {
        make(cheapest_path({one.equation, -one.sign * by}, is_border, arc, most));
        const std::size_t first = made.size();
        if (first > 0)
          make(cheapest_path({other.equation, -other.sign * by}, is_border, arc, most + gain));
        is_whole = first > 0 && made.size() > first;
      } else {
        is_whole = !made.empty();
      }
    }
    make({change});
    if (is_whole && gain > kGain) return true;
    for (const Change& c : made) apply({c.arc, -c.by});
    return false;
  }

  const std::vector<double>& wanted_;
  const std::vector<Index>& least_;
  std::vector<Term> terms_;                    // by half-arc
  std::vector<std::vector<Index>> half_arcs_;  // by equation
  std::vector<Index> excess_, edges_;          // by equation; by arc
  bool has_border_ = false;
};

}  // namespace

std::vector<Index> quantize(const TMesh& mesh, const std::vector<double>& wanted,
                            const std::vector<Index>& least, const StopCheck& stop) {
  return Quantizer(mesh, wanted, least).solve(stop);
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
