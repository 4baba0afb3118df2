// The textures of a model, moved to other texture coordinates: one image for all its materials.
//
//   const PolygonMesh model = read_mesh("old.obj");
//   ModelTexture texture = read_texture(model);                // of its mtllib, map_Kd
//   write_textured("new.obj", {file, with_material_file(model, "new.obj"), {}, {}}, model,
//                  std::move(texture), std::nullopt);          // and new.png, new.mtl
//
// Other images of the materials of an OBJ, which has no second set of coordinates, move likewise:
// new_map_Ks.png. Of glTF the base colours (io/gltf_texture.h); the image is put into the file, and
// other textures stay where they are, shown by the old coordinates.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "majorant/apps/jobs/bake_job.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/atomic_file.h"

namespace majorant {

// The images that materials show by one of their keywords.
struct TextureLayer {
  std::string keyword;                 // map_Kd; of glTF too
  Transfer transfer = Transfer::Srgb;  // Linear: numbers, no colours
  std::vector<Raster> images;          // those of materials without one are of one pixel
  std::vector<Wraps> wraps;            // by image
  std::vector<int> image_of_polygon;   // by polygon
};

struct ModelTexture {
  TextureLayer color;
  std::vector<TextureLayer> others;   // of an OBJ
  std::vector<std::string> files;     // of the images
  std::vector<std::string> lines;     // of the material files of an OBJ, one after the other
  std::vector<std::string> warnings;  // what is not moved
};

// The images that are read: colours alone, or others of an OBJ, too.
enum class Layers { Color, All };

// polygons: read from OBJ or glTF, or of another format, which shows no texture. None where they
// have no texture coordinates or show no texture by them. Throws Error(Unsupported) for a texture
// that is scaled or moved (-s, -o, -t; KHR_texture_transform); Error(Unreadable) for files that
// cannot be read; Stopped.
std::optional<ModelTexture> find_texture(const PolygonMesh& polygons, Layers layers,
                                         const StopCheck& stop = {});
// All layers. Throws Error(Unsupported) where there is no texture.
ModelTexture read_texture(const PolygonMesh& polygons, const StopCheck& stop = {});
// The files of images (map_Kd) that an OBJ shows by its texture coordinates; none where its
// libraries cannot be read.
std::vector<std::string> shown_pictures(const PolygonMesh& polygons);

// True where models of that name hold textures: .obj, .glb, .gltf.
bool may_have_texture(const std::string& model);
// The image and the material file that stand beside an OBJ of that name.
std::string texture_file(const std::string& obj);
std::string material_file(const std::string& obj);
// The images of other layers that stand there.
std::vector<std::string> layer_files(const std::string& obj, const ModelTexture& texture);
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
// `old` shows: to the image and the material file, or into the glTF. side: pixels of the image;
// none: as large as the largest image of the texture, and as all of them together. The model takes
// its name last, so that it appears with its texture or not at all.
// Throws as write_map() and BakeJob::run(), Error(Invalid) where that is not proven; Error(Usage)
// for a glTF that is no regular file, and for an image beside an OBJ that the texture is read from.
void write_textured(const std::string& path, const LayoutOfModel& layout, const PolygonMesh& old,
                    ModelTexture texture, std::optional<int> side, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
