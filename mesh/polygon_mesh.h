// A mesh file as it is, before anything is believed: polygons over positions, with the lines that
// they came from.
//
//   PolygonMesh quad;
//   quad.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
//   quad.polygons = {{0, 1, 2, 3}};
//   const SurfaceMesh mesh = SurfaceMesh::from_polygons(quad);
//
// Readers (io/) guarantee that numbers are finite, every index is in range and every polygon has at
// least three corners, and no more. Not for geometry: SurfaceMesh (surface_mesh.h) validates it,
// repair() (repair.h) makes a surface of what is none.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/mesh/index_lists.h"

namespace majorant {

// Coordinates are the same where they differ by less than this part of the size of a file's
// contents: programs print ten digits and more, and one digit is lost to sums.
inline constexpr double kTenDigits = 1e-9;

struct GltfScene;  // of io/

struct PolygonMesh {
  std::string file;                 // for messages; may be empty
  std::vector<Vector3> positions;   // #V, model units
  double position_rounding = 0;     // how far each may be from what it was made of, where
                                    // the file has floats
  IndexLists polygons;              // #P lists of >= 3 vertex indices, 0-based
  std::vector<long> polygon_lines;  // #P line (or record) numbers, 1-based; may be empty

  std::vector<Vector2> texcoords;          // #T; may be empty
  std::vector<Vector2> texcoord_rounding;  // #T: how far the decimals of the file may be
                                           // from texcoords; empty: not at all
  IndexLists polygon_texcoords;            // #P lists parallel to polygons, or empty; a polygon
                                           // without vt has an empty list
  bool has_partial_layout = false;         // polygons without vt are those that a run which was
                                           // stopped has not mapped: the file says so

  // Contents that an OBJ writer gives back unchanged; from OBJ, colours from PLY too.
  std::vector<Vector3>
      colors;  // #V, red green blue in 0..1, NaN for vertices without; may be empty
  std::vector<Vector3> normals;
  IndexLists polygon_normals;  // like polygon_texcoords
  std::vector<std::pair<Index, std::string>>
      directives;  // (polygon it precedes, line); "v 8": here the file has 8 vertices
  std::shared_ptr<const GltfScene> gltf;  // of a glTF file all that there is, for its writer

  Index faces_missing = 0;  // of those that the file's header announces

  // Parts of the file that a reader left out, a sentence each that begins with file and line, for
  // the program to say.
  std::vector<std::string> warnings;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
