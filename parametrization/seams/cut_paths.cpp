#include "majorant/parametrization/seams/cut_paths.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

#include "majorant/parametrization/seams/internal/cut_costs.h"

namespace majorant {
namespace {

// Rings of vertices around a path in which a better one is searched.
constexpr int kRings = 3;
// The cost of a turn by one radian, in mean edges: less than a detour by an edge, but positive, so
// that the straightest of equally long paths is taken.
constexpr double kTurnCost = 0.3;
// Upper bound on the cost of a smoother path, relative to that of the path it replaces.
constexpr double kMaxCostRatio = 1.03;
// The least angle defect of a node, radians: cuts pass such vertices on purpose.
constexpr double kNodeDefect = 0.2;

class Paths {
 public:
  Paths(const SurfaceMesh& mesh, const std::vector<Index>& through, std::vector<char>& is_cut)
      : mesh_(mesh),
        is_cut_(is_cut),
        is_boundary_(mesh.boundary_flags()),
        is_node_(is_boundary_),
        leaving_(to_size(mesh.vertex_count())),
        cuts_at_(to_size(mesh.vertex_count()), 0),
        distance_(to_size(mesh.half_edge_count()), kFar),
        entered_(to_size(mesh.half_edge_count()), -1),
        is_allowed_(to_size(mesh.vertex_count()), 0) {
    const Vec defect = angle_defects(mesh);
    double sum = 0;
    for (Index h = 0; h < mesh.half_edge_count(); ++h) {
      sum += mesh.edge_length(h);
      if (mesh.opposite(h) >= 0) leaving_[mesh.from_vertex(h)].push_back(h);
      if (is_cut[h]) ++cuts_at_[mesh.from_vertex(h)];
    }
    mean_ = sum / static_cast<double>(mesh.half_edge_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v)
      if (cuts_at_[v] != 2 || std::abs(defect[v]) > kNodeDefect) is_node_[v] = 1;
    for (const Index v : through) is_node_[v] = 1;
  }

  // Returns the half-edges of every path between two nodes, once. A loop with one node is two paths
  // that meet half way; a loop without a node is no path.
  std::vector<std::vector<Index>> all() const {
    std::vector<std::vector<Index>> paths;
    std::vector<char> is_seen(is_cut_.size(), 0);
    for (Index start = 0; start < mesh_.half_edge_count(); ++start) {
      if (!is_cut_[start] || is_seen[start] || !is_node_[mesh_.from_vertex(start)]) continue;
      std::vector<Index> path;
      for (Index h = start; h >= 0;) {
        path.push_back(h);
        is_seen[h] = is_seen[mesh_.opposite(h)] = 1;
        h = is_node_[mesh_.to_vertex(h)] ? -1 : onwards(h);
      }
      if (mesh_.from_vertex(path.front()) == mesh_.to_vertex(path.back())) {
        const auto half = path.begin() + static_cast<std::ptrdiff_t>(path.size() / 2);
        paths.emplace_back(path.begin(), half);
        path.erase(path.begin(), half);
      }
      paths.push_back(std::move(path));
    }
    return paths;
  }

  double turn(Index h, Index g) const {
    const Vector3 a = along(h), b = along(g);
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }
  double turning(const std::vector<Index>& path) const {
    double sum = 0;
    for (std::size_t k = 1; k < path.size(); ++k) sum += turn(path[k - 1], path[k]);
    return sum;
  }
  double mean_edge() const { return mean_; }

  // Returns the cheapest path near this one between its ends that meets no other cut.
  std::vector<Index> cheapest(const std::vector<Index>& path, const Vec& cost, double turn_cost) {
    const std::vector<Index> near = allow_near(path);
    const Index start = mesh_.from_vertex(path.front()), end = mesh_.to_vertex(path.back());
    const auto is_end = [&](Index v) { return v == start || v == end; };
    // A cut edge that joins both ends is part of another path.
    const auto is_other_cut = [&](Index g) {
      return path.size() > 1 && is_cut_[g] && is_end(mesh_.from_vertex(g)) &&
             is_end(mesh_.to_vertex(g));
    };
    using Reached = std::pair<double, Index>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    std::vector<Index> touched;
    const auto reach = [&](Index g, double d, Index from) {
      if (!is_allowed_[mesh_.to_vertex(g)] || d >= distance_[g] || is_other_cut(g)) return;
      if (distance_[g] == kFar) touched.push_back(g);
      distance_[g] = d;
      entered_[g] = from;
      front.emplace(d, g);
    };
    for (const Index g : leaving_[start]) reach(g, cost[g], -1);
    Index last = -1;
    while (!front.empty() && last < 0) {
      const auto [d, h] = front.top();
      front.pop();
      if (d > distance_[h]) continue;
      if (mesh_.to_vertex(h) == end) last = h;
      for (const Index g : leaving_[mesh_.to_vertex(h)])
        if (g != mesh_.opposite(h)) reach(g, d + cost[g] + turn_cost * turn(h, g), h);
    }
    std::vector<Index> found;
    for (Index h = last; h >= 0; h = entered_[h]) found.insert(found.begin(), h);
    for (const Index h : touched) distance_[h] = kFar, entered_[h] = -1;
    for (const Index v : near) is_allowed_[v] = 0;
    return found;
  }

  void replace(const std::vector<Index>& path, const std::vector<Index>& by) {
    for (const Index h : path) set_cut(h, 0);
    for (const Index h : by) set_cut(h, 1);
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  Vector3 along(Index h) const {
    return (mesh_.positions().row(mesh_.to_vertex(h)) - mesh_.positions().row(mesh_.from_vertex(h)))
        .transpose();
  }
  Index onwards(Index h) const {
    for (const Index g : leaving_[mesh_.to_vertex(h)])
      if (is_cut_[g] && g != mesh_.opposite(h)) return g;
    return -1;
  }
  void set_cut(Index h, char value) {
    is_cut_[h] = is_cut_[mesh_.opposite(h)] = value;
    for (const Index v : {mesh_.from_vertex(h), mesh_.to_vertex(h)}) cuts_at_[v] += value ? 1 : -1;
  }

  // Allows the vertices of the path and of rings around it, but of other cuts and the boundary only
  // the path's ends.
  std::vector<Index> allow_near(const std::vector<Index>& path) {
    std::vector<Index> near;
    const auto allow = [&](Index v) {
      if (is_allowed_[v]) return;
      is_allowed_[v] = 1;
      near.push_back(v);
    };
    for (const Index h : path) allow(mesh_.from_vertex(h));
    allow(mesh_.to_vertex(path.back()));
    std::size_t done = 0;
    for (int ring = 0; ring < kRings; ++ring)
      for (const std::size_t count = near.size(); done < count; ++done)
        for (const Index g : leaving_[near[done]]) {
          const Index w = mesh_.to_vertex(g);
          if (cuts_at_[w] == 0 && !is_boundary_[w]) allow(w);
        }
    return near;
  }

  const SurfaceMesh& mesh_;
  std::vector<char>& is_cut_;
  const std::vector<char> is_boundary_;  // #V
  std::vector<char> is_node_;            // #V
  std::vector<std::vector<Index>> leaving_;
  std::vector<int> cuts_at_;
  std::vector<double> distance_;  // by half-edge
  std::vector<Index> entered_;
  std::vector<char> is_allowed_;  // #V
  double mean_ = 0;
};

double sum_of(const Vec& cost, const std::vector<Index>& path) {
  double sum = 0;
  for (const Index h : path) sum += cost[h];
  return sum;
}

Vec lengths(const SurfaceMesh& mesh) {
  Vec length(mesh.half_edge_count());
  for (Index h = 0; h < mesh.half_edge_count(); ++h) length[h] = mesh.edge_length(h);
  return length;
}

}  // namespace

CutTurning turning_of_cuts(const SurfaceMesh& mesh, const std::vector<char>& is_cut) {
  std::vector<char> flags = is_cut;
  Paths paths(mesh, {}, flags);
  const Vec length = lengths(mesh);
  double angle = 0, along = 0, shortest_angle = 0, shortest_along = 0;
  for (const std::vector<Index>& path : paths.all()) {
    const std::vector<Index> shortest = paths.cheapest(path, length, 0);
    angle += paths.turning(path);
    along += sum_of(length, path);
    shortest_angle += paths.turning(shortest);
    shortest_along += sum_of(length, shortest);
  }
  const double degrees = paths.mean_edge() * 180 / std::numbers::pi;
  if (!(along > 0) || !(shortest_along > 0)) return {};
  return {degrees * angle / along, degrees * shortest_angle / shortest_along};
}

void smooth_cuts(const SurfaceMesh& mesh, const std::vector<Index>& through, const Vec& cost,
                 std::vector<char>& is_cut, const StopCheck& stop) {
  Paths paths(mesh, through, is_cut);
  for (const std::vector<Index>& path : paths.all()) {
    stop.poll();
    const std::vector<Index> other = paths.cheapest(path, cost, kTurnCost * paths.mean_edge());
    if (!other.empty() && paths.turning(other) < paths.turning(path) &&
        sum_of(cost, other) <= kMaxCostRatio * sum_of(cost, path))
      paths.replace(path, other);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
