// The objects of a mesh file, and each as a separate mesh: names of `o` in an OBJ, or meshes of a
// glTF file that its nodes show. Other files are one object.
//
//   const PolygonMesh room = read_mesh("room.obj");
//   const MeshObjects objects = objects_of(room);
//   for (Index k = 0; k < objects.count(); ++k)
//     std::cout << objects.names[k] << object_mesh(room, objects, k).mesh.polygons.size() << "\n";
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "majorant/maps/map_file.h"
#include "majorant/mesh/polygon_mesh.h"

namespace majorant {

struct MeshObjects {
  std::vector<std::string> names;  // in the order of their first polygons; "": no name
  std::vector<Index> of_polygon;   // #P

  Index count() const { return static_cast<Index>(names.size()); }
};

// Returns the first word of a line of PolygonMesh::directives, and the rest without surrounding
// spaces.
std::pair<std::string_view, std::string_view> directive_words(std::string_view line);

// Lines `o` with one name are one object; so are the polygons before the first of them.
MeshObjects objects_of(const PolygonMesh& mesh);
// Returns ProofRequest::layers, by cell of to_map_file(mesh), for a file whose objects have
// separate layouts.
std::vector<Index> object_of_cells(const MeshObjects& objects, const MapFile& file);

// Returns the same for a file that claims its objects by their charts; none if it claims none.
// name: for messages. Throws Error(Unreadable) for charts without an object, and the errors of
// parse_claims().
std::optional<std::vector<Index>> claimed_object_of_cells(const MapFile& file,
                                                          const std::string& name);

// One object: its polygons and vertices in the order of the file, with materials, smoothing groups
// and so on. `gltf` is null; there are no points and lines.
struct ObjectMesh {
  PolygonMesh mesh;
  std::vector<Index> vertices, polygons;  // numbers in the file
};
ObjectMesh object_mesh(const PolygonMesh& mesh, const MeshObjects& objects, Index object);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
