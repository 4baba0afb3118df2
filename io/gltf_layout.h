// glTF files whose layout is another set of texture coordinates than the first one, and what they
// do not hold of a mesh of another format.
//
//   const PolygonMesh cup = read_mesh("cup.glb");
//   write_gltf("cup_uv.glb", file, &cup, {}, {}, 1);    // TEXCOORD_0 stays, TEXCOORD_1 is new
//   for (const std::string& part : left_out_of_gltf(cup)) std::cerr << part << "\n";
#pragma once

#include <string>
#include <vector>

#include "majorant/io/io.h"

namespace majorant {

// Does what write_gltf() of io.h does. uv_set: the set that the layout becomes, up to 7. Where it
// is not 0, the sets before it stay (those that are missing are the layout, too), and
// asset.extras.majorant_uv_set says so to readers, which take the layout from there.
void write_gltf(const std::string& path, const MapFile& map, const PolygonMesh* input,
                const TessellationOptions& options, const FileVerification& verify,
                std::size_t uv_set);

// Returns the parts of the materials of the input that write_gltf() leaves out, as nouns.
std::vector<std::string> left_out_of_gltf(const PolygonMesh& input);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
