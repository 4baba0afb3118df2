#include "majorant/framework/internal/extended_elimination.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

#include "majorant/framework/internal/symbolic_analysis.h"

namespace majorant {
namespace {

class Extension {
 public:
  explicit Extension(const BlockElimination& old)
      : old_(old),
        groups_(static_cast<Index>(old.group_starts.size()) - 1),
        group_of_(old.order.size()),
        position_(old.order.size()),
        more_(at(groups_)),
        parent_(at(groups_), -1) {
    for (Index g = 0; g < groups_; ++g)
      for (Index p = old.group_starts[at(g)]; p < end_of(g); ++p) group_of_[at(p)] = g;
    for (std::size_t p = 0; p < old.order.size(); ++p)
      position_[at(old.order[p])] = static_cast<Index>(p);
  }

  void add(const BlockEdges& edges) {
    for (const auto& [a, b] : edges) {
      const auto [low, high] = std::minmax(position_[at(a)], position_[at(b)]);
      more_[at(group_of_[at(low)])].push_back(high);
    }
    for (Index g = 0; g < groups_; ++g) settle(g);
  }

  BlockElimination in_postorder() const {
    std::vector<Index> groups(at(groups_));
    std::iota(groups.begin(), groups.end(), 0);
    groups = postorder(parent_, groups);
    BlockElimination out;
    std::vector<Index> moved(old_.order.size());  // positions
    for (const Index g : groups) {
      out.group_starts.push_back(static_cast<Index>(out.order.size()));
      for (Index p = old_.group_starts[at(g)]; p < end_of(g); ++p) {
        moved[at(p)] = static_cast<Index>(out.order.size());
        out.order.push_back(old_.order[at(p)]);
      }
    }
    out.group_starts.push_back(static_cast<Index>(out.order.size()));
    for (const Index g : groups) {
      out.touched_starts.push_back(out.touched.size());
      // Groups that one touches stay in their order, whatever the postorder.
      for (const Index p : touched(g)) out.touched.push_back(moved[at(p)]);
    }
    out.touched_starts.push_back(out.touched.size());
    return out;
  }

 private:
  Index end_of(Index g) const { return old_.group_starts[at(g) + 1]; }
  // Old: what the group touched; new: what it touches, if that is more.
  std::span<const Index> touched(Index g) const {
    if (!more_[at(g)].empty()) return more_[at(g)];
    return {old_.touched.data() + old_.touched_starts[at(g)],
            old_.touched.data() + old_.touched_starts[at(g) + 1]};
  }

  // All that comes before g is settled: more_[g] has what g gets to touch, in any order.
  void settle(Index g) {
    std::vector<Index>& more = more_[at(g)];
    if (!more.empty()) {
      const std::vector<Index> asked = std::exchange(more, {});
      const std::span<const Index> had = touched(g);
      std::vector<Index> gained;
      for (const Index p : asked)
        if (p >= end_of(g) && !std::binary_search(had.begin(), had.end(), p)) gained.push_back(p);
      std::sort(gained.begin(), gained.end());
      gained.erase(std::unique(gained.begin(), gained.end()), gained.end());
      if (!gained.empty())
        std::merge(had.begin(), had.end(), gained.begin(), gained.end(), std::back_inserter(more));
    }
    const std::span<const Index> now = touched(g);
    const auto below = std::lower_bound(now.begin(), now.end(), end_of(g));
    if (below == now.end()) return;
    const Index parent = parent_[at(g)] = group_of_[at(*below)];
    if (!more.empty()) more_[at(parent)].insert(more_[at(parent)].end(), below, now.end());
  }

  const BlockElimination& old_;
  const Index groups_;
  std::vector<Index> group_of_, position_;  // by position; by block
  std::vector<std::vector<Index>> more_;    // by group, empty: as it was
  std::vector<Index> parent_;
};

}  // namespace

BlockElimination extended_elimination(const BlockElimination& elimination,
                                      const BlockEdges& edges) {
  Extension extension(elimination);
  extension.add(edges);
  return extension.in_postorder();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
