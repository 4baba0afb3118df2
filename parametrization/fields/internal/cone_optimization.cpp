#include "majorant/parametrization/fields/internal/cone_optimization.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/fields/internal/cone_potential.h"

namespace majorant {
namespace {

// A seamless map needs every angle below 180 degrees; 120 on average leaves room to untangle.
// Chosen, not tuned.
constexpr int kLargestMeanAngle = 120;
const std::vector<char> kNoneFixed;
// Cones move one edge a sweep; the smoothest field has them nearly in place; chosen, not
// tuned.
constexpr int kMostConeSweeps = 20;
// A sweep takes a solve for each; chosen, not tuned.
constexpr Index kMostCones = 1000;
// Of energy; rounding shall not move cones: far above the rounding of the solves, far below
// the gain of a move that matters.
constexpr double kLeastConeGain = 1e-6;

class Cleanup {
 public:
  Cleanup(const SurfaceMesh& mesh, const FieldGeometry& geometry, const std::vector<char>& is_fixed,
          FieldConnection& field)
      : mesh_(mesh),
        geometry_(geometry),
        is_fixed_(is_fixed),
        field_(field),
        leaving_(to_size(mesh.vertex_count())) {
    for (Index h = 0; h < mesh.half_edge_count(); ++h)
      if (movable(h)) leaving_[mesh.from_vertex(h)].push_back(h);
  }

  void lower_energy(double cone_cost, const StopCheck& stop) {
    Index cones = 0;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) cones += !boundary(v) && turns(v) != 4;
    if (cones > kMostCones) return;
    ConePotential potential(mesh_, geometry_, field_.quarter_turns);
    cancel_pairs(potential, cone_cost, stop);
    for (int sweep = 0; sweep < kMostConeSweeps && improve_places(potential, cone_cost, stop);
         ++sweep)
      cancel_pairs(potential, cone_cost, stop);
  }

  void run() {
    // A pass can make room for the next one; each of them leaves fewer cones.
    while (cancel_neighbours()) {
    }
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      while (excess(v) != 0) level(v);
  }

 private:
  int turns(Index v) const { return field_.quarter_turns[v]; }
  bool boundary(Index v) const { return geometry_.is_boundary[v]; }
  bool movable(Index h) const {
    const Index o = mesh_.opposite(h);
    if (o < 0) return false;
    return is_fixed_.empty() || !is_fixed_[face_of(h)] || !is_fixed_[face_of(o)];
  }
  int most_turns(Index v) const {
    return std::max(4, geometry_.valence[v] * kLargestMeanAngle / 90);
  }
  // Quarter turns that v has to give away (> 0) or to receive (< 0).
  int excess(Index v) const {
    if (boundary(v)) return 0;
    return turns(v) < 1 ? turns(v) - 1 : std::max(0, turns(v) - most_turns(v));
  }
  // What a quarter turn less at `from` and one more at `to` does to the number of cones.
  int change(Index from, Index to) const {
    const auto cost = [&](Index v, int step) {
      return boundary(v) ? 0 : std::abs(turns(v) + step - 4) - std::abs(turns(v) - 4);
    };
    return cost(from, -1) + cost(to, 1);
  }
  void move(Index h) { move_quarter(mesh_, geometry_, h, field_); }

  bool cancel_neighbours() {
    bool any = false;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      const Index a = mesh_.from_vertex(h), b = mesh_.to_vertex(h);
      if (!movable(h) || change(a, b) >= 0) continue;
      move(h);
      any = true;
    }
    return any;
  }

  // Pairs (or single cones, at the boundary) that are worth less than they cost, best first.
  void cancel_pairs(ConePotential& potential, double cone_cost, const StopCheck& stop) {
    for (;;) {
      stop.poll();
      std::vector<Index> givers, takers;
      for (Index v = 0; v < mesh_.vertex_count(); ++v)
        if (!boundary(v) && turns(v) != 4) (turns(v) > 4 ? givers : takers).push_back(v);
      if (!mesh_.boundary_loops().empty()) {
        givers.push_back(mesh_.boundary_loops()[0][0]);
        takers.push_back(givers.back());
      }
      double best = 0;
      Index from = -1, to = -1;
      for (const Index a : givers)
        for (const Index b : takers) {
          if (a == b) continue;
          const double gain = potential.change(a, b) + cone_cost * change(a, b);
          if (gain >= best) continue;
          best = gain, from = a, to = b;
        }
      if (from < 0) return;
      potential.move(from, to);
      if (boundary(from))
        send(to, -1, [&](Index w) { return boundary(w); });
      else
        send(from, 1, [&](Index w) { return w == to || (boundary(to) && boundary(w)); });
    }
  }

  // Moves every cone to a neighbour, or splits it, where that lowers the energy. True if any moved.
  bool improve_places(ConePotential& potential, double cone_cost, const StopCheck& stop) {
    bool any = false;
    for (Index v = 0; v < mesh_.vertex_count(); ++v) {
      if (boundary(v) || turns(v) == 4) continue;
      stop.poll();
      const int step = turns(v) > 4 ? 1 : -1;  // what the neighbour gets
      Index best = -1;
      double least = 0;
      for (const Index h : leaving_[v]) {
        const Index w = mesh_.to_vertex(h);
        if (boundary(w) || turns(w) + step < 1 || turns(w) + step > most_turns(w)) continue;
        const double estimate = potential.estimated_change(v, w, step);
        if (best < 0 || estimate < least) best = h, least = estimate;
      }
      if (best < 0) continue;
      const Index w = mesh_.to_vertex(best), from = step > 0 ? v : w, to = step > 0 ? w : v;
      const double gain = potential.change(from, to) + cone_cost * change(from, to);
      if (gain < -kLeastConeGain) {
        potential.move(from, to);
        move(step > 0 ? best : mesh_.opposite(best));
        any = true;
      }
      for (const Index u : {v, w})
        if (turns(u) == 4) potential.forget(u);
    }
    return any;
  }

  // Gives one quarter turn of a vertex with an excess to the nearest vertex that can take it (or
  // fetches one).
  void level(Index v) {
    const int step = excess(v) > 0 ? 1 : -1;  // what the receiver gets
    const bool found = send(v, step, [&](Index w) {
      return boundary(w) || (turns(w) + step >= 1 && turns(w) + step <= most_turns(w) &&
                             turns(w) * step <= 4 * step);
    });
    if (!found)
      throw Error(ErrorKind::Infeasible,
                  fmt::format("{}vertex {}: the mesh is too coarse for the cones of a cross "
                              "field; refine it or align fewer edges",
                              message_prefix(mesh_), user_vertex(mesh_, v)));
  }

  // Moves a quarter turn from v to the nearest vertex that is a goal (step = 1), or from there to v
  // (-1), over as few edges as possible. False when there is none, never if no face is fixed.
  template <class Goal>
  bool send(Index v, int step, const Goal& is_goal) {
    std::vector<Index> entered(to_size(mesh_.vertex_count()), -1), queue{v};
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (const Index h : leaving_[queue[next]]) {
        const Index w = mesh_.to_vertex(h);
        if (w == v || entered[w] >= 0) continue;
        entered[w] = h;
        if (is_goal(w)) {
          for (Index u = w; u != v; u = mesh_.from_vertex(entered[u]))
            move(step > 0 ? entered[u] : mesh_.opposite(entered[u]));
          return true;
        }
        queue.push_back(w);
      }
    return false;
  }

  const SurfaceMesh& mesh_;
  const FieldGeometry& geometry_;
  const std::vector<char>& is_fixed_;
  FieldConnection& field_;
  std::vector<std::vector<Index>> leaving_;  // per vertex, half-edges that may be matched anew
};

}  // namespace

void optimize_cones(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                    const std::vector<char>& is_fixed, FieldConnection& field) {
  Cleanup(mesh, geometry, is_fixed, field).run();
}

void lower_cone_energy(const SurfaceMesh& mesh, const FieldGeometry& geometry, double cone_cost,
                       FieldConnection& field, const StopCheck& stop) {
  Cleanup(mesh, geometry, kNoneFixed, field).lower_energy(cone_cost, stop);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
