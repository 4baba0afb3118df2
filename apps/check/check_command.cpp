// majorant check RESULT: proves and measures a finished map again, from the file alone. The file's
// claims only describe; proofs use points and uv alone (certify/map_proof.h). For a quad mesh
// without texture coordinates it decides whether the file is a quad mesh of its surface
// (quads/check_quads.h).
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "apps/check/check_request.h"
#include "apps/command.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "majorant/apps/jobs/check_map.h"
#include "majorant/apps/jobs/quad_job.h"
#include "majorant/apps/jobs/quad_report.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/io.h"
#include "majorant/io/mesh_objects.h"
#include "majorant/io/read_mesh.h"
#include "majorant/mesh/repair.h"
#include "majorant/pictures/large_page.h"
#include "majorant/quads/check_quads.h"

namespace majorant::app {
namespace {

Made made_of(const CheckVerb& request, const MapFile& file, const MapCheck& check) {
  Made made{.report = check.report};
  made.report.options = request.to_json();
  made.verdict = one_line(verdict_of(request, file, check)) + "\n";
  made.is_verdict_news = !check.findings.list().empty();
  for (const std::string& path : request.outputs)
    made.files.push_back({path, [&, path] {
                            const std::string note = write_page_or_coarser(
                                path, checked_page(file, check, {request.result, request.surface}));
                            if (!request.common.quiet && !note.empty()) say("{}: {}\n", path, note);
                          }});
  if (const std::string& path = request.distortion; !path.empty())
    made.files.push_back(
        {path, [&, path] { write_distortion(path, file, measure_distortion(file).faces); }});
  return made;
}

// Returns whether the format can hold meshes other than maps.
bool may_be_quads(const CheckVerb& request) {
  return request.quads || !is_for(FormatUse::ReadMap, request.result);
}

bool is_of_quads(const PolygonMesh& mesh) {
  return mesh.texcoords.empty() &&
         std::all_of(mesh.polygons.begin(), mesh.polygons.end(),
                     [](const auto polygon) { return polygon.size() == 4; });
}

Made quads_verdict(const CheckVerb& request, const PolygonMesh& quads, const PolygonMesh* polygons,
                   Run& run) {
  Stopwatch watch;
  run.record().begin(Activity::Proving);
  const auto with = polygons ? QuadsComparedWith::Surface : QuadsComparedWith::Nothing;
  const QuadCheck check = run.make("checking " + request.result, [&] {
    if (!polygons) return check_quads(quads, nullptr, {}, run.stop());
    const RepairedSurface surface = surface_for_quads(*polygons, run.stop());
    std::vector<char> features;
    if (!request.features.empty())
      features = features_of(request.features, *polygons, surface, run.stop());
    QuadCheck found = check_quads(quads, surface.mesh.get(), features, run.stop(),
                                  request.border_corners.value_or(kCornerTurn));
    require_near(found, *surface.mesh, request.max_distance.value_or(kMaxQuadDistance));
    return found;
  });
  const auto features =
      request.features.empty() ? QuadsFeatures::NotRequested : QuadsFeatures::Requested;
  Made made{.report = {.status = check.is_valid() ? "valid" : "invalid",
                       .message = describe(check, with),
                       .input = {{"file", request.result}},
                       .options = request.to_json(),
                       .result = {{"quads", quads_section(quads, check, with, features)}},
                       .warnings = quads.warnings,
                       .seconds = {{"check", watch.restart()}}}};
  made.verdict =
      one_line(fmt::format("{}: {}: {}", request.result, made.report.status, made.report.message)) +
      "\n";
  made.is_verdict_news = !check.is_valid();
  return made;
}

// Returns the object of each cell, if objects have separate layouts.
std::vector<Index> layers_of(const CheckVerb& request, const PolygonMesh* mesh,
                             const MapFile& file) {
  if (request.objects == "together") return {};
  if (mesh != nullptr) return object_of_cells(objects_of(*mesh), file);
  std::optional<std::vector<Index>> claimed = claimed_object_of_cells(file, request.result);
  if (!claimed)
    throw Error(ErrorKind::Usage,
                "--objects separate: needs an .obj, .glb or .gltf, or a .vtu that claims objects; "
                "leave it out");
  return *std::move(claimed);
}

// The files of a run and the results of their checks, from which all outputs are written.
struct Checked {
  std::optional<PolygonMesh> surface, mesh;
  MapFile file;
  std::optional<MapCheck> check;
};

Made verdict(const CheckVerb& request, Checked& c, Run& run) {
  const auto read = [&](const std::string& path, const auto& reader) {
    return run.read(path, [&] { return reader(path, run.stop(), request.common.strictness()); });
  };
  const auto read_surface = [&] {
    if (request.surface.empty()) return;
    c.surface = read(request.surface, read_mesh);
    say_warnings(c.surface->warnings);
  };
  if (may_be_quads(request))
    c.mesh =
        read(request.result, [&](const std::string& path, const StopCheck& stop, Strictness s) {
          const Strictness strictness = std::max(s, Strictness::Texcoords);
          return request.quads ? read_quads(path, stop, strictness)
                               : read_mesh(path, stop, strictness);
        });
  if (c.mesh && (request.quads || is_of_quads(*c.mesh))) {
    if (!request.features.empty() && request.surface.empty())
      throw Error(ErrorKind::Usage, "--features: refers to --surface; give both");
    if (request.max_distance && request.surface.empty())
      throw Error(ErrorKind::Usage, "--max-distance: refers to --surface; give both");
    if (request.border_corners && request.surface.empty())
      throw Error(ErrorKind::Usage, "--border-corners: refers to --surface; give both");
    request.require_of_quads();
    say_warnings(c.mesh->warnings);
    read_surface();
    return quads_verdict(request, *c.mesh, c.surface ? &*c.surface : nullptr, run);
  }
  for (const auto& [flag, number] : {std::pair("--max-distance", request.max_distance),
                                     std::pair("--border-corners", request.border_corners)})
    if (number)
      throw Error(ErrorKind::Usage,
                  fmt::format("{}: applies to quad meshes, and {} is not one; leave it out", flag,
                              request.result));
  if (!request.features.empty())
    throw Error(ErrorKind::Usage,
                fmt::format("--features: applies to quad meshes, and {} is not one; leave it out",
                            request.result));
  c.file = c.mesh ? to_map_file(*c.mesh) : read(request.result, read_map);
  const std::vector<Index> layers = layers_of(request, c.mesh ? &*c.mesh : nullptr, c.file);
  c.mesh.reset();
  say_warnings(c.file.warnings);
  read_surface();
  Stopwatch watch;
  c.check.emplace(c.file,
                  CheckRequest{.name = request.result,
                               .surface = c.surface ? &*c.surface : nullptr,
                               .cuts = request.cut_rule(),
                               .certify = request.certify,
                               .seamless = request.seamless,
                               .stacked = request.stacked,
                               .layers = layers,
                               .reported = run.has_report() || !request.outputs.empty()},
                  run.record());
  c.check->report.seconds["check"] = watch.restart();
  return made_of(request, c.file, *c.check);
}

int check(const CheckVerb& request) {
  const RunPlan plan{.command = "check",
                     .common = request.common,
                     .inputs = {request.result, request.surface, feature_file(request.features)},
                     .outputs = {{request.outputs, {".html"}}, {{request.distortion}, {".csv"}}},
                     .stages = {Activity::Reading, Activity::Proving, Activity::Measuring},
                     .time_limit = request.time_limit,
                     .with_result = {Activity::Proving, Activity::Measuring, Activity::Writing}};
  Checked checked;
  return run_verb(plan, [&](Run& run) { return verdict(request, checked, run); });
}

}  // namespace

void add_check(CLI::App& app, Action* run) {
  auto request = std::make_shared<CheckVerb>();
  CLI::App& verb = *app.add_subcommand("check", "measure a finished map and test its claims");
  request->add_to(verb);
  verb.footer("Example: majorant check bunny.vtu --surface bunny.obj --report check.json");
  verb.callback([request, run] { *run = [request] { return check(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
