// The vertices of the mesh that a map was made from, by what a file of the map says of its points.
#pragma once

#include <string>
#include <vector>

#include "majorant/parametrization/maps/map_file.h"

namespace majorant {

// vertex: for every point its vertex, looked at where it is a corner of a cell, not negative there.
// Vertices without a cell are where some other one is. Throws Error(Unreadable) that begins with
// `name` when copies of a vertex are at different places, and for numbers beyond belief.
std::vector<Vector3> vertex_positions(const MapFile& file,
                                      const Eigen::Ref<const Eigen::VectorXi>& vertex,
                                      const std::string& name);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
