// The default direction from which a surface is seen, in pages and in PNG files.
#pragma once

#include "majorant/maps/map_file.h"

namespace majorant {

// Returns a unit vector to the eye. It is the mean normal if that is longer than a fifth of its
// length for a planar surface, so that disks are seen from their front. Otherwise it is one of 12
// directions around the y axis, 20 degrees above the horizon: the one with the largest viewpoint
// entropy [VFSH01], -sum p log p over the shares p that triangles have of the visible surface. This
// prefers detailed parts such as faces and hands. The first of equal directions looks from (0.3,
// 0.3, 0.9).
Vector3 first_view(const MapFile& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
