#include "majorant/parametrization/fields/internal/cone_cleanup.h"

#include <fmt/format.h>

#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/fields/internal/quarter_turn_graph.h"

namespace majorant {
namespace {

// With followed edges, a quarter turn is taken from a vertex with one too many within this number
// of edges, if there is one, instead of making a new cone. Chosen, not tuned.
constexpr int kNearby = 4;

// Returns whether any cone was cancelled.
bool cancel_neighbours(const SurfaceMesh& mesh, QuarterTurnGraph& graph) {
  bool any = false;
  for (Index h = 0; h < mesh.half_edge_count(); ++h) {
    if (!graph.is_movable(h) || graph.change(graph.start(h), graph.end(h)) >= 0) continue;
    graph.move(h);
    any = true;
  }
  return any;
}

// Passes one quarter turn from a node with an excess to the nearest node that can take it, or the
// other way round for a lack.
void level(const SurfaceMesh& mesh, Index v, QuarterTurnGraph& graph) {
  const int step = graph.excess(v) > 0 ? 1 : -1;  // change of the other node
  const auto takes = [&](Index w, int above) {
    const int after = graph.turns(w) + step;
    return after >= graph.least_turns(w) && after <= graph.most_turns(w) &&
           graph.turns(w) * step + above <= graph.regular(w) * step;
  };
  const bool is_sent =
      graph.send(
          v, step, [&](Index w) { return !graph.is_unbounded(w) && takes(w, 1); }, kNearby) ||
      graph.send(v, step, [&](Index w) { return graph.is_unbounded(w) || takes(w, 0); });
  if (!is_sent)
    throw Error(ErrorKind::Infeasible,
                fmt::format("{}vertex {}: the mesh is too coarse for the cones of a cross "
                            "field; refine it or align fewer edges",
                            message_prefix(mesh), user_vertex(mesh, graph.vertex(v))));
}

}  // namespace

void optimize_cones(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                    const std::vector<char>& is_fixed, AlignedSectors sectors, int least_turns,
                    FieldConnection& field) {
  QuarterTurnGraph graph(mesh, geometry, is_fixed, std::move(sectors), least_turns, field);
  // A pass can make room for the next one. Each pass leaves fewer cones.
  while (cancel_neighbours(mesh, graph)) {
  }
  for (const Index v : graph.nodes())
    while (graph.excess(v) != 0) level(mesh, v, graph);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
