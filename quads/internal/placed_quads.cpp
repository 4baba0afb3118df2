#include "majorant/quads/internal/placed_quads.h"

#include <fmt/format.h>

#include <utility>

#include "majorant/framework/error.h"
#include "majorant/quads/internal/extraction.h"
#include "majorant/quads/internal/smoothing.h"
#include "majorant/quads/internal/timed.h"

namespace majorant {

PlacedQuads place_quads(const SurfaceMesh& mesh, const std::vector<char>& features,
                        const TracedMap& traced, const std::vector<Index>& edges,
                        const RunRecord& record, QuadSeconds& seconds) {
  const StopCheck& stop = record.start_stop();
  const SeamlessLattice& lattice = traced.lattice;
  ExtractedQuads extracted =
      timed(seconds.place, [&] { return ExtractedQuads(lattice, traced.t_mesh, edges); });
  PolygonMesh quads = timed(seconds.place, [&] { return extracted.polygons(); });
  QuadCheck check = timed(seconds.check, [&] { return check_quads(quads, nullptr, {}, stop); });
  HeldVertices held = timed(seconds.place, [&] { return extracted.held_vertices(); });
  if (check.is_surface) {
    record.announce(fmt::format("smoothing {} quads", check.count));
    timed(seconds.smooth, [&] { smooth_quads(quads, lattice.surface(), held, stop); });
    record.begin(Activity::Proving);
    check = timed(seconds.check, [&] {
      return check_quads(quads, &mesh, features, record.telling(stop), lattice.border_turn());
    });
  }
  if (!check.is_valid()) throw Error(ErrorKind::Infeasible, check.defects.front());
  return {std::move(quads), extracted.patches(), std::move(held.feature_edges), std::move(check),
          static_cast<Index>(traced.t_mesh.patches.size())};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
