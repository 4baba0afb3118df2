// Layouts of the objects of a file, each made as if the object were alone, written as one map. They
// overlap in the unit square.
//
//   const auto unwrap = [](PolygonMesh object, AtlasJob& job) {
//     job.open(std::move(object), {});
//     job.solve();
//     job.place();
//     job.prove();
//   };
//   UnwrappedObjects objects = unwrap_objects(polygons, record, unwrap);
//   const MapFile file = map_of_objects(std::move(objects.layouts));
//   write_map("out.obj", file, &polygons, {}, proof_of_objects("out.obj", polygons));
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "majorant/apps/jobs/atlas_job.h"
#include "majorant/io/io.h"
#include "majorant/io/mesh_objects.h"
#include "majorant/maps/map_file.h"

namespace majorant {

struct ObjectLayout {
  std::string name;
  MapFile map;
  ObjectMesh object;
};

struct UnwrappedObjects {
  std::vector<ObjectLayout> layouts;  // all except failed ones
  Json sections = Json::array();  // each {"name", "status", "input", "repairs", "result", "charts"}
  Json options_json;              // options of the jobs, for reports
  Json seconds = Json::object();  // by stage, summed over all objects
  bool is_complete = true;        // every chart of every object has a map
  Status status = Status::Converged;  // the worst one of the objects
  std::string message;                // of the first object with that status

  void add(Status of_object, const std::string& why);  // updates status and message
};
// Unwraps one object after the other. unwrap: opens, solves, places and proves the job of a mesh,
// whose name includes the object. If the run is stopped, the finished layouts are returned as
// incomplete.
UnwrappedObjects unwrap_objects(const PolygonMesh& polygons, RunRecord& record,
                                const std::function<void(PolygonMesh, AtlasJob&)>& unwrap);

// Returns the report of all objects, with "objects" in place of "input", "repairs", "result" and
// "charts".
RunReport objects_report(const UnwrappedObjects& objects, const PolygonMesh& polygons);

// Returns all layouts as one map. Charts are numbered consecutively, as the claim `objects` says.
// There are no measures, since scales differ. layouts: at least one, all of one degree.
MapFile map_of_objects(std::vector<ObjectLayout> layouts);

// Returns a proof that a file is a map of the surface, and that no two charts of one object
// overlap. Only .obj, .glb, .gltf and .vtu have objects.
FileVerification proof_of_objects(const std::string& path, const PolygonMesh& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
