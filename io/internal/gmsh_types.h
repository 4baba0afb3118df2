// gmsh's types of elements, and the order of their nodes.
#pragma once

#include <vector>

#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// gmsh's order of the nodes of a cell: of each the place in VTK's.
std::vector<int> gmsh_order(const CellType& type);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
