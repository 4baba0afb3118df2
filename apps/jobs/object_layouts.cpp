#include "majorant/apps/jobs/object_layouts.h"

#include <fmt/format.h>

#include <exception>
#include <utility>

namespace majorant {

namespace {

Json object_section(const std::string& name, const Json& report) {
  Json section{{"name", name}};
  for (const char* const key : {"status", "input", "repairs", "result", "charts"})
    section[key] = report[key];
  return section;
}

// Adds the seconds of an object. The time of reading is counted once for all objects.
void add_seconds(const Json& of_object, Json& all) {
  for (const auto& [stage, seconds] : of_object.items())
    if (stage != "read") all[stage] = all.value(stage, 0.0) + seconds.get<double>();
}

}  // namespace

void UnwrappedObjects::add(Status of_object, const std::string& why) {
  if (worse_of(status, of_object) == status) return;
  status = of_object;
  message = why;
}

UnwrappedObjects unwrap_objects(const PolygonMesh& polygons, RunRecord& record,
                                const std::function<void(PolygonMesh, AtlasJob&)>& unwrap) {
  UnwrappedObjects all;
  const MeshObjects objects = objects_of(polygons);
  for (Index k = 0; k < objects.count(); ++k) {
    if (k > 0) record.begin_pass();
    const std::string& name = objects.names[to_size(k)];
    ObjectMesh object = object_mesh(polygons, objects, k);
    object.mesh.file = fmt::format(
        "{}{}{}", polygons.file, polygons.file.empty() ? "" : ": ",
        name.empty() ? fmt::format("object {}", k + 1) : fmt::format("object '{}'", name));
    AtlasJob job(record);
    try {
      if (!all.layouts.empty()) record.start_stop().poll();
      unwrap(object.mesh, job);
    } catch (const std::exception&) {
      const Directive why = record.start_stop()();
      if (all.layouts.empty() || why == Directive::Continue) throw;
      all.add(stopped_status(why), fmt::format("{} of {} objects have no map yet",
                                               objects.count() - k, objects.count()));
      all.is_complete = all.layouts.back().map.is_complete = false;
      break;
    }
    const Json report = to_json(atlas_report(job));
    const Status status = job.atlas.status();
    all.add(status, job.atlas.message());
    all.is_complete &= job.atlas.is_complete();
    all.sections.push_back(object_section(name, report));
    add_seconds(report["seconds"], all.seconds);
    all.options_json = job.options_json;
    if (status != Status::Failed) all.layouts.push_back({name, atlas_file(job), std::move(object)});
  }
  return all;
}

RunReport objects_report(const UnwrappedObjects& objects, const PolygonMesh& polygons) {
  RunReport report{.command = "unwrap",
                   .status = std::string(status_name(objects.status)),
                   .message = objects.message,
                   .input = {{"file", polygons.file}},
                   .options = objects.options_json,
                   .warnings = polygons.warnings,
                   .seconds = objects.seconds};
  report.more["objects"] = objects.sections;
  return report;
}

MapFile map_of_objects(std::vector<ObjectLayout> layouts) {
  std::vector<MapFile> maps;
  Json objects = Json::array();
  for (ObjectLayout& layout : layouts) {
    MapFile& map = maps.emplace_back(std::move(layout.map));
    for (int& v : map.input_vertex)
      if (v >= 0) v = layout.object.vertices[to_size(v)];
    for (int& face : map.input_face) face = layout.object.polygons[to_size(face)];
    map.distortion.resize(0);
    map.min_det.resize(0);
    map.face_distortion = FaceDistortion();
    objects.push_back(
        {{"name", layout.name}, {"charts", map.chart.size() > 0 ? map.chart.maxCoeff() + 1 : 1}});
  }
  MapFile file = joined(maps);
  Json claims{{"version", MAJORANT_VERSION}, {"objects", objects}};
  if (!file.is_complete) claims["complete"] = false;
  file.claims = json_text(claims);
  return file;
}

FileVerification proof_of_objects(const std::string& path, const PolygonMesh& surface) {
  ProofRequest request;
  request.surface = &surface;
  request.cuts = CutRule::Free;
  request.overlap = ProofRequest::Overlap::Forbidden;
  return certification_of_objects(path, request);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
