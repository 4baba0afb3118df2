// majorant check RESULT: proves and measures a finished map again, from the file alone. Claims of
// the file describe; what is proven is decided from points and uv (certify/map_proof.h). Of a mesh
// of quads without texture coordinates: whether it is a quad mesh of its surface
// (quads/check_quads.h).
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
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
#include "majorant/quads/check_quads.h"

namespace majorant::app {
namespace {

struct Request {
  CommonOptions common;
  std::string result, surface, distortion, features;
  std::string cuts = "auto", objects = "together";
  std::vector<std::string> outputs;  // pages
  double time_limit = std::numeric_limits<double>::infinity();
  bool certify = false, seamless = false, quads = false, stacked = false;
};

Json options_of(const Request& request) {
  return {{"surface", request.surface},     {"cuts", request.cuts},
          {"certify", request.certify},     {"seamless", request.seamless},
          {"stacked", request.stacked},     {"objects", request.objects},
          {"quads", request.quads},         {"features", request.features},
          {"strict", request.common.strict}};
}

CheckRequest::Cuts cuts_of(const std::string& word) {
  if (word == "free") return CheckRequest::Cuts::Free;
  return word == "none" ? CheckRequest::Cuts::None : CheckRequest::Cuts::Auto;
}

// "no overlaps, 3 charts (45 cut edges, length 3.21); proven: positive (486 cells), ...; not asked:
// surface (--surface)".
std::string in_words(const MapCheck& check) {
  const MapProof& proof = check.proof;
  // Found out whether that was asked or not.
  std::string text = check.report.result["overlaps"].get<std::string>() + check.overlap_in_words();
  if (const CutCount& cuts = proof.cuts; cuts.others > 0)
    text += fmt::format(", {} ({}, length {:.4g}{})", count_text(cuts.charts, "chart"),
                        count_text(cuts.others, "cut edge"), cuts.length,
                        check.has_untold_cuts ? ", not told from tears" : "");
  if (const StackedCharts& stacks = proof.stacks; stacks.stacks > 0)
    text += fmt::format(", {} of {}, {} mirrored", count_text(stacks.stacks, "stack"),
                        count_text(stacks.stacked, "chart"), stacks.mirrored);
  std::string proven, open;
  for (const auto& [question, finding] : proof.findings()) {
    if (finding->answer == ProofStatus::Proven)
      proven += fmt::format("{}{} ({})", proven.empty() ? "" : ", ", question, finding->detail);
    if (finding->answer == ProofStatus::NotAsked && question == "surface")
      open = "; not asked: surface (--surface)";
  }
  return fmt::format("{}; proven: {}{}", text, proven, open);
}

// One line: "FILE: valid, degree 3: ...", "FILE: invalid: ..." or "FILE: undecided: ...".
std::string verdict_of(const Request& request, const MapFile& file, const MapCheck& check) {
  const std::vector<std::string>& list = check.findings.list();
  if (list.empty())
    return fmt::format("{}: valid, degree {}: {}; {}{}", request.result, file.degree,
                       in_words(check), describe(check.energy), seam_summary(check.report.result));
  const bool is_torn = check.proof.continuous.answer == ProofStatus::Violated;
  return fmt::format("{}: {}: {}{}{}", request.result, check.status(), fmt::join(list, "; "),
                     check.overlap_in_words(),
                     is_torn ? "; if the map is meant to be cut there, add --cuts free" : "");
}

Made made_of(const Request& request, const MapFile& file, const MapCheck& check) {
  Made made{.report = check.report};
  made.report.options = options_of(request);
  made.verdict = one_line(verdict_of(request, file, check)) + "\n";
  made.is_verdict_news = !check.findings.list().empty();
  for (const std::string& path : request.outputs)
    made.files.push_back(
        {path, [&, path] {
           write_page(path, checked_page(file, check, {request.result, request.surface}));
         }});
  if (const std::string& path = request.distortion; !path.empty())
    made.files.push_back(
        {path, [&, path] { write_distortion(path, file, measure_distortion(file).faces); }});
  return made;
}

// Formats in which a mesh can be something else than a map.
bool may_be_quads(const Request& request) {
  const std::string format = format_of(request.result);
  return request.quads || (format != ".vtu" && format != ".pvtu" && format != ".msh");
}

bool is_of_quads(const PolygonMesh& mesh) {
  return mesh.texcoords.empty() &&
         std::all_of(mesh.polygons.begin(), mesh.polygons.end(),
                     [](const auto polygon) { return polygon.size() == 4; });
}

void require_of_maps(const Request& request) {
  const auto refuse = [&](std::string_view flag) {
    throw Error(ErrorKind::Usage,
                fmt::format("{}: is of maps, and {} is a mesh of quads; leave it out", flag,
                            request.result));
  };
  if (request.seamless) refuse("--seamless");
  if (request.certify) refuse("--certify");
  if (request.stacked) refuse("--stacked");
  if (request.objects != "together") refuse("--objects");
  if (request.cuts != "auto") refuse("--cuts");
  if (!request.distortion.empty()) refuse("--distortion");
  if (!request.outputs.empty()) refuse("-o");
}

Made quads_verdict(const Request& request, const PolygonMesh& quads, const PolygonMesh* polygons,
                   Run& run) {
  Stopwatch watch;
  run.record().begin(Activity::Proving);
  const auto with = polygons ? QuadsComparedWith::Surface : QuadsComparedWith::Nothing;
  const QuadCheck check = run.make("checking " + request.result, [&] {
    if (!polygons) return check_quads(quads, nullptr, {}, run.stop());
    const RepairedSurface surface =
        repair(*polygons, {.welding = Welding::EqualPlaces}, run.stop());
    std::vector<char> features;
    if (!request.features.empty())
      features = features_of(request.features, *polygons, surface, run.stop());
    return check_quads(quads, surface.mesh.get(), features, run.stop());
  });
  const auto features =
      request.features.empty() ? QuadsFeatures::NotRequested : QuadsFeatures::Requested;
  Made made{.report = {.status = check.is_valid() ? "valid" : "invalid",
                       .message = describe(check, with),
                       .input = {{"file", request.result}},
                       .options = options_of(request),
                       .result = {{"quads", quads_section(check, with, features)}},
                       .warnings = quads.warnings,
                       .seconds = {{"check", watch.restart()}}}};
  made.verdict =
      one_line(fmt::format("{}: {}: {}", request.result, made.report.status, made.report.message)) +
      "\n";
  made.is_verdict_news = !check.is_valid();
  return made;
}

// Returns the object of each cell, where objects have layouts of their own.
std::vector<Index> layers_of(const Request& request, const PolygonMesh* mesh, const MapFile& file) {
  if (request.objects == "together") return {};
  if (mesh != nullptr) return object_of_cells(objects_of(*mesh), file);
  std::optional<std::vector<Index>> claimed = claimed_object_of_cells(file, request.result);
  if (!claimed)
    throw Error(ErrorKind::Usage,
                "--objects separate: objects are of .obj, .glb and .gltf, and of a .vtu that "
                "claims them; leave it out");
  return *std::move(claimed);
}

// The files of a run, and what is found of them: files and pages are written from these.
struct Checked {
  std::optional<PolygonMesh> surface, mesh;
  MapFile file;
  std::optional<MapCheck> check;
};

Made verdict(const Request& request, Checked& c, Run& run) {
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
      throw Error(ErrorKind::Usage, "--features: are those of --surface; give both");
    require_of_maps(request);
    say_warnings(c.mesh->warnings);
    read_surface();
    return quads_verdict(request, *c.mesh, c.surface ? &*c.surface : nullptr, run);
  }
  if (!request.features.empty())
    throw Error(ErrorKind::Usage, fmt::format("--features: is of meshes of quads, and {} is none; "
                                              "leave it out",
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
                               .cuts = cuts_of(request.cuts),
                               .certify = request.certify,
                               .seamless = request.seamless,
                               .stacked = request.stacked,
                               .layers = layers,
                               .reported = run.has_report() || !request.outputs.empty()},
                  run.record());
  c.check->report.seconds["check"] = watch.restart();
  return made_of(request, c.file, *c.check);
}

int check(const Request& request) {
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
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand("check", "measure a finished map and test its claims");
  Request& r = *request;
  constexpr double kAnySeconds = std::numeric_limits<double>::infinity();
  add_options(verb, OptionGroup::Files,
              {{"result",
                &r.result,
                "result: .vtu, .msh, or .obj, .ply, .glb or .gltf with texture coordinates",
                {.required = true}},
               {"--surface", &r.surface, "the mesh it should be a map of", {.type = "FILE"}},
               {"-o,--output",
                &r.outputs,
                "the map and what is wrong with it as a page: .html, repeatable",
                {.type = "FILE"}}});
  add_options(
      verb, OptionGroup::Map,
      {{"--cuts",
        &r.cuts,
        "inner edges whose sides differ: none: violations; free: counted; auto (default): "
        "violations but where the file says that it is cut, and counted where it says nothing",
        {.check = one_of({"auto", "none", "free"})}},
       {"--seamless", &r.seamless,
        "the map is seamless, its seams are no cuts (implied where the file claims it)"},
       {"--stacked", &r.stacked,
        "charts may lie exactly on others, mirrored ones, too: counted, no overlaps (implied where "
        "the file claims it)"},
       {"--objects",
        &r.objects,
        "separate: each object of an OBJ (o), mesh of a glTF or object that a VTU claims has a "
        "layout of its own, which may lie on those of others; together (default): there is one",
        {.check = one_of({"together", "separate"}), .excludes = {"--stacked"}}},
       {"--time-limit",
        &r.time_limit,
        "seconds; what is not decided by then is said to be undecided",
        {.check = non_negative_number(kAnySeconds)}}});
  add_options(verb, OptionGroup::Files, {distortion_option(&r.distortion)});
  add_options(
      verb, OptionGroup::Map,
      {{"--quads", &r.quads,
        "a mesh of quads (implied where a file has nothing but quads, and no texture coordinates): "
        "oriented manifold, none folded; with --surface none turned, Euler characteristic and "
        "border of the surface"},
       {"--features",
        &r.features,
        "of meshes of quads: feature lines of --surface that edges of quads must cover, as `quads` "
        "has them",
        {.type = "DEG|FILE|none"}},
       {"--certify", &r.certify, "prove global injectivity as well"}});
  request->common.add_to(verb);
  verb.footer("Example: majorant check bunny.vtu --surface bunny.obj --report check.json");
  verb.callback([request, run] { *run = [request] { return check(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
