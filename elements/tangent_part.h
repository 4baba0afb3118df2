// The components of a vector in space in the frame of a triangle, as flat_triangles() has it.
#pragma once

#include <optional>

#include "majorant/framework/types.h"

namespace majorant {

// Nothing for a vector that is not finite or along the normal, and for a triangle without a plane.
std::optional<Eigen::RowVector2d> tangent_part(const Points3& positions, const Cells& faces,
                                               Index face, const Vector3& vector);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
