// Glues a map where its boundary and the surface meet themselves, which gives the map of one piece.
#pragma once

#include <optional>
#include <vector>

#include "majorant/maps/bezier_map.h"

namespace majorant {

// Files may hold a point of the surface several times, with different numbers and the same place
// and uv, if exporters split pieces and the layout welded them. If two boundary edges of the map
// run against each other between such points, the map is continuous across them. Glues all such
// edges whose faces are in one group; the image is unchanged. group: by face; empty: one group.
// None if there are no such edges, or if control points between the vertices differ.
std::optional<BezierMap> glued(const BezierMap& map, const std::vector<Index>& group = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
