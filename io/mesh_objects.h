// The objects of a mesh file, and each as a mesh of its own: what `o` names in an OBJ, the meshes
// of a glTF file, which its nodes show. Other files are one object.
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
  std::vector<std::string> names;  // in the order of their first polygons; "": has none
  std::vector<Index> of_polygon;   // #P

  Index count() const { return static_cast<Index>(names.size()); }
};

// The first word of a line of PolygonMesh::directives, and the rest, without spaces around it.
std::pair<std::string_view, std::string_view> directive_words(std::string_view line);

// Lines `o` of one name are one object, as are the polygons before the first of them.
MeshObjects objects_of(const PolygonMesh& mesh);
// Returns, by cell of to_map_file(mesh), ProofRequest::layers of a file whose objects have layouts
// of their own.
std::vector<Index> object_of_cells(const MeshObjects& objects, const MapFile& file);

// The same of a file that claims its objects by their charts; none where it claims none. name: for
// messages. Throws Error(Unreadable) for charts that are of no object, and as parse_claims().
std::optional<std::vector<Index>> claimed_object_of_cells(const MapFile& file,
                                                          const std::string& name);

// One object: its polygons and their vertices in the order of the file, its materials, smoothing
// groups and so on. `gltf` is null, there are no points and lines.
struct ObjectMesh {
  PolygonMesh mesh;
  std::vector<Index> vertices, polygons;  // in the file, of each of the mesh
};
ObjectMesh object_mesh(const PolygonMesh& mesh, const MeshObjects& objects, Index object);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
