// Sweeps that move the vertices of a mesh one at a time, run on several threads.
//
//   const CollapsingMesh left(mesh->faces(), mesh->opposites(), mesh->vertex_count());
//   VertexDescent descent(left, mesh->positions(), options.map.energy, start);
//   descent.measure_all();
//   const SweepStages stages(left, [](Index v) { return v != 7; }, 4);   // all vertices but one
//   std::vector<VertexDescent> descents(2, descent);                     // one a thread
//   stages.visit(descents);
//
// The result equals, to the last bit, that of sweeps in the order of the vertices' numbers: a
// vertex sees lower-numbered neighbours at their places of this sweep, the others at those of the
// last one. It may move as soon as the former have moved in this sweep and the latter in the last
// one. Vertices of one stage are never neighbours. The next sweep begins where this one has passed,
// long before it has ended everywhere.
#pragma once

#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/parametrization/initialization/collapsing_mesh.h"
#include "majorant/parametrization/initialization/internal/vertex_descent.h"

namespace majorant {

class SweepStages {
 public:
  // moves(v): whether a vertex moves.
  template <class Moves>
  SweepStages(const CollapsingMesh& mesh, const Moves& moves, int sweeps) {
    std::vector<char> flags(to_size(mesh.vertex_count()));
    for (Index v = 0; v < mesh.vertex_count(); ++v) flags[v] = moves(v) ? 1 : 0;
    order(mesh, flags, sweeps);
  }

  // Moves every vertex once in every sweep, on as many threads as there are descents, which are
  // copies that share one map. Throws Stopped.
  void visit(std::vector<VertexDescent>& descents, const StopCheck& stop = {}) const;

 private:
  void order(const CollapsingMesh& mesh, const std::vector<char>& moves, int sweeps);

  std::vector<std::size_t> starts_;  // of the stages, and their end
  std::vector<Index> vertices_;      // stage by stage
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
