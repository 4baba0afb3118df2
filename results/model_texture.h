// The textures of an OBJ, moved to other texture coordinates: one image for all its materials.
//
//   const ObjTexture texture = read_obj_texture(polygons);     // of its mtllib, map_Kd
//   const PolygonMesh moved = with_material_file(polygons, "new.obj");
//   // moved is written to new.obj, with other texture coordinates
//   bake_texture(texture, polygons, "new.obj");                // new.png and new.mtl beside it
//
// Not for GLB, whose textures are inside.
#pragma once

#include <string>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/results/bake_job.h"

namespace majorant {

struct ObjTexture {
  std::vector<Raster> images;         // those of materials without one are of one pixel, Kd
  std::vector<int> image_of_polygon;  // by polygon
  std::vector<std::string> lines;     // of the material files, one after the other
  std::vector<std::string> warnings;  // what is not moved
};

// Throws Error(Unsupported) where the polygons have no texture coordinates, no material file or no
// map_Kd, or one that is scaled or moved (-s, -o, -t); Error(Unreadable) for files that cannot be
// read; Stopped.
ObjTexture read_obj_texture(const PolygonMesh& polygons, const StopCheck& stop = {});

// The image and the material file that stand beside an OBJ of that name.
std::string texture_file(const std::string& obj);
std::string material_file(const std::string& obj);
// The same polygons, whose materials are in that file, written to `obj`.
PolygonMesh with_material_file(PolygonMesh polygons, const std::string& obj);

// Reads `obj` back, bakes into its layout what `old` carries, and writes image and material file.
// As large as the largest texture. Throws as BakeJob::run(), Error(Invalid) where that is not
// proven.
void bake_texture(ObjTexture texture, const PolygonMesh& old, const std::string& obj,
                  const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
