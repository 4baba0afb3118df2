// Replaces the texture coordinates of a glTF file, and keeps everything else.
//
//  const GltfOutput out = updated_gltf(*input.gltf, input, mesh, origins, "cup.glb");
//
// The new coordinates are in TEXCOORD_0 or another set. If a material shows textures by the old
// coordinates of that set, these become the next set, and its texCoord follows, so that the model
// looks the same. Vertices whose corners have several new coordinates get copies behind all others.
// Tangents belong to the coordinates of a normal texture and stay with them.
#pragma once

#include <string>
#include <vector>

#include "majorant/io/internal/gltf_output.h"
#include "majorant/io/internal/gltf_scene.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {

// input: the mesh that `scene` was read as; mesh, origins: results of tessellate_map(). path: of
// the output; images beside the document are embedded if it is in another folder. uv_set: the set
// of the new coordinates. Throws the errors of GltfDocument.
GltfOutput updated_gltf(const GltfScene& scene, const PolygonMesh& input, const PolygonMesh& mesh,
                        const std::vector<PolygonOrigin>& origins, const std::string& path,
                        std::size_t uv_set);

// Records in the file which set is the layout (kLayoutSet), unless it is the first. Throws
// Error(Unsupported), beginning with `path`, if asset.extras is no object.
void mark_layout_set(Gltf& json, std::size_t uv_set, const std::string& path);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
