// The unchecked content of a mesh file: polygons over positions, with the lines on which they are.
//
//   PolygonMesh quad;
//   quad.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
//   quad.polygons = {{0, 1, 2, 3}};
//   const SurfaceMesh mesh = SurfaceMesh::from_polygons(quad);
//
// Readers (io/) guarantee that numbers are finite, indices are in range and polygons have at least
// three corners, and nothing else. Not for geometry: SurfaceMesh (surface_mesh.h) validates it,
// repair() (repair.h) makes a surface of defective polygons.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/index_lists.h"

namespace majorant {

// Coordinates count as equal if they differ by less than this part of the size of a file's content:
// programs print ten digits or more, and sums lose one.
inline constexpr double kTenDigits = 1e-9;

struct GltfScene;  // of io/

struct PolygonMesh {
  std::string file;                 // for messages; may be empty
  std::vector<Vector3> positions;   // #V, model units
  double position_rounding = 0;     // #V error bound of each position; 0 unless the file has floats
  IndexLists polygons;              // #P lists of >= 3 vertex indices, 0-based
  std::vector<long> polygon_lines;  // #P line (or record) numbers, 1-based; may be empty

  std::vector<Vector2> texcoords;          // #T; may be empty
  std::vector<Vector2> texcoord_rounding;  // #T: error bound of the decimals of the file; empty: 0
  IndexLists polygon_texcoords;            // #P lists parallel to polygons, or empty; a polygon
                                           // without vt has an empty list
  bool has_partial_layout = false;         // true: a stopped run has not mapped the polygons
                                           // without vt

  // Contents that an OBJ writer writes unchanged; colours from OBJ and PLY.
  std::vector<Vector3>
      colors;  // #V, red green blue in 0..1, NaN for vertices without; may be empty
  std::vector<Vector3> normals;
  IndexLists polygon_normals;  // like polygon_texcoords
  std::vector<std::pair<Index, std::string>>
      directives;  // (polygon it precedes, line); "v 8": here the file has 8 vertices
  std::shared_ptr<const GltfScene> gltf;  // the whole content of a glTF file, for its writer

  Index faces_missing = 0;  // missing from those that the file's header announces

  // Parts of the file that a reader left out, one sentence each that begins with file and line; the
  // program shows them.
  std::vector<std::string> warnings;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
