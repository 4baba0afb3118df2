// gmsh's types of elements, and the order of their nodes.
#pragma once

#include <optional>
#include <vector>

#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// Triangles and segments have degrees up to 10 there, other shapes up to CellType::kMaxDegree.
std::optional<CellType> gmsh_type(std::int64_t number);  // none: without a place here
std::optional<int> gmsh_number(const CellType& type);    // none: gmsh has no such cells
bool is_gmsh_pyramid(std::int64_t number);

// Both need the number of a type that gmsh_type() knows.
int gmsh_node_count(int number);
int gmsh_dimension(int number);

// gmsh's order of the nodes of a cell: of each the place in VTK's. Of triangles they are the same.
std::vector<int> gmsh_order(const CellType& type);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
