// Does a plane polygon cross itself?
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// Returns whether triangles of a polygon are in one plane, and some face its other side, whatever
// triangles are chosen. triangles: numbers of corners; texture coordinates may have chosen them.
bool is_crossing(const std::vector<Vector3>& corners,
                 const std::vector<std::array<int, 3>>& triangles);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
