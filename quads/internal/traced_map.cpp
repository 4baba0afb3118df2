#include "majorant/quads/internal/traced_map.h"

#include <utility>

#include "majorant/framework/error.h"
#include "majorant/quads/internal/timed.h"

namespace majorant {

TracedMap::TracedMap(ResolvedSurface surface, const SeamlessOptions& map_options, RunRecord& record,
                     QuadSeconds& seconds)
    : resolved(std::move(surface)),
      aligned(timed(seconds.map,
                    [&] {
                      return resolved.border_turn > kCornerTurn
                                 ? aligned_map(smooth_border(resolved), map_options, record)
                                 : aligned_map(resolved, map_options, record);
                    })),
      lattice(resolved.mesh, aligned.map, resolved.is_feature, resolved.border_turn),
      t_mesh(timed(seconds.quantize, [&] { return trace_t_mesh(lattice, record.start_stop()); })) {}

std::unique_ptr<const TracedMap> traced_map(const SurfaceMesh& mesh,
                                            const std::vector<char>& features,
                                            const QuadMeshOptions& options, RunRecord& record,
                                            QuadSeconds& seconds) {
  // The number of subdivisions, and the number of faces up to which a map takes seconds. Chosen,
  // not tuned.
  constexpr int kMaxHalvings = 2;
  constexpr Index kMaxFaces = 10'000;
  SeamlessOptions map_options = options.map;
  map_options.threads = options.threads;
  ResolvedSurface resolved = resolve_feature_edges(mesh, features);
  resolved.border_turn = options.border_turn;
  for (int halvings = 0;; ++halvings) {
    record.begin(Activity::Starting);
    const bool is_last = halvings == kMaxHalvings || 4 * resolved.mesh.face_count() > kMaxFaces;
    try {
      return std::make_unique<const TracedMap>(resolved, map_options, record, seconds);
    } catch (const Error& error) {
      const bool has_no_map =
          error.kind() == ErrorKind::Infeasible || error.kind() == ErrorKind::Invalid;
      if (is_last || !has_no_map) throw;
    }
    record.announce("halving all edges, which are too long for a map");
    record.begin_pass();
    resolved = subdivided(resolved);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
