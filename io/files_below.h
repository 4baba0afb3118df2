// Restricts files that a file names to its own folder and subfolders.
//
//   is_below("in/cup.obj", "textures/wood.mtl");   // true
//   is_below("in/cup.obj", "../wood.mtl");         // false
#pragma once

#include <string>

#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// Returns whether `name`, in the file at `path`, leads into the folder of that file or below, also
// after links. False for names that are empty, absolute, or begin with a drive.
bool is_below(const std::string& path, const std::string& name);

// Throws Error(Unsupported) for an OBJ mesh whose `mtllib` names a file elsewhere.
void require_materials_below(const PolygonMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
