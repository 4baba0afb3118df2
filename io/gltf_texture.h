// The base colour textures of a glTF file: what its triangles show by TEXCOORD_0, and one image in
// their place.
//
//   const PolygonMesh cup = read_mesh("cup.glb");
//   const BaseColors colors = base_colors(cup);
//   colors.images[to_size(colors.image_of_polygon[12])].bytes;      // a PNG or JPEG
//   // text: a PNG, baked into the layout of new.glb, which write_gltf() has made of cup
//   write_base_color("new.glb", read_mesh("new.glb"), text, {});
//
// Other textures (normals, roughness, ...) stay as they are, shown by the set of coordinates that
// write_gltf() has moved the old ones to.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/framework/types.h"
#include "majorant/io/atomic_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

struct BaseColors {
  // wrapS, wrapT of a sampler: what is shown beyond the square of an image.
  enum class Wrap { Repeat, Clamp, Mirror };
  struct Image {
    std::string bytes;
    std::string name;  // for messages
    std::array<Wrap, 2> wrap{Wrap::Repeat, Wrap::Repeat};
  };
  std::vector<Image> images;
  std::vector<int> image_of_polygon;  // -1: its material shows none
};

// mesh: read from glTF. An image that two samplers show is there twice. Throws Error(Unsupported)
// for textures that are scaled or moved (KHR_texture_transform), shown by another set of
// coordinates, or of a kind that glTF itself does not have; Error(Unreadable) for images that are
// not there; Stopped.
BaseColors base_colors(const PolygonMesh& mesh, const StopCheck& stop = {});

// COLOR_0 of the corners of polygons, linear light, three times as many rows as triangles; white
// where a primitive has none. No rows where none has. mesh: read from glTF.
RowMatrix corner_colors(const PolygonMesh& mesh);

// Writes the file that `mesh` was read from to `path`, where all materials of triangles that have
// shown a base colour texture show this PNG instead, by TEXCOORD_0. Coordinates and images that
// nothing shows any more are left out. Throws as write_gltf().
void write_base_color(const std::string& path, const PolygonMesh& mesh, const std::string& png,
                      const FileVerification& verify = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
