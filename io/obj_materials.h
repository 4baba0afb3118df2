// The materials of an OBJ, from its material libraries (.mtl), and the material of each polygon.
//
//   const PolygonMesh cup = read_mesh("cup.obj");
//   const ObjMaterials all = read_obj_materials(cup);
//   const std::string& name = all.names[to_size(all.of_polygon[12])];
//   const ObjMaterial* wood = all.find(name);          // null: no library has it
//   if (wood && wood->image("map_Kd")) std::cout << wood->image("map_Kd")->file << "\n";
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

// An image of a material and how it is shown.
struct ObjImage {
  std::string file;           // a path
  bool clamps = false;        // -clamp on
  double base = 0, gain = 1;  // -mm: codes from 0 to 1 mean base + gain * code
  // The reason why the image cannot be shown unchanged or moved to other texture coordinates:
  // transforms (-s, -o, -t), other options, or a file elsewhere. Empty: none.
  std::string refusal = {};

  bool operator==(const ObjImage&) const = default;
};

struct ObjMaterial {
  std::array<float, 3> color{1, 1, 1};                  // Kd, sRGB codes
  float opacity = 1;                                    // d, or 1 - Tr
  std::map<std::string, ObjImage, std::less<>> images;  // by keyword, as map_Kd

  // Returns null if there is none.
  const ObjImage* image(std::string_view keyword) const;
};

struct ObjMaterials {
  std::vector<std::string> lines;  // of all libraries
  std::map<std::string, ObjMaterial, std::less<>> materials;
  std::vector<std::string> names;  // of the materials in use, by first polygon; "": no material
  std::vector<int> of_polygon;     // by polygon: index into names

  const ObjMaterial* find(std::string_view name) const;
};

// Returns the paths of the libraries that an OBJ names. Throws Error(Unsupported) for those in
// other folders.
std::vector<std::string> material_libraries(const PolygonMesh& mesh);

// mesh: read from OBJ; other formats have no libraries. Throws Error(Unsupported) for libraries in
// other folders, Error(Unreadable) for unreadable ones; Stopped. Files of images are not read.
ObjMaterials read_obj_materials(const PolygonMesh& mesh, const StopCheck& stop = {});

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
