#include "majorant/mesh/cut_shortening.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace majorant {
namespace {

// Over all chains; most cuts need three or four: several times what was needed.
constexpr int kMaxSweeps = 20;
// Relative gain; rounding shall not exchange paths for ever: far above the rounding of a
// sum of lengths, far below an edge.
constexpr double kWorthwhile = 1e-9;
constexpr double kFar = std::numeric_limits<double>::infinity();

class Shortening {
 public:
  Shortening(const SurfaceMesh& mesh, const std::vector<char>& is_terminal, const Vec& edge_cost,
             std::vector<char>& is_cut)
      : mesh_(mesh),
        is_terminal_(is_terminal),
        is_cut_(is_cut),
        is_boundary_(mesh.boundary_flags()),
        leaving_(to_size(mesh.vertex_count())),
        length_(edge_cost),
        cuts_at_(to_size(mesh.vertex_count()), 0),
        distance_(to_size(mesh.vertex_count()), kFar),
        entered_(to_size(mesh.vertex_count()), -1),
        side_(to_size(mesh.half_edge_count()), kNoSide) {
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      if (mesh.opposite(h) >= 0) leaving_[mesh.from_vertex(h)].push_back(h);
      if (is_cut[h]) ++cuts_at_[mesh.from_vertex(h)];
    }
  }

  void run(const StopCheck& stop) {
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
      list_sides();
      bool any = false;
      for (std::size_t k = 0, count = sides_.size(); k < count; ++k) {
        stop.poll_at(k);
        const Index h = sides_[k];
        if (!is_cut_[h] || !is_node(mesh_.from_vertex(h))) continue;
        stop.poll();
        const std::vector<Index> chain = chain_from(h);
        if (h <= mesh_.opposite(chain.back())) any |= shorten(chain);  // else: met from there
      }
      if (!any) return;
    }
  }

  // Takes back the cuts from v on as long as they end at nothing.
  void prune_from(Index v) {
    while (!is_terminal_[v] && !is_boundary_[v] && cuts_at_[v] == 1) {
      const Index h = cut_leaving(v);
      set_cut(h, 0);
      v = mesh_.to_vertex(h);
    }
  }

 private:
  static constexpr char kNoSide = 2;

  bool is_node(Index v) const { return is_terminal_[v] || is_boundary_[v] || cuts_at_[v] != 2; }
  // A vertex of the boundary of the surface cut so far; terminals are holes without size.
  bool is_barrier(Index v) const { return is_terminal_[v] || is_boundary_[v] || cuts_at_[v] > 0; }
  bool is_side(Index h) const { return is_cut_[h] || mesh_.opposite(h) < 0; }

  void set_cut(Index h, char value) {
    is_cut_[h] = is_cut_[mesh_.opposite(h)] = value;
    for (const Index v : {mesh_.from_vertex(h), mesh_.to_vertex(h)}) cuts_at_[v] += value ? 1 : -1;
  }

  Index cut_leaving(Index v) const {
    for (const Index h : leaving_[v])
      if (is_cut_[h]) return h;
    return -1;
  }

  // Half-edges from the node where h starts to the next node.
  std::vector<Index> chain_from(Index h) const {
    std::vector<Index> chain{h};
    while (!is_node(mesh_.to_vertex(chain.back()))) {
      const Index last = chain.back();
      for (const Index g : leaving_[mesh_.to_vertex(last)])
        if (is_cut_[g] && g != mesh_.opposite(last)) {
          chain.push_back(g);
          break;
        }
    }
    return chain;
  }

  // Replaces the chain if there is a shorter one. True if so.
  bool shorten(const std::vector<Index>& chain) {
    double length = 0;
    for (const Index h : chain) {
      set_cut(h, 0);
      length += length_[h];
    }
    const Index ends[2] = {mesh_.from_vertex(chain.front()), mesh_.to_vertex(chain.back())};
    std::vector<Index> path;
    if (label_sides(ends) == 2) path = shortest_path(length * (1 - kWorthwhile));
    for (const Index h : labelled_) side_[h] = kNoSide;
    labelled_.clear();
    for (const Index h : path.empty() ? chain : path) set_cut(h, 1);
    if (path.empty()) return false;
    for (const Index h : path) sides_.insert(sides_.end(), {h, mesh_.opposite(h)});
    for (const Index v : ends) prune_from(v);
    return true;
  }

  void label(Index h, char side) {
    side_[h] = side;
    labelled_.push_back(h);
  }

  void list_sides() {
    sides_.clear();
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (is_side(h)) sides_.push_back(h);
  }

  // Gives every half-edge that leaves the boundary of the cut surface into its inside the number of
  // the boundary component there. Returns the number of components.
  int label_sides(const Index (&ends)[2]) {
    int count = 0;
    for (const Index start : sides_) {
      if (!is_side(start) || side_[start] != kNoSide || count > 2) continue;
      for (Index h = start; side_[h] == kNoSide;) {
        label(h, static_cast<char>(count));
        Index g = next(h);
        for (; !is_side(g); g = next(mesh_.opposite(g))) label(g, static_cast<char>(count));
        h = g;
      }
      ++count;
    }
    for (const Index v : ends)  // terminals that no other cut meets
      if (is_terminal_[v] && cuts_at_[v] == 0 && count < 3) {
        for (const Index h : leaving_[v]) label(h, static_cast<char>(count));
        ++count;
      }
    return count;
  }

  // Half-edges from one component to the other through the inside, empty if none is shorter.
  std::vector<Index> shortest_path(double limit) {
    // From the one with fewer half-edges, often a single vertex.
    const auto zeros =
        std::count_if(labelled_.begin(), labelled_.end(), [&](Index h) { return side_[h] == 0; });
    const char start = 2 * zeros <= static_cast<std::ptrdiff_t>(labelled_.size()) ? 0 : 1;
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    std::vector<Index> touched;
    Index last = -1;  // half-edge that arrives
    const auto reach = [&](Index h, double d) {
      const Index w = mesh_.to_vertex(h);
      if (is_barrier(w)) {
        if (d < limit && side_[mesh_.opposite(h)] == 1 - start) limit = d, last = h;
      } else if (d < limit && d < distance_[w]) {
        if (distance_[w] == kFar) touched.push_back(w);
        distance_[w] = d;
        entered_[w] = h;
        front.emplace(d, w);
      }
    };
    for (const Index h : labelled_)
      if (side_[h] == start && !is_side(h)) reach(h, length_[h]);
    while (!front.empty() && front.top().first < limit) {
      const auto [d, v] = front.top();
      front.pop();
      if (d > distance_[v]) continue;
      for (const Index h : leaving_[v]) reach(h, d + length_[h]);
    }
    std::vector<Index> path;
    for (Index h = last; h >= 0; h = entered_[mesh_.from_vertex(h)]) path.push_back(h);
    for (const Index v : touched) distance_[v] = kFar, entered_[v] = -1;
    return path;
  }

  const SurfaceMesh& mesh_;
  const std::vector<char>& is_terminal_;
  std::vector<char>& is_cut_;
  std::vector<char> is_boundary_;
  std::vector<std::vector<Index>> leaving_;  // per vertex, half-edges of interior edges
  const Vec& length_;                        // 3 #F
  std::vector<int> cuts_at_;                 // per vertex, cut edges
  std::vector<double> distance_;             // from where the search starts
  std::vector<Index> entered_;               // half-edge over which a vertex was reached
  std::vector<char> side_;
  std::vector<Index> labelled_;
  std::vector<Index> sides_;  // all half-edges with is_side(), and some that were
};

}  // namespace

void shorten_cut(const SurfaceMesh& mesh, const std::vector<char>& is_terminal,
                 const Vec& edge_cost, std::vector<char>& is_cut, const StopCheck& stop) {
  Shortening(mesh, is_terminal, edge_cost, is_cut).run(stop);
}

void prune_cut(const SurfaceMesh& mesh, const std::vector<char>& is_terminal,
               std::vector<char>& is_cut) {
  const Vec no_cost;
  Shortening cut(mesh, is_terminal, no_cost, is_cut);
  for (Index v = 0; v < mesh.vertex_count(); ++v) cut.prune_from(v);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
