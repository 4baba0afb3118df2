// A map whose boundary meets itself where the surface does, too: as the map of one piece.
#pragma once

#include <optional>
#include <vector>

#include "majorant/maps/bezier_map.h"

namespace majorant {

// Files may hold a point of the surface several times, with different numbers and the same place
// and uv: pieces that exporters split, welded by who laid them out. Where two boundary edges of the
// map run against each other between such points the map is continuous across them, and no
// boundary. Glues all that are, of faces of one group each; the image is the same. group: by face,
// or empty: all are one. None where there are none, or control points between the vertices differ.
std::optional<BezierMap> glued(const BezierMap& map, const std::vector<Index>& group = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
