// Tests whether a plane polygon crosses itself.
#pragma once

#include <array>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// Returns whether the triangles of a polygon are in one plane, and every choice of triangles has
// some that face its other side. triangles: numbers of corners; texture coordinates may have chosen
// them.
bool is_crossing(const std::vector<Vector3>& corners,
                 const std::vector<std::array<int, 3>>& triangles);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
