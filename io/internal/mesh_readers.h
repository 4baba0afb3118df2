// One reader for each mesh format, for read_mesh. `path` is for messages, `content` the whole file.
// Each returns a mesh that has passed require_complete. Throws Error(Unreadable), or Stopped.
#pragma once

#include <string>
#include <string_view>

#include "majorant/framework/stop_check.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

PolygonMesh read_obj(const std::string& path, std::string content, const StopCheck& stop,
                     Strictness strictness);
PolygonMesh read_off(const std::string& path, std::string content, const StopCheck& stop,
                     Strictness strictness);
PolygonMesh read_ply(const std::string& path, std::string content, const StopCheck& stop,
                     Strictness strictness);
PolygonMesh read_gltf(const std::string& path, const std::string& content, const StopCheck& stop,
                      Strictness strictness);
// Returns the straight triangles between the corners, with the views u and v, if present, as
// texture coordinates. Nodes that are not corners are left out.
PolygonMesh read_gmsh_surface(const std::string& path, std::string content, const StopCheck& stop);
PolygonMesh read_stl(const std::string& path, std::string content, const StopCheck& stop);

// Throws Error(Unreadable) if the mesh has no vertices, no faces, or more than 32-bit numbering
// holds. Call it last.
void require_complete(const PolygonMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
