// Measures how much of a layout lies on other parts of it: the number of faces and the share of
// their area.
//
//   if (const auto found = overlap_extent(map, {})) say("{} faces lie on others\n", found->faces);
//
// Measured between straight pieces in floating point. This is no proof: check_boundary() decides
// whether anything overlaps.
#pragma once

#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

struct OverlapExtent {
  Index faces = 0;   // faces that lie on others
  double share = 0;  // of the area of all faces' images
};

// layer: by face; faces of different layers are not compared. Empty: one layer. Faces that are
// turned over are ignored. None if too many pieces meet. Throws Stopped.
std::optional<OverlapExtent> overlap_extent(const BezierMap& map, const std::vector<Index>& layer,
                                            const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
