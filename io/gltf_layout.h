// Writes layouts to glTF in any set of texture coordinates, and lists what glTF cannot hold of
// other meshes.
//
//   const PolygonMesh cup = read_mesh("cup.glb");
//   write_gltf("cup_uv.glb", file, &cup, {}, {}, 1);    // TEXCOORD_0 stays, TEXCOORD_1 is new
//   for (const std::string& part : left_out_of_gltf(cup)) std::cerr << part << "\n";
#pragma once

#include <string>
#include <vector>

#include "majorant/io/io.h"

namespace majorant {

// Does the same as write_gltf() of io.h. uv_set: the set that becomes the layout, at most 7. If it
// is not 0, the sets before it stay (missing ones become copies of the layout), and
// asset.extras.majorant_uv_set tells readers to take the layout from it.
void write_gltf(const std::string& path, const MapFile& map, const PolygonMesh* input,
                const TessellationOptions& options, const FileVerification& verify,
                std::size_t uv_set);

// Returns the parts of the materials of the input that write_gltf() leaves out, as nouns.
std::vector<std::string> left_out_of_gltf(const PolygonMesh& input);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
