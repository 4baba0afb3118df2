// gmsh's element types and the order of their nodes.
#pragma once

#include <optional>
#include <vector>

#include "majorant/volumes/volume_mesh.h"

namespace majorant {

// Triangles and segments may have degrees up to 10, other shapes up to CellType::kMaxDegree.
std::optional<CellType> gmsh_type(std::int64_t number);  // none: not supported
std::optional<int> gmsh_number(const CellType& type);    // none: gmsh lacks this type
bool is_gmsh_pyramid(std::int64_t number);

// Both require a type number that gmsh_type() knows.
int gmsh_node_count(int number);
int gmsh_dimension(int number);

// Returns, for each node in gmsh's order, its place in VTK's order. The orders agree for triangles.
std::vector<int> gmsh_order(const CellType& type);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
