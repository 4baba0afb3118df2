// Reads OBJ files of triangles without io/: "v x y z" and "f a/.. b/.. c/.."; other lines are
// ignored.
#pragma once

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "mesh/test_meshes.h"

namespace majorant {

inline PolygonMesh obj_file(const std::string& path) {
  PolygonMesh mesh;
  mesh.file = path;
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  std::string line;
  for (long number = 1; std::getline(file, line); ++number) {
    std::istringstream words(line);
    std::string kind, word;
    words >> kind;
    if (kind == "v") {
      Vector3 p;
      words >> p.x() >> p.y() >> p.z();
      mesh.positions.push_back(p);
    } else if (kind == "f") {
      std::vector<Index> polygon;
      while (words >> word) polygon.push_back(std::atoi(word.c_str()) - 1);
      mesh.polygons.push_back(polygon);
      mesh.polygon_lines.push_back(number);
    }
  }
  return mesh;
}

// Returns a mesh of examples/meshes/, all of which are disks.
inline std::shared_ptr<const SurfaceMesh> generated(const std::string& name) {
  std::string path = MAJORANT_SOURCE_DIR "/examples/meshes/";
  path += name;
  path += ".obj";
  return surface(obj_file(path));
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
