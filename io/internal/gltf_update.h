// A glTF file with other texture coordinates, and all else as it was.
//
//  const GltfOutput out = updated_gltf(*input.gltf, input, mesh, origins, "cup.glb");
//
// The new coordinates are those of one set, TEXCOORD_0 or another one. Where a material shows
// textures by the old ones of that set, these become the next set, and its texCoord follows: the
// model looks as before. Vertices whose corners have several new coordinates get copies behind all
// others. Tangents, which belong to the coordinates of a normal texture, stay with these.
#pragma once

#include <string>
#include <vector>

#include "majorant/io/internal/gltf_output.h"
#include "majorant/io/internal/gltf_scene.h"
#include "majorant/mesh/polygon_mesh.h"
#include "majorant/parametrization/tessellation/tessellate_map.h"

namespace majorant {

// input: what `scene` was read as; mesh, origins: what tessellate_map() made of it. path: of the
// file to be; images beside the document go into it where that is in another folder. uv_set: the
// set that the new coordinates become. Throws Error as GltfDocument.
GltfOutput updated_gltf(const GltfScene& scene, const PolygonMesh& input, const PolygonMesh& mesh,
                        const std::vector<PolygonOrigin>& origins, const std::string& path,
                        std::size_t uv_set);

// Says in the file which set is the layout (kLayoutSet), unless it is the first one. Throws
// Error(Unsupported), beginning with `path`, where asset.extras is no object.
void mark_layout_set(Gltf& json, std::size_t uv_set, const std::string& path);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
