#include "majorant/framework/internal/symbolic_update.h"

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
        supernodes_(static_cast<Index>(old.supernode_starts.size()) - 1),
        supernode_of_(old.order.size()),
        position_(old.order.size()),
        more_(to_size(supernodes_)),
        parent_(to_size(supernodes_), -1) {
    for (Index g = 0; g < supernodes_; ++g)
      for (Index p = old.supernode_starts[g]; p < end_of(g); ++p) supernode_of_[p] = g;
    for (std::size_t p = 0; p < old.order.size(); ++p)
      position_[old.order[p]] = static_cast<Index>(p);
  }

  void add(const BlockEdges& edges) {
    for (const auto& [a, b] : edges) {
      const auto [low, high] = std::minmax(position_[a], position_[b]);
      more_[supernode_of_[low]].push_back(high);
    }
    for (Index g = 0; g < supernodes_; ++g) settle(g);
  }

  BlockElimination in_postorder() const {
    std::vector<Index> supernodes(to_size(supernodes_));
    std::iota(supernodes.begin(), supernodes.end(), 0);
    supernodes = postorder(parent_, supernodes);
    BlockElimination out;
    std::vector<Index> moved(old_.order.size());  // positions
    for (const Index g : supernodes) {
      out.supernode_starts.push_back(static_cast<Index>(out.order.size()));
      for (Index p = old_.supernode_starts[g]; p < end_of(g); ++p) {
        moved[p] = static_cast<Index>(out.order.size());
        out.order.push_back(old_.order[p]);
      }
    }
    out.supernode_starts.push_back(static_cast<Index>(out.order.size()));
    for (const Index g : supernodes) {
      out.structure_starts.push_back(out.structure.size());
      // Positions of one supernode keep their order in every postorder.
      for (const Index p : structure(g)) out.structure.push_back(moved[p]);
    }
    out.structure_starts.push_back(out.structure.size());
    return out;
  }

 private:
  Index end_of(Index g) const { return old_.supernode_starts[g + 1]; }
  // Returns the structure of a supernode: the new one if it has grown, otherwise the old one.
  std::span<const Index> structure(Index g) const {
    if (!more_[g].empty()) return more_[g];
    return {old_.structure.data() + old_.structure_starts[g],
            old_.structure.data() + old_.structure_starts[g + 1]};
  }

  // Computes the new structure of g; that of all supernodes before it is final. more_[g]: the
  // positions that g gains, in any order.
  void settle(Index g) {
    std::vector<Index>& more = more_[g];
    if (!more.empty()) {
      const std::vector<Index> added = std::exchange(more, {});
      const std::span<const Index> had = structure(g);
      std::vector<Index> gained;
      for (const Index p : added)
        if (p >= end_of(g) && !std::binary_search(had.begin(), had.end(), p)) gained.push_back(p);
      std::sort(gained.begin(), gained.end());
      gained.erase(std::unique(gained.begin(), gained.end()), gained.end());
      if (!gained.empty())
        std::merge(had.begin(), had.end(), gained.begin(), gained.end(), std::back_inserter(more));
    }
    const std::span<const Index> now = structure(g);
    const auto below = std::lower_bound(now.begin(), now.end(), end_of(g));
    if (below == now.end()) return;
    const Index parent = parent_[g] = supernode_of_[*below];
    if (!more.empty()) more_[parent].insert(more_[parent].end(), below, now.end());
  }

  const BlockElimination& old_;
  const Index supernodes_;
  std::vector<Index> supernode_of_, position_;  // by position; by block
  std::vector<std::vector<Index>> more_;        // by supernode; empty: unchanged
  std::vector<Index> parent_;
};

}  // namespace

BlockElimination symbolic_update(const BlockElimination& elimination, const BlockEdges& edges) {
  Extension extension(elimination);
  extension.add(edges);
  return extension.in_postorder();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
