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

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "apps/arguments/suggestion.h"
#include "apps/command.h"
#include "apps/or_interrupted.h"
#include "apps/outputs.h"
#include "apps/page_content.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/streams.h"
#include "apps/within_memory.h"
#include "majorant/certify/map_proof.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/input_file.h"
#include "majorant/io/io.h"
#include "majorant/io/mesh_objects.h"
#include "majorant/io/read_mesh.h"
#include "majorant/io/waiting_output.h"
#include "majorant/mesh/repair.h"
#include "majorant/quads/check_quads.h"
#include "majorant/results/check_map.h"
#include "majorant/results/quad_job.h"
#include "majorant/results/quad_report.h"

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

CheckRequest::Cuts cuts_of(const std::string& said) {
  if (said == "free") return CheckRequest::Cuts::Free;
  return said == "none" ? CheckRequest::Cuts::None : CheckRequest::Cuts::Auto;
}

// "no overlaps, 3 charts (45 cut edges, length 3.21); proven: positive (486 cells), ...; not asked:
// surface (--surface)".
std::string in_words(const MapCheck& check) {
  const MapProof& proof = check.proof;
  // Found out whether that was asked or not.
  std::string text =
      check.report["result"]["overlaps"].get<std::string>() + check.overlap_in_words();
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
                       in_words(check), describe(check.energy),
                       seam_summary(check.report["result"]));
  const bool is_torn = check.proof.continuous.answer == ProofStatus::Violated;
  return fmt::format("{}: {}: {}{}{}", request.result, check.status(), fmt::join(list, "; "),
                     check.overlap_in_words(),
                     is_torn ? "; if the map is meant to be cut there, add --cuts free" : "");
}

// The verdict is data: on stdout, where the report is not.
int conclude(const Request& request, const MapFile& file, const MapCheck& check) {
  const bool is_valid = check.findings.list().empty();
  if (!is_valid || !request.common.quiet) {
    const std::string line = one_line(verdict_of(request, file, check)) + "\n";
    request.common.report == kStandardOutput ? say_text(line) : print_text(line);
  }
  WrittenFiles written;
  const std::string& report = request.common.report;
  for (const std::string& path : request.outputs)
    written.write(path, [&] {
      write_page(path, checked_page(file, check, {request.result, request.surface}));
    });
  if (const std::string& path = request.distortion; !path.empty())
    written.write(path, [&] { write_distortion(path, file, measure_distortion(file).faces); });
  if (!report.empty()) written.write(report, [&] { write_json(report, check.report); });
  return written.conclude(is_valid ? kSuccess : kInvalid);
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

int check_as_quads(const Request& request, const PolygonMesh& quads, const PolygonMesh* polygons,
                   const RunRecord& record, Progress& progress) {
  record.begin(Activity::Proving);
  const auto with = polygons ? QuadsComparedWith::Surface : QuadsComparedWith::Nothing;
  const QuadCheck check = or_interrupted("checking " + request.result, [&] {
    if (!polygons) return check_quads(quads, nullptr, {}, record.stop());
    const RepairedSurface surface =
        repair(*polygons, {.welding = Welding::EqualPlaces}, record.stop());
    std::vector<char> features;
    if (!request.features.empty())
      features = features_of(request.features, *polygons, surface, record.stop());
    return check_quads(quads, surface.mesh.get(), features, record.stop());
  });
  progress.finish();
  const std::string_view status = check.is_valid() ? "valid" : "invalid";
  const std::string message = describe(check, with);
  if (!check.is_valid() || !request.common.quiet) {
    const std::string line =
        one_line(fmt::format("{}: {}: {}", request.result, status, message)) + "\n";
    request.common.report == kStandardOutput ? say_text(line) : print_text(line);
  }
  WrittenFiles written;
  if (const std::string& path = request.common.report; !path.empty())
    written.write(path, [&] {
      write_json(path, {{"schema_version", 1},
                        {"version", MAJORANT_VERSION},
                        {"command", "check"},
                        {"status", status},
                        {"message", message},
                        {"warnings", quads.warnings},
                        {"quads", quads_section(check, with,
                                                request.features.empty() ? QuadsFeatures::NotAsked
                                                                         : QuadsFeatures::Asked)}});
    });
  return written.conclude(check.is_valid() ? kSuccess : kInvalid);
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

int check(const Request& request) {
  require_writable(request.common, {{request.outputs, {".html"}}, {{request.distortion}, {".csv"}}},
                   {request.result, request.surface, feature_file(request.features)});
  const ThreadCount threads(usable_threads(request.common.threads));
  Progress progress(request.common, {Activity::Reading, Activity::Proving, Activity::Measuring});
  const RunRecord record(request.time_limit, 0, interruption_flag(), &progress);
  const StopCheck& stop = record.stop();
  set_output_stop(stop);
  const auto read = [&](const std::string& path, const auto& reader) {
    return or_interrupted("reading " + path, [&] {
      return within_memory(path, [&] { return reader(path, stop, request.common.strictness()); });
    });
  };
  record.begin(Activity::Reading);
  std::optional<PolygonMesh> surface;
  const auto read_surface = [&] {
    if (request.surface.empty()) return;
    surface = read(request.surface, read_mesh);
    say_warnings(surface->warnings);
  };
  std::optional<PolygonMesh> mesh;
  if (may_be_quads(request))
    mesh = read(request.result, [&](const std::string& path, const StopCheck& asked, Strictness s) {
      const Strictness strictness = std::max(s, Strictness::Texcoords);
      return request.quads ? read_quads(path, asked, strictness)
                           : read_mesh(path, asked, strictness);
    });
  if (mesh && (request.quads || is_of_quads(*mesh))) {
    if (!request.features.empty() && request.surface.empty())
      throw Error(ErrorKind::Usage, "--features: are those of --surface; give both");
    require_of_maps(request);
    say_warnings(mesh->warnings);
    read_surface();
    return check_as_quads(request, *mesh, surface ? &*surface : nullptr, record, progress);
  }
  if (!request.features.empty())
    throw Error(ErrorKind::Usage, fmt::format("--features: is of meshes of quads, and {} is none; "
                                              "leave it out",
                                              request.result));
  const MapFile file = mesh ? to_map_file(*mesh) : read(request.result, read_map);
  const std::vector<Index> layers = layers_of(request, mesh ? &*mesh : nullptr, file);
  mesh.reset();
  say_warnings(file.warnings);
  read_surface();
  const MapCheck check(file,
                       {.name = request.result,
                        .surface = surface ? &*surface : nullptr,
                        .cuts = cuts_of(request.cuts),
                        .certify = request.certify,
                        .seamless = request.seamless,
                        .stacked = request.stacked,
                        .layers = layers,
                        .reported = !request.common.report.empty() || !request.outputs.empty()},
                       record);
  progress.finish();
  return conclude(request, file, check);
}

}  // namespace

void add_check(CLI::App& app, Action* run) {
  auto request = std::make_shared<Request>();
  CLI::App& verb = *app.add_subcommand("check", "measure a finished map and test its claims");
  begin_group(verb, OptionGroup::Files);
  verb.add_option("result", request->result,
                  "result: .vtu, .msh, or .obj, .ply, .glb or .gltf with texture coordinates")
      ->required();
  verb.add_option("--surface", request->surface, "the mesh it should be a map of")
      ->type_name("FILE");
  verb.add_option("-o,--output", request->outputs,
                  "the map and what is wrong with it as a page: .html, repeatable")
      ->type_name("FILE")
      ->allow_extra_args(false);
  begin_group(verb, OptionGroup::Map);
  verb.add_option("--cuts", request->cuts,
                  "inner edges whose sides differ: none: violations; free: counted; auto "
                  "(default): violations but where the file says that it is cut, and counted "
                  "where it says nothing")
      ->check(one_of({"auto", "none", "free"}));
  verb.add_flag("--seamless", request->seamless,
                "the map is seamless, its seams are no cuts (implied where the file claims it)");
  verb.add_flag("--stacked", request->stacked,
                "charts may lie exactly on others, mirrored ones, too: counted, no overlaps "
                "(implied where the file claims it)");
  verb.add_option("--objects", request->objects,
                  "separate: each object of an OBJ (o), mesh of a glTF or object that a VTU claims "
                  "has a layout of its own, which may lie on those of others; together (default): "
                  "there is one")
      ->check(one_of({"together", "separate"}))
      ->excludes("--stacked");
  verb.add_option("--time-limit", request->time_limit,
                  "seconds; what is not decided by then is said to be undecided")
      ->check(non_negative_number(std::numeric_limits<double>::infinity()));
  begin_group(verb, OptionGroup::Files);
  verb.add_option("--distortion", request->distortion,
                  "write a table of stretch, area and angle distortion per face to FILE.csv")
      ->type_name("FILE");
  begin_group(verb, OptionGroup::Map);
  verb.add_flag("--quads", request->quads,
                "a mesh of quads (implied where a file has nothing but quads, and no texture "
                "coordinates): oriented manifold, none folded; with --surface none turned, Euler "
                "characteristic and border of the surface");
  verb.add_option(
          "--features", request->features,
          "of meshes of quads: feature lines of --surface that edges of quads must cover, as "
          "`quads` has them")
      ->type_name("DEG|FILE|none");
  verb.add_flag("--certify", request->certify, "prove global injectivity as well");
  request->common.add_to(verb);
  verb.footer("Example: majorant check bunny.vtu --surface bunny.obj --report check.json");
  verb.callback([request, run] { *run = [request] { return check(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
