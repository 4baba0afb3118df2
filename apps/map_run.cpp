#include "apps/map_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "apps/energy_option.h"
#include "apps/linear_solvers.h"
#include "apps/page_content.h"
#include "apps/run.h"
#include "apps/seam_request.h"
#include "apps/streams.h"
#include "majorant/apps/jobs/global_verdict.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/io.h"

namespace majorant::app {

void MapVerb::add_to(CLI::App& verb) {
  map.add_to(verb);
  outputs.add_to(verb);
  solve.add_to(verb, map.curvature);
  add_linear_solver_to(verb, solve.linear_solver);
  common.add_to(verb);
  common.add_petsc_to(verb);
}

namespace {

std::vector<Activity> stages_of(const MapVerb& request) {
  std::vector<Activity> stages{Activity::Reading, Activity::Starting};
  if (!request.solve.scaffold_file.empty()) stages.push_back(Activity::Scaffold);
  for (const Activity a :
       {Activity::Solving, Activity::Measuring, Activity::Proving, Activity::Writing})
    stages.push_back(a);
  return stages;
}

// Checks the options before any work, and returns the plan of the run.
RunPlan plan_of(MapTask task, MapVerb& request, const std::vector<std::string>& other_inputs) {
  request.outputs.require_usable(request.map);
  request.map.strictness = std::max(request.map.strictness, request.common.strictness());
  request.map.choose_degree(request.outputs.files);
  request.solve.require_usable(request.outputs, request.map);
  RunPlan plan{.command = std::string(task_name(task)),
               .common = request.common,
               .inputs = request.map.inputs(),
               .outputs = request.outputs.names(),
               .stages = stages_of(request),
               .time_limit = request.solve.time_limit,
               .max_iterations = request.solve.max_iterations,
               .with_result = {Activity::Solving, Activity::Measuring, Activity::Proving,
                               Activity::Writing}};
  plan.inputs.insert(plan.inputs.end(), other_inputs.begin(), other_inputs.end());
  plan.inputs.push_back(request.outputs.formats.image);
  plan.outputs.push_back({{request.solve.scaffold_file}, {".vtu", ".svg"}});
  return plan;
}

void read(const MapVerb& request, const MapVerbParts& parts, LinearSolvers& solvers, Run& run,
          MapJob& job) {
  read_input(request.map, job, parts.make_start);
  request.outputs.require_materials(*job.polygons);
  say_warnings(
      request.outputs.stale_pictures(*job.polygons, "majorant unwrap --bake moves pictures"));
  request.solve.apply(job.options);
  solvers.apply(job.options.solve);
  solvers.foresee(job.start ? job.start->map.mesh() : *job.mesh, job.options);
  if (request.solve.snapshots > 0) job.take_snapshots(request.solve.snapshots);
  if (run.has_report()) job.options.solve.factor_cost = FactorCost::Measured;
  job.read_seconds = run.seconds() - job.start_seconds;
}

// Moves the map and proves it again; if the proof fails there is no result.
void place(const MapVerb& request, MapJob& job) {
  const OutputRequest& outputs = request.outputs;
  const Turned turn = outputs.turns_map()                           ? Turned::Required
                      : outputs.turns(*job.result.map, request.map) ? Turned::Free
                                                                    : Turned::Held;
  if (!job.place(turn, outputs.normalize ? LayoutSize::UnitSquare : LayoutSize::Model))
    job.result.message +=
        fmt::format("; leave out {}", outputs.normalize ? "--normalize" : "--align");
  if (job.is_left_unturned && !request.common.quiet)
    say("{}: --normalize leaves the layout unturned: turned along its longer side, its smallest "
        "triangles are too small for doubles\n",
        request.map.input);
}

// Writes the files of a job that has a result.
class MapFiles {
 public:
  // report: receives facts that only the written files show.
  MapFiles(const MapVerb& request, const MapJob& job, RunReport& report)
      : request_(request), job_(job), file_(map_file(job)), formats_(request.outputs.formats) {
    if (job.options.map.injectivity == MapInjectivity::Global)
      formats_.tessellation.overlap = Overlap::Excluded;
    if (job.result.scaffold)
      scaffold_ = to_map_file(job.placement ? (*job.placement)(*job.result.scaffold)
                                            : *job.result.scaffold);
    formats_.svg.scaffold = formats_.png.scaffold = scaffold_;
    formats_.svg.points = formats_.png.points = shown_points(job);
    split_ = split_faces(request.outputs.files, file_, input(), formats_);
    report.result["split_faces"] = split_.size();
    if (has_page(request.outputs.files)) formats_.page = page_of(job, request.map, report);
    formats_.page.scaffold = scaffold_;
  }

  // Returns the faces of the input that OBJ and PLY hold as triangles.
  const std::vector<Index>& split() const { return split_; }

  void write(const std::string& path) const {
    if (extension(path) == ".csv") return write_trace(path, job_.record.trace());
    const std::string note =
        write_map(path, file_, input(), formats_,
                  proof_of_file(path, proof_request(job_, path), file_, formats_));
    if (request_.common.quiet) return;
    say_left_out(path, left_out(path, file_, formats_, input()));
    if (!note.empty()) say("{}: {}\n", path, note);
  }
  void write_table(const std::string& path) const {
    const MapMeasures& measures = job_.result.measures;
    write_distortion(path, file_,
                     measures.cut_short ? measure_distortion(*job_.result.map, scale_of(job_)).faces
                                        : measures.distortion.faces);
  }
  void write_scaffold(const std::string& path) const {
    write_map(path, scaffold_.value(), nullptr, {}, certification(path, {}));
  }

 private:
  // Returns the mesh whose polygons the files keep; null if edges were flipped across them.
  const PolygonMesh* input() const {
    return job_.result.other_triangles ? nullptr : job_.polygons.get();
  }

  const MapVerb& request_;
  const MapJob& job_;
  MapFile file_;
  FormatOptions formats_;
  std::optional<MapFile> scaffold_;
  std::vector<Index> split_;
};

std::vector<MadeFile> files_of(const MapVerb& request, const std::shared_ptr<MapFiles>& files) {
  std::vector<MadeFile> list;
  for (const std::string& path : request.outputs.files)
    if (extension(path) != ".json") list.push_back({path, [=] { files->write(path); }});
  if (const std::string& path = request.outputs.distortion; !path.empty())
    list.push_back({path, [=] { files->write_table(path); }});
  if (const std::string& path = request.solve.scaffold_file; !path.empty())
    list.push_back({path, [=] { files->write_scaffold(path); }});
  return list;
}

// Returns the bounding box of the control points: "(0, 0) to (5.35, 3.95)".
std::string range_text(const BezierMap& map) {
  const auto points = map.control_points().reshaped(2, map.control_points().size() / 2);
  const Vector2 low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  return fmt::format("({:.4g}, {:.4g}) to ({:.4g}, {:.4g})", low.x(), low.y(), high.x(), high.y());
}

std::string summary_of(const MapVerb& request, const MapJob& job, double seconds) {
  const ParametrizationResult& r = job.result;
  const std::string seams = seam_summary(measures_section(*r.map, r.measures, request.map.energy));
  return fmt::format(
      "{}: {} after {}, {} {:.6f} (start {:.6g}){}, degree {}{}, {}, layout {}, {:.2f} s",
      request.map.input, status_name(r.status),
      count_text(steps_taken(job.record.trace()), "iteration"), request.map.energy,
      r.measures.value, r.initial_value,
      request.map.weights.empty() ? "" : ", both without the face weights", request.map.degree,
      seams, overlap_words(job.boundary, image_of(*r.map)), range_text(*r.map), seconds);
}

Made made_of(const MapVerb& request, const MapJob& job, Run& run) {
  const ParametrizationResult& r = job.result;
  Made made{.report = {.status = std::string(status_name(r.status)), .message = r.message}};
  if (run.has_report() || has_page(request.outputs.files)) made.report = map_report(job);
  if (!job.has_result()) {
    made.faults.push_back(fmt::format("majorant: {}: no valid result: {}{}; no map is written",
                                      request.map.input, status_name(r.status),
                                      r.message.empty() ? "" : fmt::format(" ({})", r.message)));
    return made;
  }
  const auto files = std::make_shared<MapFiles>(request, job, made.report);
  made.files = files_of(request, files);
  if (job.cuts) made.remarks = untextured_in_words(request.map.input, *job.cuts);
  if (!files->split().empty())
    made.remarks.push_back(
        fmt::format("{}: {}", request.map.input, split_in_words(files->split())));
  made.summary = [&](const WrittenFiles&) {
    return std::vector<std::string>{summary_of(request, job, run.seconds())};
  };
  return made;
}

}  // namespace

int run_map(MapTask task, MapVerb& request, const MapVerbParts& parts) {
  const RunPlan plan = plan_of(task, request, parts.inputs);
  Run run(plan);
  MapJob job(task, run.record());
  return run.conclude([&](Run&) {
    request.outputs.formats.read_image(run.stop());
    LinearSolvers solvers(request.solve.linear_solver, request.common);
    read(request, parts, solvers, run, job);
    run.make("making the start of " + request.map.input, [&] { job.solve(); });
    solvers.say_unused_options();
    if (job.has_result() && (request.outputs.normalize || request.outputs.turns_map()))
      place(request, job);
    job.options_json = request.map.to_json();
    job.options_json.update(request.solve.to_json());
    job.options_json["strict"] = request.common.strict;
    job.options_json.update(parts.options);
    job.linear_solver = solvers.section();
    job.memory = solvers.memory();
    job.prove();
    return made_of(request, job, run);
  });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
