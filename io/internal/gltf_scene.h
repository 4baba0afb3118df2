// The triangles of a glTF file as polygons, with their places in the file, which a writer needs to
// preserve everything else.
//
//   const PolygonMesh mesh =
//       read_gltf("cup.glb", read_whole_file("cup.glb"), {}, Strictness::Shape);
//   const GltfScene& scene = *mesh.gltf;
//   scene.faces[12].vertices;   // of polygon 12, in the accessors of its primitive
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/io/internal/gltf_document.h"

namespace majorant {

// The vertex of the input, from 0, as low and high 16 bits (glTF has no attributes of 32-bit
// integers). For files made from other formats, or with new vertices between those of the input;
// new ones are numbered last.
inline constexpr const char* kInputVertex = "_INPUT_VERTEX";
// The member of asset.extras with the set of texture coordinates that is the layout, if it is not
// the first.
inline constexpr const char* kLayoutSet = "majorant_uv_set";
inline constexpr std::size_t kMaxSets = 8;

// Values of primitive.mode for lists, strips and fans of triangles.
inline constexpr std::size_t kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6;

struct GltfScene {
  GltfDocument document;
  std::size_t texcoord_set = 0;  // set that texture coordinates are read from

  // Vertices that primitives of a mesh share: these have the same attributes and morph targets.
  struct Vertices {
    std::size_t mesh = 0;
    std::vector<std::size_t> primitives;  // of the mesh; all have triangles
    std::vector<Index> numbers;           // in the polygon mesh, by vertex
    bool is_mirrored = false;  // the transform is a reflection, so polygons are reversed triangles
  };
  std::vector<Vertices> vertices;

  struct Face {
    Index vertices = 0;   // number of its Vertices
    Index primitive = 0;  // of the mesh
    std::array<std::uint32_t, 3> corners{};
  };
  std::vector<Face> faces;  // by polygon
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
