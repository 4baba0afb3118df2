#include "majorant/mesh/cut_shortening.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace majorant {
namespace {

// The maximum number of sweeps over all chains; most cuts need three or four.
constexpr int kMaxSweeps = 20;
// The least relative gain of a replacement: far above the rounding of a sum of lengths, so that
// paths are not exchanged forever, and far below the length of an edge.
constexpr double kWorthwhile = 1e-9;
constexpr double kFar = std::numeric_limits<double>::infinity();
// Above this number of half-edges along cuts and boundaries, a chain is compared only with paths
// that begin within its own length of it. Otherwise each of thousands of holes requires a search of
// half of the surface. Distant paths between holes gain nothing, since the first cuts are a
// shortest tree.
constexpr std::size_t kMaxWholeSides = 30000;

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
        is_from_(to_size(mesh.half_edge_count()), 0),
        rank_(to_size(mesh.half_edge_count()), -1) {
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      if (mesh.opposite(h) >= 0) leaving_[mesh.from_vertex(h)].push_back(h);
      if (is_cut[h]) ++cuts_at_[mesh.from_vertex(h)];
    }
  }

  void run(const StopCheck& stop) {
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
      list_sides();
      if (sweep == 0 && sides_.size() > kMaxWholeSides) {
        reach_.assign(distance_.size(), kFar);
        changed_.assign(distance_.size(), 0);
        examined_.assign(is_from_.size(), -1);
      }
      bool any = false;
      for (std::size_t k = 0, count = sides_.size(); k < count; ++k) {
        stop.poll_at(k);
        const Index h = sides_[k];
        if (!is_cut_[h] || !is_node(mesh_.from_vertex(h))) continue;
        stop.poll();
        const std::vector<Index> chain = chain_from(h);
        if (h <= mesh_.opposite(chain.back())) any |= shorten(chain);  // else from its end
      }
      if (!any) return;
    }
  }

  // Removes the cuts from v on as long as they end at nothing.
  void prune_from(Index v) {
    while (!is_terminal_[v] && !is_boundary_[v] && cuts_at_[v] == 1) {
      const Index h = cut_leaving(v);
      set_cut(h, 0);
      v = mesh_.to_vertex(h);
    }
  }

 private:
  bool is_node(Index v) const { return is_terminal_[v] || is_boundary_[v] || cuts_at_[v] != 2; }
  // Returns whether v is on the boundary of the cut surface; terminals are holes without size.
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

  // Returns the half-edges from the node where h starts to the next node.
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

  // Replaces the chain if there is a shorter one, and returns whether it did.
  bool shorten(const std::vector<Index>& chain) {
    double length = 0;
    for (const Index h : chain) length += length_[h];
    const std::vector<Index> nearby =
        is_local() ? vertices_near(chain, length) : std::vector<Index>();
    if (is_local() && !is_changed_near(chain, nearby)) return leave(nearby);
    for (const Index h : chain) set_cut(h, 0);
    const Index last = mesh_.opposite(chain.back());
    Boundary one = boundary_at(chain.front()), other = boundary_at(last);
    const std::vector<Index> path = shortest_path(smaller(one, other), length * (1 - kWorthwhile));
    leave(nearby);
    for (const Index h : path.empty() ? chain : path) set_cut(h, 1);
    if (path.empty()) return false;
    ++changes_;
    if (is_local())
      for (const std::vector<Index>* part : {&chain, &path})
        for (const Index h : *part)
          changed_[mesh_.to_vertex(h)] = changed_[mesh_.from_vertex(h)] = changes_;
    for (const Index h : path) {
      add_side(h);
      add_side(mesh_.opposite(h));
    }
    for (const Index h : {chain.front(), last}) prune_from(mesh_.from_vertex(h));
    return true;
  }

  bool is_local() const { return !reach_.empty(); }

  // Returns the vertices within this distance of the chain; reach_ holds their distances until
  // leave().
  std::vector<Index> vertices_near(const std::vector<Index>& chain, double limit) {
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    std::vector<Index> nearby;
    const auto reach = [&](Index v, double d) {
      if (d >= reach_[v] || d > limit) return;
      if (reach_[v] == kFar) nearby.push_back(v);
      reach_[v] = d;
      front.emplace(d, v);
    };
    reach(mesh_.from_vertex(chain.front()), 0);
    for (const Index h : chain) reach(mesh_.to_vertex(h), 0);
    while (!front.empty()) {
      const auto [d, v] = front.top();
      front.pop();
      if (d > reach_[v]) continue;
      for (const Index h : leaving_[v]) reach(mesh_.to_vertex(h), d + length_[h]);
    }
    return nearby;
  }
  bool leave(const std::vector<Index>& nearby) {
    for (const Index v : nearby) reach_[v] = kFar;
    return false;
  }

  // Returns whether cuts near the chain have changed since it was last examined, and marks it as
  // examined.
  bool is_changed_near(const std::vector<Index>& chain, const std::vector<Index>& nearby) {
    const int before = examined_[chain.front()];
    examined_[chain.front()] = changes_;
    return before < 0 ||
           std::any_of(nearby.begin(), nearby.end(), [&](Index v) { return changed_[v] > before; });
  }

  void list_sides() {
    sides_.clear();
    std::fill(rank_.begin(), rank_.end(), -1);
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (is_side(h)) add_side(h);
  }
  void add_side(Index h) {
    if (rank_[h] < 0) rank_[h] = static_cast<Index>(sides_.size());
    sides_.push_back(h);
  }

  // A boundary component of the cut surface: the half-edges that leave it to the inside, in the
  // order along it; for a terminal that no cut meets, all half-edges that leave it.
  struct Boundary {
    std::vector<Index> leaving = {};
    Index start = -1, side = -1;  // of the walk along it: the first half-edge, and the last one met
    Index rank = std::numeric_limits<Index>::max();  // the smallest number of its sides
    std::size_t first = 0;                           // the place of that side in `leaving`
    bool is_whole = false;
  };

  // Returns the component around the vertex that h leaves; h is no side.
  Boundary boundary_at(Index h) const {
    const Index v = mesh_.from_vertex(h);
    Boundary boundary;
    if (is_boundary_[v] || cuts_at_[v] > 0) {
      Index g = h;
      while (!is_side(g)) g = next(mesh_.opposite(g));
      boundary.start = boundary.side = g;
    } else {
      if (is_terminal_[v]) boundary.leaving = leaving_[v];
      boundary.is_whole = true;
    }
    return boundary;
  }

  // Walks along the component to the next side.
  void walk_on(Boundary& boundary) const {
    if (rank_[boundary.side] < boundary.rank) {
      boundary.rank = rank_[boundary.side];
      boundary.first = boundary.leaving.size();
    }
    boundary.leaving.push_back(boundary.side);
    Index g = next(boundary.side);
    for (; !is_side(g); g = next(mesh_.opposite(g))) boundary.leaving.push_back(g);
    boundary.side = g;
    boundary.is_whole = g == boundary.start;
  }

  // Returns the component with fewer half-edges; of equal ones, that with the smaller first side.
  // Takes as many steps as a walk along that component.
  Boundary& smaller(Boundary& one, Boundary& other) const {
    for (;;) {
      if (one.is_whole && one.leaving.size() < other.leaving.size()) return one;
      if (other.is_whole && other.leaving.size() < one.leaving.size()) return other;
      if (one.is_whole && other.is_whole) return other.rank < one.rank ? other : one;
      const bool is_one =
          other.is_whole || (!one.is_whole && one.leaving.size() <= other.leaving.size());
      walk_on(is_one ? one : other);
    }
  }

  // Returns the half-edges of the shortest path through the inside, from this boundary component to
  // the other one; none if no path is shorter than `limit`.
  std::vector<Index> shortest_path(const Boundary& from, double limit) {
    for (const Index h : from.leaving) is_from_[h] = 1;
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    std::vector<Index> touched;
    Index last = -1;  // half-edge that arrives
    const auto reach = [&](Index h, double d) {
      const Index w = mesh_.to_vertex(h);
      if (is_barrier(w)) {
        if (d < limit && !is_from_[mesh_.opposite(h)]) limit = d, last = h;
      } else if (d < limit && d < distance_[w]) {
        if (distance_[w] == kFar) touched.push_back(w);
        distance_[w] = d;
        entered_[w] = h;
        front.emplace(d, w);
      }
    };
    const std::size_t count = from.leaving.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Index h = from.leaving[(from.first + k) % count];
      if (!is_side(h) && (!is_local() || reach_[mesh_.from_vertex(h)] < kFar)) reach(h, length_[h]);
    }
    while (!front.empty() && front.top().first < limit) {
      const auto [d, v] = front.top();
      front.pop();
      if (d > distance_[v]) continue;
      for (const Index h : leaving_[v]) reach(h, d + length_[h]);
    }
    for (const Index h : from.leaving) is_from_[h] = 0;
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
  std::vector<double> distance_;             // from the start of the search
  std::vector<Index> entered_;               // half-edge over which a vertex was reached
  std::vector<char> is_from_;                // half-edges
  std::vector<Index> sides_;                 // all half-edges with is_side(), and some that were
  std::vector<Index> rank_;                  // the first place of a half-edge in sides_, or -1
  // Empty if all paths are compared. Per vertex: the distance from a chain, and the last change
  // that touched it. Per half-edge: the change before which the chain that begins there was
  // examined.
  std::vector<double> reach_;
  std::vector<int> changed_, examined_;
  int changes_ = 0;
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
