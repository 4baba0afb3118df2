// How much of a layout lies on other parts of it, for words about it: how many faces, on how much
// of their area.
//
//   if (const auto found = overlap_extent(map, {})) say("{} faces lie on others\n", found->faces);
//
// Measured between straight pieces, in floating point. Not a proof: check_boundary() says whether
// anything overlaps.
#pragma once

#include <optional>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/maps/bezier_map.h"

namespace majorant {

struct OverlapExtent {
  Index faces = 0;   // that lie on others
  double share = 0;  // of the area of all images of faces: what lies on others
};

// layer: by face, or empty: faces of different layers are not compared. None where more pieces meet
// than can be looked at. What is turned over counts for nothing. Throws Stopped.
std::optional<OverlapExtent> overlap_extent(const BezierMap& map, const std::vector<Index>& layer,
                                            const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
