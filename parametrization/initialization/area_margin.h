// Tests that a map leaves its triangles more room than rounding takes.
#pragma once

#include "majorant/framework/types.h"

namespace majorant {

// Returns the number of faces (#F by 3) that are not positive in exact signs, or so flat that
// moving the map, which rounds its points, might invert them. uv: 2 numbers per vertex; the origin
// lies inside or near.
Index faces_without_area_margin(const Cells& faces, const Vec& uv);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
