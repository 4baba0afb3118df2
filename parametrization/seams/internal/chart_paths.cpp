#include "majorant/parametrization/seams/internal/chart_paths.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <queue>

#include "majorant/parametrization/seams/internal/cut_costs.h"

namespace majorant {
namespace {

using Reached = std::pair<double, Index>;  // distance, vertex
using ReachedFront = std::priority_queue<Reached, std::vector<Reached>, std::greater<>>;

constexpr double kNotReached = std::numeric_limits<double>::infinity();

}  // namespace

const std::vector<Index>& longest_loop(const SurfaceMesh& mesh) {
  const auto& loops = mesh.boundary_loops();
  std::size_t longest = 0;
  for (std::size_t l = 1; l < loops.size(); ++l)
    if (loops[l].size() > loops[longest].size()) longest = l;
  return loops[longest];
}

ChartPaths::ChartPaths(const SurfaceMesh& mesh, const Vec& cost, std::vector<Index> outline)
    : mesh_(mesh),
      leaving_(to_size(mesh.vertex_count())),
      outline_(std::move(outline)),
      place_(to_size(mesh.vertex_count()), -1) {
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    const Index o = mesh.opposite(h);
    leaving_[mesh.from_vertex(h)].push_back({mesh.to_vertex(h), h, o >= 0 ? cost[h] : 0.0});
    if (o < 0) leaving_[mesh.to_vertex(h)].push_back({mesh.from_vertex(h), h, 0.0});
  }
  for (std::size_t i = 0; i < outline_.size(); ++i) place_[outline_[i]] = static_cast<Index>(i);
}

Index ChartPaths::steps(Index from, Index to) const {
  const auto n = static_cast<Index>(outline_.size());
  return (place_[to] - place_[from] + n) % n;
}

PathSearch ChartPaths::search(const std::vector<Index>& sources, const IsEnd& is_end,
                              Index* end) const {
  PathSearch search{std::vector<double>(leaving_.size(), kNotReached),
                    std::vector<std::pair<Index, Index>>(leaving_.size(), {-1, -1})};
  std::vector<double>& distance = search.distance;
  ReachedFront front;
  for (const Index v : sources) {
    distance[v] = 0;
    front.emplace(0, v);
  }
  while (!front.empty()) {
    const auto [d, v] = front.top();
    front.pop();
    if (d > distance[v]) continue;
    if (d > 0 && place_[v] >= 0) {
      if (!is_end(v)) continue;  // paths do not run along the outline
      *end = v;
      break;
    }
    for (const Way& way : leaving_[v]) {
      const bool is_on_outline = mesh_.opposite(way.half_edge) < 0 && place_[v] >= 0;
      if (is_on_outline || d + way.cost >= distance[way.to]) continue;
      distance[way.to] = d + way.cost;
      search.entered[way.to] = {v, way.half_edge};
      front.emplace(distance[way.to], way.to);
    }
  }
  return search;
}

PathSearch ChartPaths::all_from(Index source) const {
  Index end = -1;
  return search(
      {source}, [](Index) { return false; }, &end);
}

void ChartPaths::find(const std::vector<Index>& sources, const IsEnd& is_end,
                      const Found& found) const {
  Index end = -1;
  const PathSearch result = search(sources, is_end, &end);
  if (end >= 0) found(result, end);
}

void ChartPaths::find_around(Index source, const StopCheck& stop, const Found& found) const {
  const auto n = static_cast<Index>(outline_.size());
  for (Index k = 0; k < kWindows; ++k) {
    stop.poll();
    const Index from = k * n / kWindows, to = (k + 1) * n / kWindows;
    const auto is_end = [&](Index w) {
      return w != source && steps(source, w) >= from && steps(source, w) < to;
    };
    find({source}, is_end, found);
  }
}

void ChartPaths::find_between_ends(const StopCheck& stop, const Found& found) const {
  const Index one = farthest(edge_distances(outline_[0]));
  const Vec far = edge_distances(one);
  const Index other = farthest(far);
  for (Index k = 1; k + 2 < kWindows; ++k) {
    stop.poll();
    const double low = far[other] * k / kWindows, high = far[other] * (k + 2) / kWindows;
    const auto is_in = [&](Index w) { return far[w] >= low && far[w] <= high; };
    const auto is_left = [&](Index w) { return steps(one, w) < steps(one, other); };
    std::vector<Index> sources;
    for (const Index w : outline_)
      if (w != one && is_in(w) && is_left(w)) sources.push_back(w);
    find(
        sources, [&](Index w) { return w != other && is_in(w) && !is_left(w); }, found);
  }
}

Index ChartPaths::overlapping_corner() const {
  Vec angle = Vec::Zero(mesh_.vertex_count());
  for (Index h = 0; h < mesh_.half_edge_count(); ++h)
    angle[mesh_.from_vertex(h)] += corner_angle(mesh_, h).radians();
  Index corner = -1;
  double largest = 2 * std::numbers::pi - kCurved;
  for (const Index v : outline_)
    if (angle[v] > largest) largest = angle[v], corner = v;
  return corner;
}

// Returns distances along edges, boundary edges included.
Vec ChartPaths::edge_distances(Index source) const {
  Vec distance = Vec::Constant(mesh_.vertex_count(), kNotReached);
  ReachedFront front;
  distance[source] = 0;
  front.emplace(0, source);
  while (!front.empty()) {
    const auto [d, v] = front.top();
    front.pop();
    if (d > distance[v]) continue;
    for (const Way& way : leaving_[v]) {
      const double next = d + mesh_.edge_length(way.half_edge);
      if (next >= distance[way.to]) continue;
      distance[way.to] = next;
      front.emplace(next, way.to);
    }
  }
  return distance;
}

// Returns the vertex of the outline at the largest distance.
Index ChartPaths::farthest(const Vec& distance) const {
  return *std::max_element(outline_.begin(), outline_.end(),
                           [&](Index a, Index b) { return distance[a] < distance[b]; });
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
