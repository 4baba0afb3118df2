#include "majorant/parametrization/fields/internal/quarter_turn_graph.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace majorant {
namespace {

// Upper bound on the mean angle of the triangles at a vertex, degrees. A seamless map needs every
// angle below 180 degrees; this bound leaves room to untangle. Chosen, not tuned.
constexpr int kLargestMeanAngle = 120;
// One quad around an inner vertex would share an edge with itself.
constexpr int kLeastQuads = 2;

}  // namespace

QuarterTurnGraph::QuarterTurnGraph(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                                   const std::vector<char>& is_fixed, AlignedSectors sectors,
                                   int least_turns, FieldConnection& field)
    : mesh_(mesh),
      geometry_(geometry),
      is_fixed_(is_fixed),
      sectors_(std::move(sectors)),
      least_turns_(least_turns),
      field_(field),
      leaving_(to_size(mesh.vertex_count()) + sectors_.faces.size()) {
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (sectors_.at.empty() || sectors_.at[v].empty())
      nodes_.push_back(v);
    else
      for (const Index s : sectors_.at[v]) nodes_.push_back(mesh.vertex_count() + s);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_movable(h)) leaving_[start(h)].push_back(h);
}

bool QuarterTurnGraph::is_movable(Index half_edge) const {
  const Index o = mesh_.opposite(half_edge);
  if (o < 0 || (!sectors_.is_bound.empty() && sectors_.is_bound[half_edge])) return false;
  return is_fixed_.empty() || !is_fixed_[face_of(half_edge)] || !is_fixed_[face_of(o)] ||
         is_sector(start(half_edge)) || is_sector(end(half_edge));
}

Index QuarterTurnGraph::start(Index half_edge) const {
  const bool in_sector = !sectors_.of_corner.empty() && sectors_.of_corner[half_edge] >= 0;
  return in_sector ? mesh_.vertex_count() + sectors_.of_corner[half_edge]
                   : mesh_.from_vertex(half_edge);
}

int QuarterTurnGraph::least_turns(Index node) const {
  if (is_sector(node)) return sectors_.least[sector(node)];
  if (sectors_.of_corner.empty()) return least_turns_;
  return std::max({kLeastQuads, least_turns_,
                   least_turns_at(geometry_.angle_sum[node] / kQuarter, regular(node))});
}

int QuarterTurnGraph::most_turns(Index node) const {
  if (!is_sector(node)) return std::max(4, geometry_.valence[node] * kLargestMeanAngle / 90);
  // Faces hold less than two quarter turns each.
  const int faces = sectors_.faces[sector(node)];
  return std::max(faces * kLargestMeanAngle / 90, std::min(regular(node), 2 * faces - 1));
}

int QuarterTurnGraph::excess(Index node) const {
  if (is_unbounded(node)) return 0;
  const int least = least_turns(node);
  return turns(node) < least ? turns(node) - least : std::max(0, turns(node) - most_turns(node));
}

int QuarterTurnGraph::change(Index from, Index to) const {
  const auto cost = [&](Index v, int step) {
    return is_unbounded(v)
               ? 0
               : std::abs(turns(v) + step - regular(v)) - std::abs(turns(v) - regular(v));
  };
  return cost(from, -1) + cost(to, 1);
}

void QuarterTurnGraph::move(Index half_edge) {
  move_quarter(mesh_, geometry_, half_edge, field_);
  if (const Index v = start(half_edge); is_sector(v)) --sectors_.turns[sector(v)];
  if (const Index w = end(half_edge); is_sector(w)) ++sectors_.turns[sector(w)];
}

bool QuarterTurnGraph::send(Index node, int step, const std::function<bool(Index)>& is_goal,
                            int most_edges) {
  std::vector<Index> entered(leaving_.size(), -1), queue{node};
  std::size_t round_end = 1;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    if (next == round_end) {
      if (--most_edges == 0) return false;
      round_end = queue.size();
    }
    for (const Index h : leaving_[queue[next]]) {
      const Index w = end(h);
      if (w == node || entered[w] >= 0) continue;
      entered[w] = h;
      if (is_goal(w)) {
        for (Index u = w; u != node; u = start(entered[u]))
          move(step > 0 ? entered[u] : mesh_.opposite(entered[u]));
        return true;
      }
      queue.push_back(w);
    }
  }
  return false;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
