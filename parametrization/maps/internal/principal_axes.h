// Which way a layout is longest: what it is turned by to lie along the axes.
#pragma once

#include "majorant/framework/types.h"

namespace majorant {

// The unit vector that the area of the triangles spreads most along (the principal axis of their
// second moments), towards the end that it thins out to (positive third moment), or to the right
// where the ends are alike. uv: #N by 2,
// cells: #F by 3 or more, of which the first three columns are corners. (1, 0) where no direction
// is clearly longer than another.
Vector2 principal_direction(const Points2& uv, const Cells& cells);

// uv turned so that `direction`, of length 1, becomes (1, 0): (1, 0) itself changes no digit. Point
// by point: equal points stay equal.
Points2 turned_along(const Points2& uv, const Vector2& direction);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
