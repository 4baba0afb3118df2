#include "majorant/parametrization/seams/internal/cut_branches.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "majorant/parametrization/seams/internal/pieces.h"

namespace majorant {
namespace {

// Branches that may be taken back, at most: G is dense and has a row or two for each. Cuts of usual
// surfaces have some hundreds of branches; those that join thousands of holes have as many.
constexpr std::size_t kMaxTreeBranches = 500;

// Builds the tree. A node is a vertex, a boundary loop or the root.
class BranchBuilder {
 public:
  BranchBuilder(const SurfaceMesh& mesh, const std::vector<char>& is_cut, const Vec& edge_cost)
      : mesh_(mesh),
        cost_(edge_cost),
        is_cut_(is_cut),
        node_(to_size(mesh.vertex_count())),
        root_(mesh.vertex_count() + static_cast<Index>(mesh.boundary_loops().size())) {
    result_.is_root_cut.assign(is_cut.size(), 0);
  }

  CutBranches build(const std::vector<char>& is_terminal, Index count) {
    contract_loops();
    find_root();
    double cost = 0;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (is_cut_[h] && !result_.is_root_cut[h]) cost += 0.5 * cost_[h];
    grow(is_terminal, cost / count);
    if (result_.all.size() > kMaxTreeBranches) {
      put_into_root(inner_half_edges());
      result_.all.clear();
      grow(is_terminal, cost / count);
    }
    for (const Index node : node_) result_.is_inside.push_back(node < mesh_.vertex_count());
    return std::move(result_);
  }

 private:
  using Edges = std::vector<std::vector<Index>>;  // per node, half-edges that leave it

  void contract_loops() {
    for (Index v = 0; v < mesh_.vertex_count(); ++v) node_[v] = v;
    const auto& loops = mesh_.boundary_loops();
    for (std::size_t l = 0; l < loops.size(); ++l)
      for (const Index v : loops[l]) node_[v] = mesh_.vertex_count() + static_cast<Index>(l);
  }

  Edges cut_edges() const {
    Edges leaving(to_size(root_) + 1);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (is_cut_[h] && !result_.is_root_cut[h]) leaving[node_[mesh_.from_vertex(h)]].push_back(h);
    return leaving;
  }

  void find_root() {
    const auto& loops = mesh_.boundary_loops();
    if (genus(mesh_) > 0) {
      put_into_root(cycles());
    } else if (loops.empty()) {
      put_into_root(middle_edges());
    } else {
      std::size_t longest = 0;
      double most = -1;
      for (std::size_t l = 0; l < loops.size(); ++l) {
        double length = 0;
        for (std::size_t i = 0; i < loops[l].size(); ++i)
          length += (mesh_.positions().row(loops[l][i]) -
                     mesh_.positions().row(loops[l][(i + 1) % loops[l].size()]))
                        .norm();
        if (length > most) most = length, longest = l;
      }
      for (const Index v : loops[longest]) node_[v] = root_;
      for (Index h = 0; h < mesh_.half_edge_count() && result_.outer < 0; ++h)
        if (node_[mesh_.from_vertex(h)] == root_) result_.outer = h;
    }
  }

  void put_into_root(const std::vector<Index>& half_edges) {
    std::vector<char> in_root(to_size(root_) + 1, 0);
    for (const Index h : half_edges) {
      result_.is_root_cut[h] = result_.is_root_cut[mesh_.opposite(h)] = 1;
      for (const Index v : {mesh_.from_vertex(h), mesh_.to_vertex(h)}) in_root[node_[v]] = 1;
    }
    if (!half_edges.empty()) result_.outer = half_edges.front();
    for (Index& node : node_)
      if (in_root[node]) node = root_;
  }

  // Returns two edges in the middle of the longest path of a cut that is a tree.
  std::vector<Index> middle_edges() const {
    const Edges leaving = cut_edges();
    std::vector<Index> entered;
    const auto farthest_from = [&](Index start) {
      entered.assign(leaving.size(), -1);
      std::vector<std::pair<Index, double>> stack{{start, 0}};
      std::pair<Index, double> farthest = stack[0];
      while (!stack.empty()) {
        const auto [v, distance] = stack.back();
        stack.pop_back();
        if (distance > farthest.second) farthest = {v, distance};
        for (const Index h : leaving[v]) {
          if (entered[v] >= 0 && h == mesh_.opposite(entered[v])) continue;
          entered[mesh_.to_vertex(h)] = h;
          stack.emplace_back(mesh_.to_vertex(h), distance + cost_[h]);
        }
      }
      return farthest;
    };
    Index some = 0;
    while (leaving[some].empty()) ++some;
    const auto [end, length] = farthest_from(farthest_from(some).first);
    double distance = 0;
    Index h = entered[end];
    for (Index before = entered[mesh_.from_vertex(h)]; before >= 0;
         before = entered[mesh_.from_vertex(h)]) {
      distance += cost_[h];
      if (2 * distance >= length || entered[mesh_.from_vertex(before)] < 0) return {before, h};
      h = before;
    }
    return {h};  // an edge beside a cut that opens the surface
  }

  // Returns the cycles of the cut: the edges left after every branch with an end is removed.
  std::vector<Index> cycles() const {
    const Edges leaving = cut_edges();
    std::vector<std::size_t> degree(leaving.size());
    std::vector<Index> ends;
    std::vector<char> kept = is_cut_;
    for (std::size_t n = 0; n < leaving.size(); ++n)
      if ((degree[n] = leaving[n].size()) == 1) ends.push_back(static_cast<Index>(n));
    while (!ends.empty()) {
      const Index n = ends.back();
      ends.pop_back();
      for (const Index h : leaving[n]) {
        if (!kept[h]) continue;
        kept[h] = kept[mesh_.opposite(h)] = 0;
        const Index m = node_[mesh_.to_vertex(h)];
        if (--degree[m] == 1) ends.push_back(m);
      }
    }
    std::vector<Index> edges;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (kept[h] && h < mesh_.opposite(h)) edges.push_back(h);
    return edges;
  }

  void grow(const std::vector<char>& is_terminal, double length) {
    const Edges leaving = cut_edges();
    std::vector<std::pair<Index, Index>> starts;  // half-edge, branch below
    for (const Index h : leaving[root_]) starts.emplace_back(h, -1);
    while (!starts.empty()) {
      auto [h, parent] = starts.back();
      starts.pop_back();
      const auto number = static_cast<Index>(result_.all.size());
      CutBranch branch;
      branch.parent = parent;
      Index node = -1;
      for (;;) {
        branch.half_edges.push_back(h);
        branch.cost += cost_[h];
        node = node_[mesh_.to_vertex(h)];
        const std::vector<Index>& on = leaving[node];
        if (branch.cost >= length || on.size() != 2 || node >= mesh_.vertex_count() ||
            is_terminal[node])
          break;
        h = on[on[0] == mesh_.opposite(h) ? 1 : 0];
      }
      for (const Index g : leaving[node])
        if (g != mesh_.opposite(h)) starts.emplace_back(g, number);
      result_.all.push_back(std::move(branch));
    }
  }

  // Returns the half-edges of all branches but kMaxTreeBranches. These are the outermost ones, the
  // costliest first. The height of a branch is the longest chain of branches that hang from it.
  std::vector<Index> inner_half_edges() const {
    std::vector<int> height(result_.all.size(), 0);
    for (std::size_t t = result_.all.size(); t-- > 0;)
      if (const Index p = result_.all[t].parent; p >= 0)
        height[p] = std::max(height[p], height[t] + 1);
    std::vector<std::size_t> order(result_.all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return height[a] != height[b] ? height[a] < height[b]
                                    : result_.all[a].cost > result_.all[b].cost;
    });
    std::vector<Index> inner;
    for (std::size_t k = kMaxTreeBranches; k < order.size(); ++k)
      inner.insert(inner.end(), result_.all[order[k]].half_edges.begin(),
                   result_.all[order[k]].half_edges.end());
    return inner;
  }

  const SurfaceMesh& mesh_;
  const Vec& cost_;
  const std::vector<char>& is_cut_;  // 3 #F
  std::vector<Index> node_;          // #V: its number as a node
  const Index root_;                 // number of the root as a node
  CutBranches result_;
};

}  // namespace

CutBranches cut_branches(const SurfaceMesh& mesh, const std::vector<char>& is_cut,
                         const std::vector<char>& is_terminal, const Vec& edge_cost, Index count) {
  return BranchBuilder(mesh, is_cut, edge_cost).build(is_terminal, count);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
