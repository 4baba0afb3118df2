// The direction from which a surface is seen where nobody names one: a page when it opens, a PNG
// with a bare --view.
#pragma once

#include "majorant/maps/map_file.h"

namespace majorant {

// A direction to the eye, of length 1. Along the mean of the normals where that is longer than a
// fifth of what it would be in the plane: disks are seen from their front. Of other surfaces that
// of 12 directions around the y axis, 20 degrees above the horizon, whose picture tells most: with
// the largest viewpoint entropy [VFSH01], -sum p log p over the shares p that triangles have of the
// visible surface. Faces and hands, where triangles are small, are seen rather than backs; the
// first of equals, which looks from (0.3, 0.3, 0.9), where no direction tells more.
Vector3 first_view(const MapFile& map);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
