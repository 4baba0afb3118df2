#include "majorant/parametrization/fields/internal/cone_descent.h"

#include <utility>
#include <vector>

#include "majorant/parametrization/fields/internal/cone_potential.h"
#include "majorant/parametrization/fields/internal/quarter_turn_graph.h"

namespace majorant {
namespace {

// Upper bound on sweeps, in each of which a cone moves by one edge. The smoothest field has cones
// nearly in place. Chosen, not tuned.
constexpr int kMaxConeSweeps = 20;
// Fields with more cones are left unchanged, since a sweep takes a solve for each. Chosen, not
// tuned.
constexpr Index kMaxCones = 1000;
// The least decrease of energy for which a cone moves, far above the rounding of the solves and far
// below a significant decrease.
constexpr double kLeastConeGain = 1e-6;

bool is_cone(const QuarterTurnGraph& graph, Index v) {
  return !graph.is_unbounded(v) && graph.turns(v) != 4;
}

// The move of one quarter turn between cones of opposite sign, or between a cone and the boundary,
// that lowers the energy most. `from` is -1 if no move does.
struct Cancellation {
  Index from = -1, to = -1;
};

Cancellation best_cancellation(const SurfaceMesh& mesh, double cone_cost,
                               const QuarterTurnGraph& graph, ConePotential& potential) {
  std::vector<Index> givers, takers;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (is_cone(graph, v)) (graph.turns(v) > 4 ? givers : takers).push_back(v);
  if (!mesh.boundary_loops().empty()) {
    givers.push_back(mesh.boundary_loops()[0][0]);
    takers.push_back(givers.back());
  }
  std::vector<Index> all = givers;
  all.insert(all.end(), takers.begin(), takers.end());
  potential.watch(std::move(all));
  double best = 0;
  Cancellation move;
  for (const Index a : givers)
    for (const Index b : takers) {
      if (a == b) continue;
      const double gain = potential.change(a, b) + cone_cost * graph.change(a, b);
      if (gain >= best) continue;
      best = gain, move = {a, b};
    }
  return move;
}

void cancel_pairs(const SurfaceMesh& mesh, const CrossFieldOptions& options,
                  QuarterTurnGraph& graph, ConePotential& potential) {
  for (;;) {
    options.stop.poll();
    const auto [from, to] = best_cancellation(mesh, options.cone_cost, graph, potential);
    if (from < 0) return;
    potential.move(from, to);
    if (graph.is_unbounded(from))
      graph.send(to, -1, [&](Index w) { return graph.is_unbounded(w); });
    else
      graph.send(from, 1, [&, goal = to](Index w) {
        return w == goal || (graph.is_unbounded(goal) && graph.is_unbounded(w));
      });
  }
}

// Returns the half-edge of v to the neighbour that lowers the energy most, by an estimate, by
// taking `step` quarter turns; -1 if none can.
Index best_neighbour(const SurfaceMesh& mesh, Index v, int step, const QuarterTurnGraph& graph,
                     ConePotential& potential) {
  std::vector<Index> ring;
  for (const Index h : graph.leaving(v)) ring.push_back(mesh.to_vertex(h));
  potential.watch(std::move(ring));
  Index best = -1;
  double least = 0;
  for (const Index h : graph.leaving(v)) {
    const Index w = mesh.to_vertex(h);
    const int after = graph.turns(w) + step;
    if (graph.is_unbounded(w) || after < graph.least_turns(w) || after > graph.most_turns(w))
      continue;
    const double estimate = potential.estimated_change(v, w, step);
    if (best < 0 || estimate < least) best = h, least = estimate;
  }
  return best;
}

// Moves every cone to a neighbour, or splits it, if that lowers the energy. Returns whether any
// moved.
bool improve_places(const SurfaceMesh& mesh, const CrossFieldOptions& options,
                    QuarterTurnGraph& graph, ConePotential& potential) {
  bool any = false;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (!is_cone(graph, v)) continue;
    options.stop.poll();
    const int step = graph.turns(v) > 4 ? 1 : -1;  // change of the neighbour
    const Index best = best_neighbour(mesh, v, step, graph, potential);
    if (best < 0) continue;
    const Index w = mesh.to_vertex(best), from = step > 0 ? v : w, to = step > 0 ? w : v;
    const double gain = potential.change(from, to) + options.cone_cost * graph.change(from, to);
    if (gain < -kLeastConeGain) {
      potential.move(from, to);
      graph.move(step > 0 ? best : mesh.opposite(best));
      any = true;
    }
    for (const Index u : {v, w})
      if (graph.turns(u) == 4) potential.forget(u);
  }
  return any;
}

}  // namespace

void lower_cone_energy(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                       const CrossFieldOptions& options, FieldConnection& field) {
  const std::vector<char> none_fixed;
  QuarterTurnGraph graph(mesh, geometry, none_fixed, {}, options.least_quarter_turns, field);
  Index cones = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) cones += is_cone(graph, v);
  if (cones > kMaxCones) return;
  ConePotential potential(mesh, geometry, field.quarter_turns, options.cone_energy);
  cancel_pairs(mesh, options, graph, potential);
  for (int sweep = 0; sweep < kMaxConeSweeps && improve_places(mesh, options, graph, potential);
       ++sweep)
    cancel_pairs(mesh, options, graph, potential);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
