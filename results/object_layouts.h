// Layouts of the objects of a file, each made as if the object were alone in it, as one map of the
// file: they lie on each other, in the unit square.
//
//   const MeshObjects objects = objects_of(polygons);
//   std::vector<ObjectLayout> layouts;
//   for (Index k = 0; k < objects.count(); ++k) {
//     ObjectMesh object = object_mesh(polygons, objects, k);
//     AtlasJob job(record);
//     job.open(object.mesh, {});
//     ...
//     layouts.push_back({objects.names[k], atlas_file(job), std::move(object)});
//   }
//   const MapFile file = map_of_objects(std::move(layouts));
//   write_map("out.obj", file, &polygons, {}, proof_of_objects("out.obj", polygons));
#pragma once

#include <string>
#include <vector>

#include "majorant/io/io.h"
#include "majorant/io/mesh_objects.h"
#include "majorant/parametrization/maps/map_file.h"
#include "majorant/results/atlas_job.h"

namespace majorant {

struct ObjectLayout {
  std::string name;
  MapFile map;
  ObjectMesh object;
};

// {"name", "status", "input", "repairs", "result", "charts"}: what a report has of an object.
Json object_section(const std::string& name, const AtlasJob& job);

// Charts are numbered on from object to object, as the claim `objects` says. No measures: scales
// differ. layouts: at least one, of one degree.
MapFile map_of_objects(std::vector<ObjectLayout> layouts);

// That a file is a map of the surface, and that no two charts of one object overlap. Of an .obj,
// .glb, .gltf or .vtu: others have no objects.
FileVerification proof_of_objects(const std::string& path, const PolygonMesh& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
