// Moves the textures of a model to new texture coordinates, as one image for all materials.
//
//   const PolygonMesh model = read_mesh("old.obj");
//   ModelTexture texture = read_texture(model);                // of its mtllib, map_Kd
//   write_textured("new.obj", {file, with_material_file(model, "new.obj"), {}, {}}, model,
//                  std::move(texture), std::nullopt);          // and new.png, new.mtl
//
// Other images of an OBJ, which has no second set of coordinates, are moved likewise:
// new_map_Ks.png. For glTF, base colours are moved (io/gltf_texture.h) and the image is put into
// the file; other textures stay as they are, with the old coordinates.
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
  std::string keyword;                 // map_Kd, for glTF too
  Transfer transfer = Transfer::Srgb;  // Linear: numbers, not colours
  std::vector<Raster> images;          // materials without an image have one of one pixel
  std::vector<Wraps> wraps;            // by image
  std::vector<int> image_of_polygon;   // by polygon
};

struct ModelTexture {
  TextureLayer color;
  std::vector<TextureLayer> others;   // layers of an OBJ besides the colours
  std::vector<std::string> files;     // file names of the images
  std::vector<std::string> lines;     // of all material files of an OBJ
  std::vector<std::string> warnings;  // about images that are not moved
};

// The images to read: colours only, or also the other layers of an OBJ.
enum class Layers { Color, All };

// Returns the texture of the polygons; none if they have no texture coordinates or no image is
// shown by them. Only OBJ and glTF have textures. Throws Error(Unsupported) for a transformed
// texture (-s, -o, -t; KHR_texture_transform); Error(Unreadable) for unreadable files; Stopped.
std::optional<ModelTexture> find_texture(const PolygonMesh& polygons, Layers layers,
                                         const StopCheck& stop = {});
// Reads all layers. Throws Error(Unsupported) if there is no texture.
ModelTexture read_texture(const PolygonMesh& polygons, const StopCheck& stop = {});
// Returns the image files (map_Kd) that an OBJ shows; none if its libraries cannot be read.
std::vector<std::string> shown_pictures(const PolygonMesh& polygons);

// Returns whether models with this extension hold textures: .obj, .glb, .gltf.
bool may_have_texture(const std::string& model);
// Return the names of the image and of the material file beside an OBJ.
std::string texture_file(const std::string& obj);
std::string material_file(const std::string& obj);
// Returns the names of the images of the other layers.
std::vector<std::string> layer_files(const std::string& obj, const ModelTexture& texture);
// Returns the polygons with materials from that file, for an output `obj`.
PolygonMesh with_material_file(PolygonMesh polygons, const std::string& obj);

// The arguments of write_map().
struct LayoutOfModel {
  const MapFile& map;
  const PolygonMesh& polygons;
  const MapFormats& formats;
  const FileVerification& verify;
};
// Writes an OBJ or glTF as write_map() does, reads it back, and bakes the texture `old` into its
// layout. The texture goes to the image and the material file, or into the glTF. side: pixels of
// the image; none: as many as all images together, at least the longest side. The model gets its
// name last, so that it appears complete or not at all. Throws the errors of write_map() and
// BakeJob::run(). Throws Error(Invalid) if the layout is not proven; Error(Usage) for a glTF that
// is no regular file, and for an image that would replace one that is read.
void write_textured(const std::string& path, const LayoutOfModel& layout, const PolygonMesh& old,
                    ModelTexture texture, std::optional<int> side, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
