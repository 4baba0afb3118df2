#include "majorant/apps/jobs/float_layout.h"

#include "majorant/apps/jobs/corner_vertices.h"
#include "majorant/io/float_room.h"

namespace majorant {

FloatLayout float_layout(const MapFile& map, const PolygonMesh& input,
                         const ProofRequest& request) {
  FloatLayout layout{with_room_in_floats(map, StoredV::Up), {}};
  layout.map.uv = layout.map.uv.cast<float>().cast<double>();
  if (std::optional<MapFile> named = with_corner_vertices(layout.map, input))
    layout.map = std::move(*named);
  const MapProof proof(layout.map, "layout in floats", request);
  if (proof.verdict() != ProofStatus::Proven) layout.defect = proof.first_defect();
  return layout;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
