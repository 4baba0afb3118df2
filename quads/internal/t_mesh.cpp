#include "majorant/quads/internal/t_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <queue>
#include <random>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/quads/features.h"
#include "majorant/quads/internal/border.h"
#include "majorant/quads/internal/random_steps.h"

namespace majorant {
namespace {

[[noreturn]] void refuse_lines(const std::string& what) {
  throw Error(ErrorKind::Infeasible, "the lines of the map along its axes: " + what);
}

// A vertex is where a line cannot tell what is left and right of it.
struct InTheWay {
  Index vertex;
};

// A line while it grows.
struct Trace {
  Index cone;                 // the vertex that it starts from
  int order;                  // among the lines that leave it, counterclockwise
  std::vector<LineLeg> legs;  // the last one is under way
  bool has_ended = false;
  std::int64_t length = 0;  // once it has ended
  Index on = -1;            // the line that it ended on, at `on_distance` of it
  std::int64_t on_distance = 0;
  int on_quarter = 0;  // its way back, in quarter turns from the direction of that line
  Index met = -1;      // the line that came towards it: both are one, from cone to cone
  Side side = Side::Inside;
  // On the border and on features: the vertex where it ends, as the line of this order there.
  Index end_vertex = -1;
  int end_order = 0;
  Index first_edge = -1, last_edge = -1;  // half-edges
};

// A leg of a trace, where its face lists it.
struct Passage {
  Index trace, leg;
};

// Distance along the direction of a leg.
std::int64_t distance_along(const LineLeg& leg, LatticePoint p) {
  return static_cast<std::int64_t>(dot(p - leg.start, unit_vector(leg.direction)));
}
// The coordinate that is constant along a leg.
std::int64_t constant_of(const LineLeg& leg) {
  return leg.direction % 2 == 0 ? leg.start.v : leg.start.u;
}

class Tracer {
 public:
  Tracer(const SeamlessLattice& lattice, const StopCheck& stop)
      : lattice_(lattice),
        surface_(lattice.surface()),
        stop_(stop),
        is_start_(held_corners(surface_, lattice.features(), lattice.border_turn())),
        passages_(to_size(surface_.face_count())) {
    for (Index v = 0; v < surface_.vertex_count(); ++v)
      is_start_[v] |= lattice.is_cone(v) || is_corner_of_feature(v);
  }

  // Throws InTheWay.
  std::vector<Trace> trace() {
    start();
    // All leave their cones, then the line that has come least far goes on.
    using Turn = std::pair<double, Index>;
    std::priority_queue<Turn, std::vector<Turn>, std::greater<>> turns;
    for (Index t = 0; t < static_cast<Index>(traces_.size()); ++t) {
      advance(t);
      turns.emplace(reached(t), t);
    }
    // No line of a useful map crosses every face as often.
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
  bool is_start(Index vertex) const { return is_start_[vertex] != 0; }

  // Whether other than two quarter turns are between its edges somewhere.
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

  void start() {
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
  }

  // Lines along a loop of the border, from one start to the next.
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

  // Its orders are those of leave(), which comes later.
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

  // The last line, along one more edge.
  void go_along(Index h) {
    Trace& trace = traces_.back();
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
        // The first one of a border is that of the border; along a feature there is one already.
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

  // The vertex at `other` is not on the line that leaves the corner of `half_edge`.
  void require_off(int direction, Index half_edge, Index other) const {
    const LatticePoint along = lattice_.corner(other) - lattice_.corner(half_edge);
    if (cross(unit_vector(direction), along) == 0) clear(surface_.from_vertex(other));
  }

  [[noreturn]] void clear(Index vertex) const {
    if (is_start(vertex))
      throw Error(ErrorKind::Infeasible,
                  fmt::format("{}vertex {}: its faces leave no room for the lines of quads between "
                              "two irregular vertices or corners, which are one edge apart; divide "
                              "the faces there into smaller ones",
                              message_prefix(surface_), user_vertex(surface_, vertex)));
    throw InTheWay{vertex};
  }

  // How far a line has come, about: to the middle of its last face.
  double reached(Index t) const {
    const LineLeg& leg = traces_[t].legs.back();
    double sum = 0;
    for (Index k = 0; k < 3; ++k)
      sum += static_cast<double>(distance_along(leg, lattice_.corner(3 * leg.face + k)));
    return sum / 3;
  }

  struct Hit {
    std::int64_t distance;  // of the line that goes on
    int direction;          // of it, in the chart of the leg that it hits
    Passage on;
    std::int64_t on_distance;
  };

  // Through the face of its last leg, which others see from then on, as far as it goes there.
  void advance(Index t) {
    Trace& trace = traces_[t];
    if (trace.has_ended) return;
    const LineLeg leg = trace.legs.back();
    std::optional<Hit> nearest;
    for (const Passage& passage : passages_[leg.face]) {
      const Trace& other = traces_[passage.trace];
      const LineLeg& across = other.legs[passage.leg];
      const bool is_end =
          other.has_ended && passage.leg == static_cast<Index>(other.legs.size()) - 1;
      if ((across.direction - leg.direction) % 2 == 0) {
        if (constant_of(across) != constant_of(leg)) continue;
        if (across.direction == leg.direction) refuse_lines("two of them run along each other");
        if (is_end) continue;  // what it has ended on is in the way of both
        meet(t, passage.trace, distance_along(leg, across.start));
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

  // Throws InTheWay for a point on the face's border.
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
      clear(is_start(surface_.from_vertex(h)) ? surface_.to_vertex(h) : surface_.from_vertex(h));
    return least > 0;
  }

  void end(Index t, const Hit& hit) {
    Trace& trace = traces_[t];
    trace.has_ended = true;
    trace.length = hit.distance;
    trace.on = hit.on.trace;
    trace.on_distance = hit.on_distance;
    trace.on_quarter =
        quarter(hit.direction + 2 - traces_[hit.on.trace].legs[hit.on.leg].direction);
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
    // The edge that leads out has its start on the right of the line and its end on the left.
    const auto side_of = [&](Index h) {
      const LatticePoint c = lattice_.corner(h);
      return sign(cross(unit_vector(leg.direction), c - leg.start));
    };
    for (Index h = 3 * leg.face; h < 3 * leg.face + 3; ++h) {
      const int right = side_of(h), left = side_of(next(h));
      if (right == 0 && lattice_.corner(h) != leg.start) clear(surface_.from_vertex(h));
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

  // Of features one side has the line's legs.
  void end_on_held(Index t, LineLeg leg, Index half_edge) {
    const Passage on = held_[half_edge];
    const LineLeg& across = traces_[on.trace].legs[on.leg];
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
  std::vector<char> is_start_;  // by vertex
  std::vector<Passage> held_;   // by half-edge of the border and of features, both sides
  std::vector<int> order_;      // by half-edge of features: as the line that starts along it
  std::vector<Trace> traces_;
  std::vector<std::vector<Passage>> passages_;  // by face
};

// From traces to lines, arcs and patches.
class TMeshBuilder {
 public:
  TMeshBuilder(const SeamlessLattice& lattice, std::vector<Trace> traces)
      : lattice_(lattice), traces_(std::move(traces)) {}

  TMesh build() {
    join_traces();
    cut_lines();
    find_patches();
    prove();
    return std::move(mesh_);
  }

 private:
  // A place on a trace as one on its line.
  struct LinePlace {
    Index line;
    std::int64_t distance;
    int turned;  // of the trace against the line: 0 or 2 quarters
  };
  LinePlace place(Index trace, std::int64_t distance) const {
    const auto [line, is_second] = line_of_[trace];
    if (!is_second) return {line, distance, 0};
    return {line, mesh_.lines[line].length - distance, 2};
  }

  void join_traces() {
    line_of_.resize(traces_.size());
    for (Index t = 0; t < static_cast<Index>(traces_.size()); ++t) {
      const Trace& trace = traces_[t];
      if (trace.met >= 0 && trace.met < t) continue;
      const auto line = static_cast<Index>(mesh_.lines.size());
      line_of_[t] = {line, false};
      first_trace_.push_back(t);
      TraceLine joined{.legs = trace.legs, .length = trace.length, .side = trace.side};
      if (trace.met >= 0) {
        line_of_[trace.met] = {line, true};
        const std::vector<LineLeg>& back = traces_[trace.met].legs;
        for (auto leg = back.rbegin(); leg != back.rend(); ++leg)
          joined.legs.push_back({leg->face, quarter(leg->direction + 2), leg->at(trace.length)});
      }
      mesh_.lines.push_back(std::move(joined));
    }
  }

  // Half-arcs that leave a node, by quarter turns from its first direction.
  using Leaving = std::map<int, Index>;

  void cut_lines() {
    std::map<Index, Index> cones;  // node by vertex
    std::vector<std::map<std::int64_t, Index>> stops(mesh_.lines.size());
    const auto new_node = [&](TNode node) {
      mesh_.nodes.push_back(node);
      leaving_.emplace_back();
      return static_cast<Index>(mesh_.nodes.size()) - 1;
    };
    const auto cone_node = [&](Index vertex) {
      const auto [found, is_new] = cones.try_emplace(vertex, -1);
      if (is_new)
        found->second = new_node({vertex, lattice_.quarter_turns(vertex), side_of(vertex)});
      return found->second;
    };
    for (const Trace& trace : traces_) {
      cone_node(trace.cone);
      if (trace.on < 0) continue;
      const LinePlace at = place(trace.on, trace.on_distance);
      const auto [found, is_new] = stops[at.line].try_emplace(at.distance, -1);
      const Side side = traces_[trace.on].side;
      if (is_new) found->second = new_node({-1, side == Side::Border ? 2 : 4, side});
    }
    const std::vector<std::map<std::int64_t, Index>> inner = stops;
    for (std::size_t l = 0; l < mesh_.lines.size(); ++l) {
      const Trace& first = traces_[first_trace_[l]];
      stops[l][0] = cone_node(first.cone);
      Index end = -1;
      if (first.met >= 0) {
        end = cone_node(traces_[first.met].cone);
      } else if (first.side != Side::Inside) {
        end = cone_node(first.end_vertex);
      } else {
        const LinePlace at = place(first.on, first.on_distance);
        end = inner[at.line].at(at.distance);
      }
      stops[l][first.length] = end;
      add_arcs(static_cast<Index>(l), stops[l]);
    }
  }

  Side side_of(Index vertex) const {
    if (lattice_.is_on_border(vertex)) return Side::Border;
    return lattice_.is_on_feature(vertex) ? Side::Feature : Side::Inside;
  }

  void add_arcs(Index line, const std::map<std::int64_t, Index>& stops) {
    const Trace& first = traces_[first_trace_[line]];
    for (auto stop = stops.begin(); std::next(stop) != stops.end(); ++stop) {
      const auto end = std::next(stop);
      const auto arc = static_cast<Index>(mesh_.arcs.size());
      mesh_.arcs.push_back({line, stop->first, end->first, {stop->second, end->second}});
      mesh_.lines[line].arcs.push_back(arc);
      attach(stop->second, stop->first == 0 ? first.order : 0, 2 * arc);
      int back = 2;
      if (end->first == first.length) {
        if (first.met >= 0)
          back = traces_[first.met].order;
        else if (first.side != Side::Inside)
          back = first.end_order;
        else
          back = quarter(first.on_quarter + place(first.on, first.on_distance).turned);
      }
      attach(end->second, back, 2 * arc + 1);
    }
  }

  void attach(Index node, int quarter_turn, Index half_arc) {
    if (!leaving_[node].emplace(quarter_turn, half_arc).second)
      refuse_lines("two of them leave a point in one direction");
    quarter_.resize(std::max(quarter_.size(), to_size(half_arc | 1) + 1));
    quarter_[half_arc] = quarter_turn;
  }

  // With the same patch on the left: the next one clockwise from the way back. `turns`: the angle
  // that the patch has there.
  Index following(Index half_arc, int& turns) const {
    const Index node = mesh_.to_node(half_arc), back = reversed(half_arc);
    const Leaving& around = leaving_[node];
    auto found = around.find(quarter_[back]);
    found = found == around.begin() ? std::prev(around.end()) : std::prev(found);
    // On the border nothing follows the first line, which no half-arc with a patch leads back to.
    const int all = mesh_.nodes[node].turns;
    turns = ((quarter_[back] - found->first - 1) % all + all) % all + 1;
    return found->second;
  }

  void find_patches() {
    std::vector<char> seen(2 * mesh_.arcs.size(), 0);
    for (Index a = 0; a < static_cast<Index>(mesh_.arcs.size()); ++a)
      seen[2 * a + 1] = mesh_.is_on_border(a);
    for (Index first = 0; first < static_cast<Index>(seen.size()); ++first) {
      if (seen[first]) continue;
      std::vector<Index> cycle;
      std::vector<std::size_t> corners;  // of the cycle, where a side begins
      for (Index h = first; !seen[h];) {
        seen[h] = 1;
        cycle.push_back(h);
        int turns = 0;
        h = following(h, turns);
        if (turns > 2) refuse_lines("a patch is not convex");
        if (turns == 1) corners.push_back(cycle.size());
      }
      add_patch(cycle, std::move(corners));
    }
  }

  void add_patch(const std::vector<Index>& cycle, std::vector<std::size_t> corners) {
    if (corners.size() != 4) refuse_lines(fmt::format("a patch has {} corners", corners.size()));
    TPatch patch;
    std::array<std::int64_t, 4> length{};
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t i = corners[k] % cycle.size(); i != corners[(k + 1) % 4] % cycle.size();
           i = (i + 1) % cycle.size()) {
        patch.sides[k].push_back(cycle[i]);
        length[k] += mesh_.arcs[arc_of(cycle[i])].length();
      }
    if (length[0] != length[2] || length[1] != length[3]) refuse_lines("a patch is no rectangle");
    patch.width = length[0];
    patch.height = length[1];
    mesh_.patches.push_back(std::move(patch));
  }

  void prove() const {
    const auto euler = static_cast<Index>(mesh_.nodes.size()) -
                       static_cast<Index>(mesh_.arcs.size()) +
                       static_cast<Index>(mesh_.patches.size());
    const Index wanted = lattice_.surface().topology().euler_characteristic();
    if (euler != wanted)
      refuse_lines(
          fmt::format("their Euler characteristic is {}, that of the surface {}", euler, wanted));
    WideInteger area = 0;
    for (const TPatch& patch : mesh_.patches) area += 2 * WideInteger{patch.width} * patch.height;
    if (area != lattice_.twice_area()) refuse_lines("the areas of patches do not add up");
  }

  const SeamlessLattice& lattice_;
  std::vector<Trace> traces_;
  std::vector<std::pair<Index, bool>> line_of_;  // by trace; true: the second one of two that met
  std::vector<Index> first_trace_;               // by line
  std::vector<Leaving> leaving_;                 // by node
  std::vector<int> quarter_;                     // by half-arc, at its start
  TMesh mesh_;
};

}  // namespace

TMesh trace_t_mesh(SeamlessLattice& lattice, const StopCheck& stop) {
  // A step of the lattice is some 1e-12 of the layout; a vertex that is moved twice is moved
  // farther.
  constexpr int kAttempts = 10000, kSteps = 64;
  std::mt19937 random(1);
  for (int attempt = 0; attempt < kAttempts; ++attempt) try {
      return TMeshBuilder(lattice, Tracer(lattice, stop).trace()).build();
    } catch (const InTheWay& in_the_way) {
      const std::int64_t u = random_between(random, 1, kSteps);
      lattice.move(in_the_way.vertex, {u, random_between(random, 1, kSteps)});
    }
  refuse_lines("they pass through vertices however these are moved");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
