// The textures of a model, moved to other texture coordinates: one image for all its materials.
//
//   const PolygonMesh model = read_mesh("old.obj");
//   ModelTexture texture = read_texture(model);                // of its mtllib, map_Kd
//   write_textured("new.obj", {file, with_material_file(model, "new.obj"), {}, {}}, model,
//                  std::move(texture));                        // and new.png, new.mtl
//
// Of glTF the base colours (io/gltf_texture.h); the image is put into the file.
#pragma once

#include <string>
#include <vector>

#include "majorant/apps/jobs/bake_job.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/atomic_file.h"

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

// True where models of that name hold textures: .obj, .glb, .gltf.
bool may_have_texture(const std::string& model);
// The image and the material file that stand beside an OBJ of that name.
std::string texture_file(const std::string& obj);
std::string material_file(const std::string& obj);
// The same polygons, whose materials are in that file, written to `obj`.
PolygonMesh with_material_file(PolygonMesh polygons, const std::string& obj);

// What write_map() takes.
struct LayoutOfModel {
  const MapFile& map;
  const PolygonMesh& polygons;
  const MapFormats& formats;
  const FileVerification& verify;
};
// Writes an OBJ or glTF as write_map() does, in whose layout, read back, the texture is baked that
// `old` shows: to the image and the material file, or into the glTF. As large as the largest image
// of the texture. The model takes its name last, so that it appears with its texture or not at all.
// Throws as write_map() and BakeJob::run(), Error(Invalid) where that is not proven; Error(Usage)
// for a glTF that is no regular file.
void write_textured(const std::string& path, const LayoutOfModel& layout, const PolygonMesh& old,
                    ModelTexture texture, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
