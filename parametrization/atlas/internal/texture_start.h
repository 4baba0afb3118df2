// The file's texture coordinates of a chart as a start of its map, as good as they can be made.
#pragma once

#include <memory>
#include <optional>

#include "majorant/framework/run_record.h"
#include "majorant/parametrization/atlas/unwrap.h"

namespace majorant {

struct PreparedTexture {
  Vec uv;  // u, v per vertex; every triangle positively oriented, area that of the surface
  ChartStart start;  // Texture or Untangled
};

// mesh: a chart that its texture coordinates do not cut. Mirrored islands are mirrored back, those
// with triangles turned over are untangled. None where the mesh has no coordinates, they have no
// area, or untangling fails.
std::optional<PreparedTexture> texture_start(const std::shared_ptr<const SurfaceMesh>& mesh,
                                             const RunRecord& record);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
