// The textures of a model, moved to other texture coordinates: one image for all its materials.
//
//   const PolygonMesh model = read_mesh("old.obj");
//   ModelTexture texture = read_texture(model);                // of its mtllib, map_Kd
//   const PolygonMesh moved = with_material_file(model, "new.obj");
//   // moved is written to new.obj, with other texture coordinates
//   bake_texture(std::move(texture), model, "new.obj");        // new.png and new.mtl beside it
//
// Of glTF the base colours (io/gltf_texture.h); the image is put into the file.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/io/atomic_file.h"
#include "majorant/results/bake_job.h"

namespace majorant {

struct ModelTexture {
  std::vector<Raster> images;         // those of materials without one are of one pixel
  std::vector<int> image_of_polygon;  // by polygon
  std::vector<std::string> lines;     // of the material files of an OBJ, one after the other
  std::vector<std::string> warnings;  // what is not moved
};

// polygons: read from OBJ or glTF. Throws Error(Unsupported) where they have no texture coordinates
// or show no texture by them, or one that is scaled or moved (-s, -o, -t; KHR_texture_transform);
// Error(Unreadable) for files that cannot be read; Stopped.
ModelTexture read_texture(const PolygonMesh& polygons, const StopCheck& stop = {});

// Whether models of that name hold textures: .obj, .glb, .gltf.
bool may_have_texture(const std::string& model);
// The image and the material file that stand beside an OBJ of that name.
std::string texture_file(const std::string& obj);
std::string material_file(const std::string& obj);
// The same polygons, whose materials are in that file, written to `obj`.
PolygonMesh with_material_file(PolygonMesh polygons, const std::string& obj);

// Reads `model` back, bakes into its layout what `old` carries, and writes image and material file,
// or, of glTF, the model with the image in it, verified as it was. As large as the largest texture.
// Throws as BakeJob::run(), Error(Invalid) where that is not proven.
void bake_texture(ModelTexture texture, const PolygonMesh& old, const std::string& model,
                  const FileVerification& verify = {}, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
