#include "majorant/quads/internal/aligned_map.h"

#include <fmt/format.h>

#include <vector>

#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/refusal.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/quads/internal/border.h"

namespace majorant {
namespace {

// A single quad around a vertex would meet itself along an edge.
void require_turns(const SurfaceMesh& mesh, Index vertex, int quarter_turns) {
  if (quarter_turns == 1)
    throw Error(ErrorKind::Infeasible,
                fmt::format("{}vertex {}: a cone of one quarter turn, around which there are no "
                            "quads; refine the mesh there",
                            message_prefix(mesh), user_vertex(mesh, vertex)));
}

// Makes the start. If edges are held, cones cannot be prescribed, and there may be no start.
Start seamless_start(const SurfaceMesh& mesh, const SeamlessOptions& settings,
                     const RunRecord& record) {
  try {
    return make_seamless(mesh, settings, record);
  } catch (const Refusal& refusal) {
    if (refusal.kind() != ErrorKind::Invalid || settings.field.aligned.empty()) throw;
    throw Error(ErrorKind::Infeasible, refusal.problem() + "; refine the mesh there");
  }
}

}  // namespace

AlignedMap aligned_map(const ResolvedSurface& surface, SeamlessOptions settings,
                       RunRecord& record) {
  const SurfaceMesh& mesh = surface.mesh;
  ParametrizationOptions optimize;
  const std::vector<char> is_held = held_flags(mesh, surface.is_feature);
  for (Index h = 0; h < mesh.half_edge_count(); ++h)
    if (is_held[h] && (mesh.opposite(h) < 0 || h < mesh.opposite(h)))
      optimize.map.aligned.push_back(h);
  if (!optimize.map.aligned.empty()) settings.field.aligned = is_held;
  if (settings.cones)
    for (const Cone& cone : *settings.cones) require_turns(mesh, cone.vertex, cone.quarter_turns);
  const Start start = seamless_start(mesh, settings, record);
  const std::vector<int>& turns = start.map.seams().quarter_turns();
  for (std::size_t v = 0; v < turns.size(); ++v)
    require_turns(mesh, static_cast<Index>(v), turns[v]);
  optimize.map.degree = 1;
  optimize.solve.threads = settings.threads;
  const ParametrizationResult result = parametrize(start.map, optimize, record);
  return {result.map ? *result.map : start.map, result.status};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
