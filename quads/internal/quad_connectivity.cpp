#include "majorant/quads/internal/quad_connectivity.h"

#include <algorithm>
#include <map>
#include <utility>

#include "majorant/quads/internal/quantization.h"

namespace majorant {

QuadConnectivity::QuadConnectivity(const TMesh& mesh, const std::vector<Index>& edges)
    : mesh_(mesh), edges_(edges), same_(0), same_on_held_(0) {
  vertex_count_ = static_cast<Index>(mesh.nodes.size());
  for (const Index count : edges) {
    first_on_arc_.push_back(vertex_count_);
    vertex_count_ += std::max(count - 1, 0);
  }
  for (const TPatch& patch : mesh.patches) {
    first_in_patch_.push_back(vertex_count_);
    vertex_count_ += std::max(sum_of(patch.sides[0], edges) - 1, 0) *
                     std::max(sum_of(patch.sides[1], edges) - 1, 0);
  }
  same_ = same_on_held_ = UnionFind(vertex_count_);
  join();
}

// Returns the vertex after `step` edges of the half-arc.
Index QuadConnectivity::vertex_on(Index half_arc, Index step) const {
  const Index arc = arc_of(half_arc), count = edges_[arc];
  const Index from_start = half_arc % 2 == 0 ? step : count - step;
  if (from_start == 0) return mesh_.arcs[arc].node[0];
  if (from_start == count) return mesh_.arcs[arc].node[1];
  return first_on_arc_[arc] + from_start - 1;
}

std::vector<Index> QuadConnectivity::vertices_of_side(const std::vector<Index>& half_arcs) const {
  std::vector<Index> vertices{mesh_.from_node(half_arcs.front())};
  for (const Index h : half_arcs)
    for (Index k = 1; k <= edges_[arc_of(h)]; ++k) vertices.push_back(vertex_on(h, k));
  return vertices;
}

void QuadConnectivity::join() {
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a) {
    if (edges_[a] > 0) continue;
    const auto& [from, to] = mesh_.arcs[a].node;
    same_.join(from, to);
    if (mesh_.is_held(a)) same_on_held_.join(from, to);
  }
  for (const TPatch& patch : mesh_.patches)
    for (std::size_t s = 0; s < 2; ++s) {
      if (sum_of(patch.sides[s], edges_) > 0) continue;
      const std::vector<Index> there = vertices_of_side(patch.sides[s + 1]);
      const std::vector<Index> back = vertices_of_side(patch.sides[(s + 3) % 4]);
      for (std::size_t i = 0; i < there.size(); ++i)
        same_.join(there[i], back[back.size() - 1 - i]);
    }
}

std::vector<Index> QuadConnectivity::vertices_of_held() const {
  std::vector<Index> vertices;
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a)
    if (mesh_.is_held(a))
      for (Index k = 0; k <= edges_[a]; ++k) vertices.push_back(vertex_on(2 * a, k));
  return vertices;
}

// Returns flags by name in same_: whether two cones, corners or parts of held lines are one vertex.
std::vector<char> QuadConnectivity::joins_too_much() {
  std::vector<char> is_joined(to_size(vertex_count_), 0);
  std::vector<Index> cone = std::vector<Index>(is_joined.size(), -1), stretch = cone;
  for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) {
    if (mesh_.nodes[n].vertex < 0) continue;
    const Index name = same_.find(static_cast<Index>(n));
    if (cone[name] >= 0) is_joined[name] = 1;
    cone[name] = static_cast<Index>(n);
  }
  for (const Index v : vertices_of_held()) {
    const Index name = same_.find(v), own = same_on_held_.find(v);
    if (stretch[name] >= 0 && stretch[name] != own) is_joined[name] = 1;
    stretch[name] = own;
    // Only inner cones are tested here.
    if (cone[name] >= 0 && mesh_.nodes[cone[name]].side == Side::Inside) is_joined[name] = 1;
  }
  return is_joined;
}

std::vector<Index> QuadConnectivity::joining_arcs() {
  std::vector<Index> arcs = arcs_of_short_borders();
  const std::vector<Index> joining = arcs_that_join(joins_too_much());
  arcs.insert(arcs.end(), joining.begin(), joining.end());
  return arcs;
}

std::vector<Index> QuadConnectivity::arcs_of_bad_quads() {
  struct QuadSide {
    std::array<Index, 2> vertices;
    std::size_t patch;
  };
  std::vector<QuadSide> sides;
  std::vector<char> is_bad(to_size(vertex_count_), 0);
  std::vector<std::pair<Index, std::size_t>> bad;  // vertex, patch
  for (std::size_t p = 0; p < mesh_.patches.size(); ++p)
    for (std::array<Index, 4> quad : quads_of(p)) {
      for (Index& v : quad) v = same_.find(v);
      for (std::size_t k = 0; k < 4; ++k) {
        sides.push_back({{quad[k], quad[(k + 1) % 4]}, p});
        if (quad[k] == quad[(k + 1) % 4] || quad[k] == quad[(k + 2) % 4])
          bad.emplace_back(quad[k], p);
      }
    }
  const auto before = [](const QuadSide& a, const QuadSide& b) { return a.vertices < b.vertices; };
  std::stable_sort(sides.begin(), sides.end(), before);
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].vertices == sides[i - 1].vertices)
      for (const Index v : sides[i].vertices) bad.emplace_back(v, sides[i].patch);
  for (const auto& [vertex, patch] : bad) is_bad[vertex] = 1;
  std::vector<Index> arcs = arcs_that_join(is_bad);
  if (!arcs.empty()) return arcs;
  const auto edge_length = [&](Index half_arc) {
    const Index a = arc_of(half_arc);
    return static_cast<double>(mesh_.arcs[a].length()) / (edges_[a] + 1);
  };
  for (const auto& [vertex, patch] : bad) {
    Index longest = mesh_.patches[patch].sides[0].front();
    for (const std::vector<Index>& side : mesh_.patches[patch].sides)
      for (const Index h : side)
        if (edge_length(h) > edge_length(longest)) longest = h;
    arcs.push_back(arc_of(longest));
  }
  return arcs;
}

// Returns the longest arcs for the vertices with is_joined, by their names in same_.
std::vector<Index> QuadConnectivity::arcs_that_join(const std::vector<char>& is_joined) {
  using Longest = std::map<Index, Index>;  // vertex -> arc
  const auto add = [&](Longest& longest, Index vertex, Index arc) {
    if (edges_[arc] > 0 || !is_joined[vertex]) return;
    const auto [found, is_new] = longest.try_emplace(vertex, arc);
    if (!is_new && mesh_.arcs[arc].length() > mesh_.arcs[found->second].length())
      found->second = arc;
  };
  Longest longest, across;
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a)
    add(longest, same_.find(mesh_.arcs[a].node[0]), a);
  // Some vertices have no arc: both long sides of a patch without width are on the border.
  for (const TPatch& patch : mesh_.patches)
    for (std::size_t s = 0; s < 2; ++s) {
      if (sum_of(patch.sides[s], edges_) > 0) continue;
      for (const Index v : vertices_of_side(patch.sides[s + 1]))
        for (const Index h : patch.sides[s]) add(across, same_.find(v), arc_of(h));
    }
  longest.merge(across);
  std::vector<Index> arcs;
  for (const auto& [vertex, arc] : longest) arcs.push_back(arc);
  return arcs;
}

// Returns an arc to lengthen for every border loop and closed feature line with fewer edges than a
// quad: the one with the longest edges.
std::vector<Index> QuadConnectivity::arcs_of_short_borders() const {
  constexpr Index kLeast = 4;
  UnionFind loops(static_cast<Index>(mesh_.nodes.size()));
  // Open feature lines are held apart at their ends.
  std::vector<char> is_around(edges_.size(), 0);
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a) {
    const std::vector<Index>& of_line = mesh_.lines[mesh_.arcs[a].line].arcs;
    is_around[a] = mesh_.is_on_border(a) ||
                   (mesh_.is_on_feature(a) &&
                    mesh_.arcs[of_line.front()].node[0] == mesh_.arcs[of_line.back()].node[1]);
  }
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a)
    if (mesh_.is_on_border(a)) loops.join(mesh_.arcs[a].node[0], mesh_.arcs[a].node[1]);
  struct Loop {
    Index edges = 0, arc = -1;
    double longest = 0;
  };
  std::map<std::pair<Index, Index>, Loop> found;  // by node and feature line
  for (Index a = 0; a < static_cast<Index>(edges_.size()); ++a) {
    if (!is_around[a]) continue;
    const bool is_border = mesh_.is_on_border(a);
    Loop& loop = found[{is_border ? loops.find(mesh_.arcs[a].node[0]) : -1,
                        is_border ? -1 : mesh_.arcs[a].line}];
    loop.edges += edges_[a];
    const double length = static_cast<double>(mesh_.arcs[a].length()) / (edges_[a] + 1);
    if (length > loop.longest) {
      loop.longest = length;
      loop.arc = a;
    }
  }
  std::vector<Index> arcs;
  for (const auto& [name, loop] : found)
    if (loop.edges < kLeast) arcs.push_back(loop.arc);
  return arcs;
}

std::vector<std::array<Index, 4>> QuadConnectivity::quads_of(std::size_t patch) const {
  const auto& sides = mesh_.patches[patch].sides;
  const std::vector<Index> lower = vertices_of_side(sides[0]), right = vertices_of_side(sides[1]),
                           upper = vertices_of_side(sides[2]), left = vertices_of_side(sides[3]);
  const std::size_t p = lower.size() - 1, q = right.size() - 1;
  const auto vertex = [&](std::size_t a, std::size_t b) {
    if (b == 0) return lower[a];
    if (b == q) return upper[p - a];
    if (a == 0) return left[q - b];
    if (a == p) return right[b];
    return first_in_patch_[patch] + static_cast<Index>((b - 1) * (p - 1) + a - 1);
  };
  std::vector<std::array<Index, 4>> quads;
  for (std::size_t b = 0; b < q; ++b)
    for (std::size_t a = 0; a < p; ++a)
      quads.push_back({vertex(a, b), vertex(a + 1, b), vertex(a + 1, b + 1), vertex(a, b + 1)});
  return quads;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
