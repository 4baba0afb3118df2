// Layouts of the objects of a file, each made as if the object were alone in it, as one map of the
// file: they lie on each other, in the unit square.
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
  std::vector<ObjectLayout> layouts;  // of all but those that failed
  Json sections = Json::array();  // {"name", "status", "input", "repairs", "result", "charts"} each
  Json options_json;              // of the jobs, for reports
  Json seconds = Json::object();  // by stage, of all objects together
  bool is_complete = true;        // every chart of every object has a map
  Status status = Status::Converged;  // the worst of the objects
  std::string message;                // of the first that ended so

  void add(Status of_object, const std::string& why);  // to status and message
};
// One object after the other. unwrap: opens, solves, places and proves the job of a mesh, whose
// name says which object of the file it is. Where the run is stopped after there are layouts, these
// are all, and not complete.
UnwrappedObjects unwrap_objects(const PolygonMesh& polygons, RunRecord& record,
                                const std::function<void(PolygonMesh, AtlasJob&)>& unwrap);

// The report of all objects: "objects" in place of "input", "repairs", "result" and "charts".
RunReport objects_report(const UnwrappedObjects& objects, const PolygonMesh& polygons);

// Charts are numbered on from object to object, as the claim `objects` says. No measures: scales
// differ. layouts: at least one, of one degree.
MapFile map_of_objects(std::vector<ObjectLayout> layouts);

// That a file is a map of the surface, and that no two charts of one object overlap. Of an .obj,
// .glb, .gltf or .vtu: others have no objects.
FileVerification proof_of_objects(const std::string& path, const PolygonMesh& surface);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
