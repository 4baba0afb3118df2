#include "majorant/quads/internal/motorcycle_starts.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/quads/features.h"
#include "majorant/quads/internal/border.h"

namespace majorant {
namespace {

class StartFinder {
 public:
  explicit StartFinder(const SeamlessLattice& lattice)
      : lattice_(lattice),
        surface_(lattice.surface()),
        is_start_(held_corners(surface_, lattice.features(), lattice.border_turn())) {
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      is_start_[v] |= lattice.is_cone(v) || is_corner_of_feature(v);
  }

  MotorcycleStarts start() {
    const FeatureLines features = feature_lines(surface_, lattice_.features());
    const bool has_held = !surface_.boundary_loops().empty() || !features.lines.empty();
    if (!has_held && std::count(is_start_.begin(), is_start_.end(), 1) == 0) is_start_[0] = 1;
    held_.resize(to_size(surface_.half_edge_count()), {-1, -1});
    order_.resize(held_.size(), 0);
    for (const auto& loop : boundary_half_edges(surface_.faces(), surface_.opposites()))
      follow_border(loop);
    const auto first_feature = static_cast<Index>(traces_.size());
    for (const FeatureLine& line : features.lines) follow_feature(line);
    const auto last_feature = static_cast<Index>(traces_.size());
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      if (is_start(v)) leave(v, lattice_.leaving(v));
    for (Index t = first_feature; t < last_feature; ++t) {
      traces_[t].order = order_[traces_[t].first_edge];
      traces_[t].end_order = order_[surface_.opposite(traces_[t].last_edge)];
    }
    return {std::move(traces_), std::move(is_start_), std::move(held_)};
  }

 private:
  bool is_start(Index vertex) const { return is_start_[vertex] != 0; }

  // Returns whether two consecutive edges of features have another angle than two quarter turns.
  bool is_corner_of_feature(Index vertex) const {
    if (lattice_.is_on_border(vertex) || !lattice_.is_on_feature(vertex)) return false;
    const Index first = lattice_.leaving(vertex);
    int turns = 0;
    Index h = first;
    do {
      turns += static_cast<int>(leaving_directions(lattice_, h).size());
      h = surface_.opposite(previous(h));
      if (!lattice_.is_feature(h)) continue;
      if (turns != 2) return true;
      turns = 0;
    } while (h != first);
    return false;
  }

  // Adds lines along a loop of the border, from one start to the next.
  void follow_border(std::vector<Index> loop) {
    const auto starts = [&](Index h) { return is_start(surface_.from_vertex(h)); };
    auto first = std::find_if(loop.begin(), loop.end(), starts);
    if (first == loop.end()) {
      first = loop.begin();
      is_start_[surface_.from_vertex(*first)] = 1;
    }
    std::rotate(loop.begin(), first, loop.end());
    for (const Index h : loop) {
      if (starts(h)) start_held(h, Side::Border);
      go_along(h);
      traces_.back().end_order = lattice_.quarter_turns(surface_.to_vertex(h));
    }
  }

  // Adds lines along a feature. Their orders are those that leave() assigns later.
  void follow_feature(const FeatureLine& line) {
    std::vector<Index> half_edges = line.half_edges;
    const auto starts = [&](Index h) { return is_start(surface_.from_vertex(h)); };
    const auto first = std::find_if(half_edges.begin(), half_edges.end(), starts);
    if (first == half_edges.end())
      is_start_[surface_.from_vertex(half_edges.front())] = 1;
    else
      std::rotate(half_edges.begin(), first, half_edges.end());
    for (const Index h : half_edges) {
      if (starts(h)) start_held(h, Side::Feature);
      go_along(h);
    }
  }

  void start_held(Index h, Side side) {
    traces_.push_back({.cone = surface_.from_vertex(h),
                       .order = 0,
                       .legs = {},
                       .has_ended = true,
                       .side = side,
                       .first_edge = h});
  }

  // Extends the last line by one edge.
  void go_along(Index h) {
    Motorcycle& trace = traces_.back();
    const int direction = lattice_.direction_of(h);
    const LatticePoint along = unit_vector(direction);
    held_[h] = {static_cast<Index>(traces_.size()) - 1, static_cast<Index>(trace.legs.size())};
    if (const Index o = surface_.opposite(h); o >= 0) held_[o] = held_[h];
    trace.legs.push_back({face_of(h), direction, lattice_.corner(h) - trace.length * along});
    trace.length +=
        static_cast<std::int64_t>(dot(lattice_.corner(next(h)) - lattice_.corner(h), along));
    trace.end_vertex = surface_.to_vertex(h);
    trace.last_edge = h;
  }

  void leave(Index vertex, Index first) {
    int order = 0;
    Index h = first;
    do {
      for (const int direction : leaving_directions(lattice_, h)) {
        // The first direction of a border is the border itself; along a feature there is already a
        // line.
        if (lattice_.is_feature(h) && direction == lattice_.direction_of(h)) {
          order_[h] = order;
        } else if (order > 0 || !lattice_.is_on_border(vertex)) {
          require_off(direction, h, next(h));
          traces_.push_back({.cone = vertex,
                             .order = order,
                             .legs = {{face_of(h), direction, lattice_.corner(h)}}});
        }
        ++order;
      }
      h = surface_.opposite(previous(h));
    } while (h >= 0 && h != first);
  }

  // Throws if the vertex at `other` is on the line that leaves the corner of `half_edge`.
  void require_off(int direction, Index half_edge, Index other) const {
    const LatticePoint along = lattice_.corner(other) - lattice_.corner(half_edge);
    if (cross(unit_vector(direction), along) == 0)
      refuse_vertex(lattice_, is_start_, surface_.from_vertex(other));
  }

  const SeamlessLattice& lattice_;
  const SurfaceMesh& surface_;
  std::vector<char> is_start_;  // by vertex
  std::vector<Passage> held_;   // by half-edge of the border and of features, both sides
  std::vector<int> order_;  // by half-edge of features: the order of the line that starts along it
  std::vector<Motorcycle> traces_;
};

}  // namespace

void refuse_lines(const std::string& problem) {
  throw Error(ErrorKind::Infeasible, "the lines of the map along its axes: " + problem);
}

MotorcycleStarts motorcycle_starts(const SeamlessLattice& lattice) {
  return StartFinder(lattice).start();
}

void refuse_vertex(const SeamlessLattice& lattice, const std::vector<char>& is_start,
                   Index vertex) {
  const SurfaceMesh& surface = lattice.surface();
  if (is_start[vertex])
    throw Error(ErrorKind::Infeasible,
                fmt::format("{}vertex {}: its faces leave no room for the lines of quads between "
                            "two irregular vertices or corners, which are one edge apart; divide "
                            "the faces there into smaller ones",
                            message_prefix(surface), user_vertex(surface, vertex)));
  throw VertexInTheWay{vertex};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
