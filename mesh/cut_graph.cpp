#include "majorant/mesh/cut_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/cut_shortening.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/union_find.h"

namespace majorant {
namespace {

class CutGraph {
 public:
  CutGraph(const SurfaceMesh& mesh, const std::vector<Index>& through, const Vec& edge_cost)
      : mesh_(mesh),
        is_terminal_(to_size(mesh.vertex_count()), 0),
        is_boundary_(mesh.boundary_flags()),
        leaving_(to_size(mesh.vertex_count())),
        length_(edge_cost),
        is_cut_(to_size(mesh.half_edge_count()), 0) {
    for (const Index v : through) {
      if (v < 0 || v >= mesh.vertex_count())
        throw InvalidArgument(
            fmt::format("{}cut: there is no vertex {} (counting from 0)", message_prefix(mesh), v));
      if (!is_boundary_[v]) is_terminal_[v] = 1;
    }
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      if (mesh.opposite(h) >= 0) leaving_[mesh.from_vertex(h)].push_back(h);
  }

  std::vector<char> find(const StopCheck& stop) {
    grow_trees();
    stop.poll();
    keep_longest_uncut();
    prune_cut(mesh_, is_terminal_, is_cut_);
    shorten_cut(mesh_, is_terminal_, length_, is_cut_, stop);
    make_slit();
    return std::move(is_cut_);
  }

 private:
  void set_cut(Index h, char value) { is_cut_[h] = is_cut_[mesh_.opposite(h)] = value; }

  // Finds shortest paths from all vertices to the boundary and the vertices of `through` (or else
  // to vertex 0). All of them are cut at first.
  void grow_trees() {
    distance_.assign(to_size(mesh_.vertex_count()), std::numeric_limits<double>::infinity());
    std::vector<Index> entered(distance_.size(), -1);
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (is_terminal_[v] || is_boundary_[v]) front.emplace(0, v);
    if (front.empty()) front.emplace(0, 0);
    for (auto sources = front; !sources.empty(); sources.pop()) distance_[sources.top().second] = 0;
    while (!front.empty()) {
      const auto [d, v] = front.top();
      front.pop();
      if (d > distance_[v]) continue;
      for (const Index h : leaving_[v]) {
        const Index w = mesh_.to_vertex(h);
        if (d + length_[h] >= distance_[w]) continue;
        distance_[w] = d + length_[h];
        entered[w] = h;
        front.emplace(distance_[w], w);
      }
    }
    for (const Index h : entered)
      if (h >= 0) set_cut(h, 1);
  }

  // Each other edge closes a path between sources. Leaving the longest uncut, unless it joins faces
  // that are joined already, keeps the shortest paths that make a disk.
  void keep_longest_uncut() {
    std::vector<std::pair<double, Index>> edges;  // minus the length of the path: longest first
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (mesh_.opposite(h) > h && !is_cut_[h])
        edges.emplace_back(
            -(distance_[mesh_.from_vertex(h)] + length_[h] + distance_[mesh_.to_vertex(h)]), h);
    std::sort(edges.begin(), edges.end());
    UnionFind faces(mesh_.face_count());
    for (const auto& [unused, h] : edges)
      if (!faces.join(face_of(h), face_of(mesh_.opposite(h)))) set_cut(h, 1);
  }

  // Extends the cut of a closed surface to two edges, along the shortest neighbours. The cut has no
  // edge before, or a single one, whose two sides have the same ends.
  void make_slit() {
    if (!mesh_.boundary_loops().empty()) return;
    Index at_end = 0;
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (is_terminal_[v]) at_end = v;
    for (auto count = std::count(is_cut_.begin(), is_cut_.end(), 1); count < 4; count += 2) {
      Index best = -1;
      for (const Index h : leaving_[at_end])
        if (!is_cut_[h] && (best < 0 || length_[h] < length_[best])) best = h;
      set_cut(best, 1);
    }
  }

  const SurfaceMesh& mesh_;
  std::vector<char> is_terminal_, is_boundary_;
  std::vector<std::vector<Index>> leaving_;  // per vertex, half-edges of interior edges
  const Vec& length_;                        // 3 #F
  std::vector<char> is_cut_;
  std::vector<double> distance_;
};

}  // namespace

Vec edge_lengths(const SurfaceMesh& mesh) {
  Vec length(mesh.half_edge_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) length[h] = mesh.edge_length(h);
  return length;
}

std::vector<char> cut_graph(const SurfaceMesh& mesh, const std::vector<Index>& through,
                            const StopCheck& stop) {
  return cut_graph(mesh, through, edge_lengths(mesh), stop);
}

std::vector<char> cut_graph(const SurfaceMesh& mesh, const std::vector<Index>& through,
                            const Vec& edge_cost, const StopCheck& stop) {
  return CutGraph(mesh, through, edge_cost).find(stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
