#include "majorant/framework/internal/symbolic_analysis.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

namespace majorant {
namespace {

// Merged supernodes of at most kRelaxedBlocks[k] blocks may contain the k-th share of zeros; larger
// supernodes the last share. The shares are those of CHOLMOD [CDHR08]. The numbers of blocks are
// those that factorize fastest in bench/solver_cost --no-runs.
constexpr std::array<Index, 3> kRelaxedBlocks{4, 8, 16};
constexpr std::array<double, 3> kRelaxedZeros{0.8, 0.1, 0.05};

// The elimination tree, by position in an order.
struct Tree {
  std::vector<Index> parent;  // -1: none
  std::vector<Index> count;   // nonzeros of the column, the diagonal included
};

// For every position, the earlier positions that are joined with it.
struct Earlier {
  std::vector<Index> starts, positions;

  Earlier(const BlockGraph& graph, const std::vector<Index>& order) {
    std::vector<Index> position(order.size());
    for (std::size_t p = 0; p < order.size(); ++p) position[order[p]] = static_cast<Index>(p);
    starts.assign(order.size() + 1, 0);
    const auto visit = [&](const auto& use) {
      for (Index a = 0; a < graph.size(); ++a)
        for (const Index b : graph.larger(a)) {
          const auto [low, high] = std::minmax(position[a], position[b]);
          use(low, high);
        }
    };
    visit([&](Index, Index high) { ++starts[high + 1]; });
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    positions.resize(to_size(starts.back()));
    std::vector<Index> next(starts.begin(), starts.end() - 1);
    visit([&](Index low, Index high) { positions[next[high]++] = low; });
  }
  std::span<const Index> of(Index p) const {
    return {positions.data() + starts[p], positions.data() + starts[p + 1]};
  }
};

// Returns the elimination tree, by path compression [Liu90].
std::vector<Index> elimination_tree(const Earlier& earlier, Index size) {
  std::vector<Index> parent(to_size(size), -1), ancestor(to_size(size), -1);
  for (Index p = 0; p < size; ++p)
    for (Index q : earlier.of(p))
      while (q != p) {
        const Index above = std::exchange(ancestor[q], p);
        if (above < 0) {
          parent[q] = p;
          break;
        }
        q = above;
      }
  return parent;
}

// Row p of the factor has nonzeros in the subtree between p and its earlier neighbours.
std::vector<Index> column_counts(const Earlier& earlier, const std::vector<Index>& parent) {
  std::vector<Index> count(parent.size(), 1), seen(parent.size(), -1);
  for (Index p = 0; p < static_cast<Index>(parent.size()); ++p) {
    seen[p] = p;
    for (Index q : earlier.of(p))
      for (; seen[q] != p; q = parent[q]) {
        seen[q] = p;
        ++count[q];
      }
  }
  return count;
}

// Orders siblings such that the child with most nonzeros comes last: it can join its parent's
// supernode.
std::vector<Index> by_count(const Tree& tree) {
  std::vector<Index> order(tree.parent.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index p, Index q) { return tree.count[p] < tree.count[q]; });
  return order;
}

Tree renumbered(const Tree& tree, const std::vector<Index>& order) {
  std::vector<Index> moved(order.size());
  for (std::size_t p = 0; p < order.size(); ++p) moved[order[p]] = static_cast<Index>(p);
  Tree out;
  for (const Index old : order) {
    const Index parent = tree.parent[old];
    out.parent.push_back(parent < 0 ? -1 : moved[parent]);
    out.count.push_back(tree.count[old]);
  }
  return out;
}

// Successive positions that are eliminated together.
struct Supernode {
  Index first, columns, rows;  // rows: nonzero rows, the columns included
  double zeros;                // stored as nonzeros

  Index end() const { return first + columns; }
};

// Returns whether a supernode should be merged with `after`, which follows it and contains its
// parent.
bool worth_merging(const Supernode& supernode, const Supernode& after, double new_zeros) {
  const Index columns = supernode.columns + after.columns;
  if (columns <= kRelaxedBlocks[0] || new_zeros == 0) return true;
  const double size =
      0.5 * columns * (columns + 1.0) + static_cast<double>(columns) * (after.rows - after.columns);
  const double share = (after.zeros + new_zeros) / size;
  return (columns <= kRelaxedBlocks[1] && share < kRelaxedZeros[0]) ||
         (columns <= kRelaxedBlocks[2] && share < kRelaxedZeros[1]) || share < kRelaxedZeros[2];
}

// Columns with the same rows form a supernode; supernodes are then merged from the root down.
std::vector<Supernode> supernodes_of(const Tree& tree) {
  const auto size = static_cast<Index>(tree.parent.size());
  std::vector<Index> children(tree.parent.size(), 0);
  for (const Index parent : tree.parent)
    if (parent >= 0) ++children[parent];
  std::vector<Supernode> merged;  // in reverse order
  for (Index end = size; end > 0;) {
    Index first = end - 1;
    while (first > 0 && tree.parent[first - 1] == first && children[first] == 1 &&
           tree.count[first - 1] == tree.count[first] + 1)
      --first;
    Supernode supernode{first, end - first, tree.count[first], 0};
    const Index parent = tree.parent[end - 1];
    end = first;
    if (parent >= 0 && parent < merged.back().end()) {
      const Supernode& after = merged.back();
      const double new_zeros = static_cast<double>(supernode.columns) *
                               (after.rows + supernode.columns - supernode.rows);
      if (worth_merging(supernode, after, new_zeros)) {
        const bool is_small = supernode.columns + after.columns <= kRelaxedBlocks[0];
        merged.back() = {first, supernode.columns + after.columns, supernode.columns + after.rows,
                         after.zeros + (is_small ? 0 : new_zeros)};
        continue;
      }
    }
    merged.push_back(supernode);
  }
  std::reverse(merged.begin(), merged.end());
  return merged;
}

// Adds the positions that supernodes touch: the neighbours of their blocks, and the positions
// passed on by their children. They are as many as the rows of the supernodes.
void add_structure(const BlockGraph& graph, const std::vector<Supernode>& supernodes,
                   BlockElimination& out) {
  out.structure_starts.assign(1, 0);
  for (const Supernode& supernode : supernodes)
    out.structure_starts.push_back(out.structure_starts.back() + to_size(supernode.rows));
  out.structure.resize(out.structure_starts.back());
  std::vector<std::size_t> next(out.structure_starts.begin(), out.structure_starts.end() - 1);
  std::vector<Index> supernode_of(out.order.size()), parent(supernodes.size(), -1);
  for (std::size_t g = 0; g < supernodes.size(); ++g)
    for (Index p = supernodes[g].first; p < supernodes[g].end(); ++p) {
      supernode_of[p] = static_cast<Index>(g);
      out.structure[next[g]++] = p;
    }
  // Works row by row, so that every list is ascending: p is added to all supernodes on the paths
  // from its earlier neighbours up to p.
  const Earlier earlier(graph, out.order);
  std::vector<Index> seen(supernodes.size(), -1);
  for (Index p = 0; p < static_cast<Index>(out.order.size()); ++p) {
    const Index own = supernode_of[p];
    seen[own] = p;
    for (const Index q : earlier.of(p))
      for (Index g = supernode_of[q]; seen[g] != p; g = parent[g]) {
        seen[g] = p;
        out.structure[next[g]++] = p;
        if (parent[g] < 0) parent[g] = own;
      }
  }
}

}  // namespace

std::vector<Index> postorder(const std::vector<Index>& parent, const std::vector<Index>& siblings) {
  const std::size_t size = parent.size();
  std::vector<Index> first(size + 1, -1), next(size, -1), order, open;
  for (std::size_t k = size; k-- > 0;) {  // roots are children of a virtual root
    const Index p = siblings[k];
    Index& head = first[parent[p] < 0 ? size : to_size(parent[p])];
    next[p] = std::exchange(head, p);
  }
  for (Index root = first[size]; root >= 0; root = next[root]) {
    open.push_back(root);
    while (!open.empty()) {
      const Index p = open.back();
      if (const Index child = first[p]; child >= 0) {
        first[p] = next[child];
        open.push_back(child);
      } else {
        order.push_back(p);
        open.pop_back();
      }
    }
  }
  return order;
}

BlockElimination analyze_elimination(const BlockGraph& graph, std::vector<Index> order) {
  Tree tree;
  {
    const Earlier earlier(graph, order);
    tree.parent = elimination_tree(earlier, graph.size());
    tree.count = column_counts(earlier, tree.parent);
  }
  const std::vector<Index> positions = postorder(tree.parent, by_count(tree));
  BlockElimination out;
  for (const Index p : positions) out.order.push_back(order[p]);
  const std::vector<Supernode> supernodes = supernodes_of(renumbered(tree, positions));
  for (const Supernode& supernode : supernodes) out.supernode_starts.push_back(supernode.first);
  out.supernode_starts.push_back(graph.size());
  add_structure(graph, supernodes, out);
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
