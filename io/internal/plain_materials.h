// Converts the materials of an OBJ to those of a glTF file.
//
//   const PlainMaterials all = plain_materials(read_mesh("cup.obj"));
//   for (const std::string& part : all.left_out) std::cerr << part << "\n";  // map_Bump of 'wood'
//
// Not for textures that move to other coordinates (apps/jobs/model_texture.h): images are embedded
// unchanged.
#pragma once

#include <string>
#include <vector>

#include "majorant/io/internal/gltf_document.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

struct PlainMaterials {
  struct Image {
    std::string file, bytes, mime;
    bool clamps = false;
  };
  struct Material {
    Gltf json;       // without its texture
    int image = -1;  // index of its base colour in `images`
  };
  std::vector<Image> images;
  std::vector<Material> materials;
  std::vector<int> of_polygon;        // by polygon of the mesh; -1: none
  std::vector<std::string> left_out;  // nouns: contents that are not converted
};

// mesh: read from OBJ; other formats have no such materials. Unreadable images and libraries are
// left out.
PlainMaterials plain_materials(const PolygonMesh& mesh);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
