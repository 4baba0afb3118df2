// Sweeps over the vertices of a mesh, each moved by itself, on several threads.
//
//   const CollapsingMesh left(mesh->faces(), mesh->opposites(), mesh->vertex_count());
//   VertexDescent descent(left, mesh->positions(), options.map.energy, start);
//   descent.measure_all();
//   const SweepStages stages(left, [](Index v) { return v != 7; }, 4);   // all vertices but one
//   std::vector<VertexDescent> descents(2, descent);                     // one a thread
//   stages.visit(descents);
//
// The places are those of sweeps in the order of the vertices' numbers, to the last bit: a vertex
// sees those of its neighbours that come before it where they have gone in this sweep, the others
// where they were left by the one before. So it can move as soon as the former have in this sweep
// and the latter in the last one, and vertices whose turn is the same are no neighbours. The next
// sweep begins where this one has passed, long before it has ended everywhere.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/parametrization/initialization/internal/collapsing_mesh.h"
#include "majorant/parametrization/initialization/internal/vertex_descent.h"

namespace majorant {

class SweepStages {
 public:
  // moves(v): whether a vertex does.
  template <class Moves>
  SweepStages(const CollapsingMesh& mesh, const Moves& moves, int sweeps) {
    std::vector<char> flags(to_size(mesh.vertex_count()));
    for (Index v = 0; v < mesh.vertex_count(); ++v) flags[v] = moves(v) ? 1 : 0;
    order(mesh, flags, sweeps);
  }

  // A step of every vertex in every sweep, on as many threads as there are descents, all of the
  // same map. Throws Stopped.
  void visit(std::vector<VertexDescent>& descents, const StopCheck& stop = {}) const;

 private:
  void order(const CollapsingMesh& mesh, const std::vector<char>& moves, int sweeps);

  std::vector<std::size_t> starts_;  // of the stages, and their end
  std::vector<Index> vertices_;      // stage by stage
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
