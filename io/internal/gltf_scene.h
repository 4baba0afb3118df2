// The triangles of a glTF file as polygons, and where each of them is in the file: what a writer
// needs to give everything else back.
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

// Attribute of files that are made of other formats, or have new vertices between those of the
// input: the vertex of the input, from 0, new ones behind all others; low and high 16 bits (glTF
// has no attributes of 32-bit integers).
inline constexpr const char* kInputVertex = "_INPUT_VERTEX";
// Member of asset.extras: the set of texture coordinates that is the layout, where it is not the
// first one.
inline constexpr const char* kLayoutSet = "majorant_uv_set";
inline constexpr std::size_t kMostSets = 8;

// How the corners of a triangle make a list (4), a strip (5), a fan (6): primitive.mode.
inline constexpr std::size_t kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6;

struct GltfScene {
  GltfDocument document;
  std::size_t texcoord_set = 0;  // that texture coordinates were read of, where primitives have it

  // Vertices that primitives of a mesh share: these have the same attributes and morph targets.
  struct Vertices {
    std::size_t mesh = 0;
    std::vector<std::size_t> primitives;  // of the mesh; all of triangles
    std::vector<Index> numbers;           // of the vertices, in the polygon mesh
    bool is_mirrored = false;  // polygons run against triangles: the mesh is shown by a reflection
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
