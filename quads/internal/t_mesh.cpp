#include "majorant/quads/internal/t_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <random>
#include <utility>

#include "majorant/quads/internal/motorcycle_graph.h"
#include "majorant/quads/internal/random_steps.h"

namespace majorant {
namespace {

// Makes lines, arcs and patches from traces.
class TMeshBuilder {
 public:
  TMeshBuilder(const SeamlessLattice& lattice, std::vector<Motorcycle> traces)
      : lattice_(lattice), traces_(std::move(traces)) {}

  TMesh build() {
    join_traces();
    cut_lines();
    find_patches();
    prove();
    return std::move(mesh_);
  }

 private:
  // A place on a trace as a place on its line.
  struct LinePlace {
    Index line;
    std::int64_t distance;
    int turned;  // trace against line: 0 or 2 quarter turns
  };
  LinePlace place(Index trace, std::int64_t distance) const {
    const auto [line, is_second] = line_of_[trace];
    if (!is_second) return {line, distance, 0};
    return {line, mesh_.lines[line].length - distance, 2};
  }

  void join_traces() {
    line_of_.resize(traces_.size());
    for (Index t = 0; t < static_cast<Index>(traces_.size()); ++t) {
      const Motorcycle& trace = traces_[t];
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
    std::map<Index, Index> cones;  // node of each vertex
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
    for (const Motorcycle& trace : traces_) {
      cone_node(trace.cone);
      if (trace.on < 0) continue;
      const LinePlace at = place(trace.on, trace.on_distance);
      const auto [found, is_new] = stops[at.line].try_emplace(at.distance, -1);
      const Side side = traces_[trace.on].side;
      if (is_new) found->second = new_node({-1, side == Side::Border ? 2 : 4, side});
    }
    const std::vector<std::map<std::int64_t, Index>> inner = stops;
    for (std::size_t l = 0; l < mesh_.lines.size(); ++l) {
      const Motorcycle& first = traces_[first_trace_[l]];
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
    const Motorcycle& first = traces_[first_trace_[line]];
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

  // Returns the half-arc that follows with the same patch on its left: the next one clockwise from
  // the way back. `turns`: the patch's angle there.
  Index following(Index half_arc, int& turns) const {
    const Index node = mesh_.to_node(half_arc), back = reversed(half_arc);
    const Leaving& around = leaving_[node];
    auto found = around.find(quarter_[back]);
    found = found == around.begin() ? std::prev(around.end()) : std::prev(found);
    // On the border nothing follows the first line, since no half-arc with a patch leads back to
    // it.
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
      std::vector<std::size_t> corners;  // positions in the cycle where sides begin
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
    const Index expected = lattice_.surface().topology().euler_characteristic();
    if (euler != expected)
      refuse_lines(
          fmt::format("their Euler characteristic is {}, that of the surface {}", euler, expected));
    WideInteger area = 0;
    for (const TPatch& patch : mesh_.patches) area += 2 * WideInteger{patch.width} * patch.height;
    if (area != lattice_.twice_area()) refuse_lines("the areas of patches do not add up");
  }

  const SeamlessLattice& lattice_;
  std::vector<Motorcycle> traces_;
  std::vector<std::pair<Index, bool>> line_of_;  // by trace; true: the second of two that met
  std::vector<Index> first_trace_;               // by line
  std::vector<Leaving> leaving_;                 // by node
  std::vector<int> quarter_;                     // by half-arc, at its start
  TMesh mesh_;
};

}  // namespace

TMesh trace_t_mesh(SeamlessLattice& lattice, const StopCheck& stop) {
  // A lattice step is about 1e-12 of the layout. Repeated moves of a vertex are longer.
  constexpr int kAttempts = 10000, kSteps = 64;
  std::mt19937 random(1);
  for (int attempt = 0; attempt < kAttempts; ++attempt) try {
      return TMeshBuilder(lattice, motorcycle_graph(lattice, stop)).build();
    } catch (const VertexInTheWay& in_the_way) {
      const std::int64_t u = random_between(random, 1, kSteps);
      lattice.move(in_the_way.vertex, {u, random_between(random, 1, kSteps)});
    }
  refuse_lines("they pass through vertices however these are moved");
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
