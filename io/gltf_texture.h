// The base colour textures of a glTF file, as triangles show them by TEXCOORD_0, and their
// replacement by one image.
//
//   const PolygonMesh cup = read_mesh("cup.glb");
//   const BaseColors colors = base_colors(cup);
//   colors.images[to_size(colors.image_of_polygon[12])].bytes;      // a PNG or JPEG
//   // text: a PNG, baked into the layout of new.glb, which write_gltf() has made of cup
//   write_base_color("new.glb", read_mesh("new.glb"), text, {});
//
// Other textures (normals, roughness, ...) do not change; write_gltf() has moved their coordinates
// to another set.
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
  // wrapS, wrapT of a sampler: the texture beyond the square of an image.
  enum class Wrap { Repeat, Clamp, Mirror };
  struct Image {
    std::string bytes;
    std::string name;  // for messages
    std::array<Wrap, 2> wrap{Wrap::Repeat, Wrap::Repeat};
  };
  std::vector<Image> images;
  std::vector<int> image_of_polygon;  // -1: no image
};

// mesh: read from glTF. An image with two samplers is listed twice. Throws Error(Unsupported) for
// textures that are transformed (KHR_texture_transform), use another set of coordinates, or have a
// format that is not glTF's own; Error(Unreadable) for missing images; Stopped.
BaseColors base_colors(const PolygonMesh& mesh, const StopCheck& stop = {});

// Returns COLOR_0 at the corners of polygons in linear light, three rows for each triangle; white
// if a primitive has none. No rows if no primitive has colours. mesh: read from glTF.
RowMatrix corner_colors(const PolygonMesh& mesh);

// Writes the file that `mesh` was read from to `path`. All materials of triangles with a base
// colour texture show this PNG instead, by TEXCOORD_0. Unused coordinates and images are removed.
// Throws the errors of write_gltf().
void write_base_color(const std::string& path, const PolygonMesh& mesh, const std::string& png,
                      const FileVerification& verify = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
