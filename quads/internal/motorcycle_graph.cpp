#include "majorant/quads/internal/motorcycle_graph.h"

#include <functional>
#include <optional>
#include <queue>
#include <utility>

namespace majorant {
namespace {

// Returns the distance along the direction of a leg.
std::int64_t distance_along(const LineLeg& leg, LatticePoint p) {
  return static_cast<std::int64_t>(dot(p - leg.start, unit_vector(leg.direction)));
}
// Returns the coordinate that is constant along a leg.
std::int64_t constant_of(const LineLeg& leg) {
  return leg.direction % 2 == 0 ? leg.start.v : leg.start.u;
}

class MotorcycleRace {
 public:
  MotorcycleRace(const SeamlessLattice& lattice, const StopCheck& stop, MotorcycleStarts starts)
      : lattice_(lattice),
        surface_(lattice.surface()),
        stop_(stop),
        is_start_(std::move(starts.is_start)),
        held_(std::move(starts.held)),
        traces_(std::move(starts.motorcycles)),
        passages_(to_size(surface_.face_count())) {}

  // Traces all lines. Throws VertexInTheWay.
  std::vector<Motorcycle> trace() {
    // All lines leave their cones; then the shortest line always continues.
    using Turn = std::pair<double, Index>;
    std::priority_queue<Turn, std::vector<Turn>, std::greater<>> turns;
    for (Index t = 0; t < static_cast<Index>(traces_.size()); ++t) {
      advance(t);
      turns.emplace(reached(t), t);
    }
    // Upper bound on the crossings of a line per face of the surface.
    constexpr std::size_t kLongest = 100;
    const std::size_t limit = kLongest * to_size(surface_.face_count());
    std::size_t steps = 0;
    while (!turns.empty()) {
      const Index t = turns.top().second;
      turns.pop();
      if (traces_[t].has_ended) continue;
      stop_.poll_at(steps);
      if (++steps > limit) refuse_lines("one of them does not end");
      advance(t);
      if (!traces_[t].has_ended) turns.emplace(reached(t), t);
    }
    return std::move(traces_);
  }

 private:
  // Returns the approximate length of a line, up to the middle of its last face.
  double reached(Index t) const {
    const LineLeg& leg = traces_[t].legs.back();
    double sum = 0;
    for (Index k = 0; k < 3; ++k)
      sum += static_cast<double>(distance_along(leg, lattice_.corner(3 * leg.face + k)));
    return sum / 3;
  }

  struct Hit {
    std::int64_t distance;  // on the line that continues
    int direction;          // of that line, in the chart of the leg that it hits
    Passage on;
    std::int64_t on_distance;
  };

  // Drives a line through the face of its last leg, and lists it there.
  void advance(Index t) {
    Motorcycle& trace = traces_[t];
    if (trace.has_ended) return;
    const LineLeg leg = trace.legs.back();
    std::optional<Hit> nearest;
    for (const Passage& passage : passages_[leg.face]) {
      const Motorcycle& other = traces_[passage.motorcycle];
      const LineLeg& across = other.legs[passage.leg];
      const bool is_end =
          other.has_ended && passage.leg == static_cast<Index>(other.legs.size()) - 1;
      if ((across.direction - leg.direction) % 2 == 0) {
        if (constant_of(across) != constant_of(leg)) continue;
        if (across.direction == leg.direction) refuse_lines("two of them run along each other");
        if (is_end) continue;  // a line that has ended there blocks both
        meet(t, passage.motorcycle, distance_along(leg, across.start));
        return;
      }
      const LatticePoint p = leg.direction % 2 == 0 ? LatticePoint{across.start.u, leg.start.v}
                                                    : LatticePoint{leg.start.u, across.start.v};
      const Hit hit{distance_along(leg, p), leg.direction, passage, distance_along(across, p)};
      if (hit.distance <= 0 || hit.on_distance <= 0) continue;
      if (is_end && hit.on_distance >= other.length) continue;
      if (is_inside(leg.face, p) && (!nearest || hit.distance < nearest->distance)) nearest = hit;
    }
    passages_[leg.face].push_back({t, static_cast<Index>(trace.legs.size()) - 1});
    if (nearest)
      end(t, *nearest);
    else
      cross_face(t, leg);
  }

  // Throws VertexInTheWay for a point on the border of the face.
  bool is_inside(Index face, LatticePoint p) const {
    int least = 1;
    Index h = -1;
    for (Index k = 3 * face; k < 3 * face + 3; ++k) {
      const int s = side(lattice_.corner(k), lattice_.corner(next(k)), p);
      if (s < least) {
        least = s;
        h = k;
      }
    }
    if (least == 0)
      refuse_vertex(lattice_, is_start_,
                    is_start_[surface_.from_vertex(h)] != 0 ? surface_.to_vertex(h)
                                                            : surface_.from_vertex(h));
    return least > 0;
  }

  void end(Index t, const Hit& hit) {
    Motorcycle& trace = traces_[t];
    trace.has_ended = true;
    trace.length = hit.distance;
    trace.on = hit.on.motorcycle;
    trace.on_distance = hit.on_distance;
    trace.on_quarter =
        quarter(hit.direction + 2 - traces_[hit.on.motorcycle].legs[hit.on.leg].direction);
  }

  void meet(Index t, Index other, std::int64_t length) {
    if (traces_[other].has_ended) refuse_lines("one meets another that has ended");
    for (const auto& [a, b] : {std::pair(t, other), std::pair(other, t)}) {
      traces_[a].has_ended = true;
      traces_[a].length = length;
      traces_[a].met = b;
    }
  }

  void cross_face(Index t, const LineLeg& leg) {
    // The edge that leads out starts on the right of the line and ends on the left.
    const auto side_of = [&](Index h) {
      const LatticePoint c = lattice_.corner(h);
      return sign(cross(unit_vector(leg.direction), c - leg.start));
    };
    for (Index h = 3 * leg.face; h < 3 * leg.face + 3; ++h) {
      const int right = side_of(h), left = side_of(next(h));
      if (right == 0 && lattice_.corner(h) != leg.start)
        refuse_vertex(lattice_, is_start_, surface_.from_vertex(h));
      if (right >= 0 || left <= 0) continue;
      if (surface_.opposite(h) < 0 || lattice_.is_feature(h)) {
        end_on_held(t, leg, h);
        return;
      }
      const LineLeg entered{face_of(surface_.opposite(h)),
                            lattice_.direction_beyond(h, leg.direction),
                            lattice_.beyond(h, leg.start)};
      traces_[t].legs.push_back(entered);
      return;
    }
    refuse_lines("one leaves its face through no edge");
  }

  // Ends a line on a held edge. One side of a feature has the legs of its line.
  void end_on_held(Index t, LineLeg leg, Index half_edge) {
    const Passage on = held_[half_edge];
    const LineLeg& across = traces_[on.motorcycle].legs[on.leg];
    if (across.face != leg.face)
      leg = {across.face, lattice_.direction_beyond(half_edge, leg.direction),
             lattice_.beyond(half_edge, leg.start)};
    if ((across.direction - leg.direction) % 2 == 0)
      refuse_lines("one runs into a border or a feature along it");
    const LatticePoint p = leg.direction % 2 == 0 ? LatticePoint{across.start.u, leg.start.v}
                                                  : LatticePoint{leg.start.u, across.start.v};
    end(t, {distance_along(leg, p), leg.direction, on, distance_along(across, p)});
  }

  const SeamlessLattice& lattice_;
  const SurfaceMesh& surface_;
  const StopCheck& stop_;
  const std::vector<char> is_start_;  // by vertex
  const std::vector<Passage> held_;   // by half-edge of the border and of features, both sides
  std::vector<Motorcycle> traces_;
  std::vector<std::vector<Passage>> passages_;  // by face
};

}  // namespace

std::vector<Motorcycle> motorcycle_graph(const SeamlessLattice& lattice, const StopCheck& stop) {
  return MotorcycleRace(lattice, stop, motorcycle_starts(lattice)).trace();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
