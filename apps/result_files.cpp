#include "apps/result_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "apps/global_verdict.h"
#include "apps/page_content.h"
#include "apps/seam_request.h"
#include "apps/streams.h"
#include "majorant/framework/linear_solver.h"
#include "majorant/framework/thread_count.h"
#include "majorant/io/map_distortion.h"
#include "majorant/io/map_proof.h"

namespace majorant::app {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Json options_section(const FinishedRun& run) {
  Json options = run.map.to_json();
  options.update(run.options);
  return options;
}

Json aligned_section(const FinishedRun& run) {
  if (!run.placement || !run.outputs.turns_map()) return nullptr;
  const Vector2& direction = run.placement->direction;
  return {{"direction", {direction.x(), direction.y()}}};
}

Json normalized_section(const FinishedRun& run) {
  if (!run.placement || !run.outputs.normalize) return nullptr;
  const LayoutPlacement& p = *run.placement;
  return {{"origin", {p.origin.x(), p.origin.y()}}, {"size", p.size}};
}

// What the start was made from: where nobody brought one, what parametrize() chose.
std::string_view start_taken(const FinishedRun& run) {
  if (run.result.start != StartMethod::Given) return start_name(run.result.start);
  // Seams of texture coordinates need not be asked for twice.
  return run.map.init == start_name(StartMethod::Automatic) ? start_name(StartMethod::Given)
                                                            : std::string_view(run.map.init);
}

std::string claims(const FinishedRun& run) {
  const BezierMap& map = *run.result.map;
  Json pins = Json::array();
  for (const Pin& pin : run.in.options.map.pins) {
    const Vector2 uv = map.control_points().segment<2>(2 * pin.vertex);
    pins.push_back({{"vertex", map.mesh().input_vertex(pin.vertex)}, {"target", {uv.x(), uv.y()}}});
  }
  Json claims{{"version", MAJORANT_VERSION},
              {"degree", run.map.degree},
              {"energy", run.map.energy},
              {"value", run.result.measures.value},
              {"boundary", run.map.boundary},
              {"init", start_taken(run)},
              {"seams", !map.seams().trivial()},
              {"bijective", run.in.options.map.injectivity == MapInjectivity::Global},
              {"aligned", aligned_section(run)},
              {"normalized", normalized_section(run)},
              {"pins", pins},
              {"other_triangles", run.result.other_triangles},
              {"options", options_section(run)}};
  if (run.result.measures.cut_short) claims.erase("value");  // not good enough to be claimed
  if (!map.seams().trivial()) claims["cones"] = cones_section(map);
  return json_text(claims);
}

// What a data file of the run must be when it is read back.
ProofRequest promise(const FinishedRun& run, const std::string& path) {
  ProofRequest promise;
  promise.surface = &run.in.polygons;
  if (!run.result.map->seams().trivial()) promise.cuts = CutRule::Seams;
  if (run.in.cuts) promise.cuts = CutRule::Free;
  if (run.in.options.map.injectivity == MapInjectivity::Global)
    promise.overlap = ProofRequest::Overlap::Forbidden;
  if (extension(path) == ".vtu" || extension(path) == ".msh")
    promise.labels = ProofRequest::FaceLabels::Compared;
  return promise;
}

double scale_of(const FinishedRun& run) { return run.placement ? run.placement->size : 1; }

void write_table(const FinishedRun& run, const MapFile& file, WrittenFiles& written) {
  const std::string& path = run.outputs.distortion;
  if (path.empty()) return;
  written.write(path, [&] {
    write_distortion(path, file,
                     run.result.measures.cut_short
                         ? measure_distortion(*run.result.map, scale_of(run)).faces
                         : run.result.measures.distortion.faces);
  });
}

void write_maps(const FinishedRun& run, const Json& report, WrittenFiles& written) {
  MapFile file = to_map_file(*run.result.map);
  if (!run.result.measures.cut_short) file.distortion = run.result.measures.face_value;
  file.min_det = run.result.measures.min_det;
  file.face_distortion = finite_or_none(run.result.measures.distortion.faces);
  file.claims = claims(run);
  FormatOptions formats = run.outputs.formats;
  if (run.in.options.map.injectivity == MapInjectivity::Global)
    formats.tessellation.overlap = Overlap::Excluded;
  std::optional<MapFile> scaffold;
  if (run.result.scaffold)
    scaffold = to_map_file(run.placement.value_or(LayoutPlacement())(*run.result.scaffold));
  formats.svg.scaffold = scaffold;
  if (has_page(run.outputs.files)) formats.page = page_of(run, report);
  formats.page.scaffold = scaffold;
  for (const std::string& path : run.outputs.files) {
    if (extension(path) == ".json") continue;
    written.write(path, [&] {
      if (extension(path) == ".csv") return write_trace(path, run.record.trace());
      write_map(path, file, run.result.other_triangles ? nullptr : &run.in.polygons, formats,
                certification(path, promise(run, path), &file));
    });
  }
  write_table(run, file, written);
  if (!run.scaffold_file.empty())
    written.write(run.scaffold_file, [&] {
      write_map(run.scaffold_file, scaffold.value(), nullptr, {},
                certification(run.scaffold_file, {}));
    });
}

bool was_stopped(const ParametrizationResult& r) {
  return r.measures.cut_short || r.status == Status::TimeLimit || r.status == Status::Interrupted;
}

Json result_section(const FinishedRun& run) {
  const ParametrizationResult& r = run.result;
  if (!r.map) return nullptr;
  Json result = measures_section(*r.map, r.measures, run.map.energy);
  if (!r.measures.cut_short)
    result["distortion"] = distortion_section({&r.measures.distortion}, scale_of(run));
  if (was_stopped(r) && run.in.options.map.injectivity != MapInjectivity::Global) {
    result["boundary"] = {{"reason", "not asked after the limit"}};
  } else {
    run.record.begin(Activity::Proving);
    add_global_injectivity(result, *r.map, r.measures, check_boundary(*r.map, {.stopped = [&] {
                             return run.record.directive() != Directive::Continue;
                           }}));
  }
  result["start"] = start_taken(run);
  result["variables"] = r.variables;
  result["initial_value"] = r.initial_value;
  result["value_quadrature"] = r.value_quadrature;
  result["newton_decrement"] = r.newton_decrement;
  result["constraint_residual"] = r.constraint_residual;
  result["handle_distance"] = r.handle_distance;
  result["factor_solve_seconds"] = r.factor_solve_seconds ? Json(*r.factor_solve_seconds) : Json();
  if (run.in.cuts) result.update(cuts_section(*run.in.cuts, run.in.mesh->area()));
  return result;
}

Json seam_start_section(const Start& start) {
  const Seams& seams = start.map.seams();
  return {{"residual", start.residual},    {"moved", start.moved},
          {"inverted", start.inverted},    {"untangling_steps", start.untangling_steps},
          {"chains", seams.chain_count()}, {"seam_edges", seams.edges().size()}};
}

// Whole but for what writing adds to it.
Json report_of(const FinishedRun& run) {
  const ParametrizationResult& r = run.result;
  Json report{{"schema_version", 1},
              {"version", MAJORANT_VERSION},
              {"command", run.command},
              {"status", status_name(r.status)},
              {"message", r.message},
              {"input", input_section(run.in.polygons, *run.in.mesh)},
              {"options", options_section(run)},
              {"result", result_section(run)},
              {"outputs", nullptr},
              {"iterations", iterations_section(run.record.trace())},
              {"injectivity_tests", {{"depth", r.injectivity_tests}}},
              {"remedies", remedies_section(r.remedies)},
              {"flips", {{"intended", r.flips.intended}, {"performed", r.flips.performed}}},
              {"seconds",
               {{"read", run.read_seconds},
                {"initialize", r.initialize_seconds},
                {"optimize", r.optimize_seconds},
                {"scaffold", r.scaffold_seconds},
                {"measure", r.measure_seconds},
                {"write", nullptr},
                {"total", nullptr}}},
              {"peak_memory_bytes", peak_memory_bytes()},
              {"threads", ThreadCount::current()},
              {"vector_instructions", vector_instructions()}};
  if (run.in.start && !run.in.start->map.seams().trivial())
    report["seam_start"] = seam_start_section(*run.in.start);
  if (run.film)
    report["snapshots"] = {{"every", run.film->every()},
                           {"frames", run.film->count(last_iteration(run.record.trace()))}};
  return report;
}

void write_reports(const FinishedRun& run, Json report, double write_seconds,
                   WrittenFiles& written) {
  std::vector<std::string> paths;
  if (!run.common.report.empty()) paths.push_back(run.common.report);
  for (const std::string& path : run.outputs.files)
    if (extension(path) == ".json") paths.push_back(path);
  report["outputs"] = written.to_json();
  report["seconds"]["write"] = write_seconds;
  report["seconds"]["total"] = seconds_since(run.start);
  for (const std::string& path : paths) written.write(path, [&] { write_json(path, report); });
}

void summarize(const FinishedRun& run) {
  const ParametrizationResult& r = run.result;
  if (!has_result(r))
    return say("majorant: {}: no valid result: {}{}; no map is written\n", run.map.input,
               status_name(r.status), r.message.empty() ? "" : fmt::format(" ({})", r.message));
  if (run.common.quiet) return;
  if (run.in.cuts) say_untextured(run.map.input, *run.in.cuts);
  const std::string seams =
      r.map ? seam_summary(measures_section(*r.map, r.measures, run.map.energy)) : "";
  say("{}: {} after {} iterations, {} {:.6f} (start {:.6g}){}, degree {}{}, {:.2f} s\n",
      run.map.input, status_name(r.status), steps_taken(run.record.trace()), run.map.energy,
      r.measures.value, r.initial_value,
      run.map.weights.empty() ? "" : ", both without the face weights", run.map.degree, seams,
      seconds_since(run.start));
}

}  // namespace

void OutputRequest::add_to(CLI::App& verb) {
  verb.add_option("output", positional, "output file, same as -o");
  verb.add_option("-o,--output", files, output_help(extensions))->allow_extra_args(false);
  formats.add_to(verb);
  verb.add_option("--distortion", distortion,
                  "write a table of stretch, area and angle distortion per face to FILE.csv")
      ->type_name("FILE");
  verb.add_flag("--normalize", normalize, "scale the result into the unit square");
}

void OutputRequest::require_usable(const MapRequest& map) {
  if (!positional.empty()) files.push_back(positional);
  require_some_output(files, extensions);
  if (normalize && !(map.pins.empty() && map.handles.empty()))
    throw Error(ErrorKind::Usage, "--normalize moves pins and handles; leave one of the two out");
  if (!turns_map()) return;
  if (!(map.pins.empty() && map.handles.empty()))
    throw Error(ErrorKind::Usage,
                "--align turns pins and handles in data files and pages; leave one of the two out");
  if (map.boundary == "fixed")
    throw Error(ErrorKind::Usage,
                "--align turns the boundary that --boundary fixed holds, in data files and pages; "
                "leave one of the two out");
}

bool OutputRequest::has_report(const CommonOptions& common) const {
  return !common.report.empty() ||
         std::any_of(files.begin(), files.end(),
                     [](const std::string& path) { return extension(path) == ".json"; });
}

bool has_result(const ParametrizationResult& result) {
  return result.map && result.status != Status::Failed && result.status != Status::Infeasible;
}

int write_result(const FinishedRun& run) {
  Json report;
  if (run.outputs.has_report(run.common) || has_page(run.outputs.files)) report = report_of(run);
  const double before = seconds_since(run.start);
  WrittenFiles written;
  run.record.begin(Activity::Writing);
  if (has_result(run.result)) write_maps(run, report, written);
  write_reports(run, std::move(report), seconds_since(run.start) - before, written);
  run.progress.finish();
  summarize(run);
  return written.conclude(exit_code(run.result.status));
}

}  // namespace majorant::app
