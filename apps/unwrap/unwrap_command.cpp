// majorant unwrap IN -o OUT...: maps any mesh to a layout of charts without overlaps.
#include <CLI/App.hpp>
#include <memory>
#include <string>
#include <utility>

#include "apps/command.h"
#include "apps/energy_option.h"
#include "apps/linear_solvers.h"
#include "apps/run.h"
#include "apps/streams.h"
#include "apps/unwrap/unwrap_request.h"
#include "apps/unwrap/unwrapped_files.h"
#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {
namespace {

Strictness strictness_of(const UnwrapVerb& request) {
  return request.common.strictness(
      request.unwrap.keep_seams ? Strictness::Texcoords : request.unwrap.seams.needed_of_file());
}

PolygonMesh read(const UnwrapVerb& request, const Run& run) {
  const std::string& path = request.map.input;
  PolygonMesh mesh =
      run.read(path, [&] { return read_mesh(path, run.start_stop(), strictness_of(request)); });
  if (!request.unwrap.bake)
    for (std::string& line : request.outputs.stale_pictures(mesh, "--bake moves pictures"))
      mesh.warnings.push_back(std::move(line));
  say_warnings(mesh.warnings);
  request.outputs.require_materials(mesh);
  return mesh;
}

ModelTexture read_texture_of(const UnwrapVerb& request, const PolygonMesh& mesh, const Run& run) {
  ModelTexture texture =
      run.read(request.map.input, [&] { return read_texture(mesh, run.start_stop()); });
  say_warnings(texture.warnings);
  return texture;
}

// Makes, places and proves the charts of a mesh.
void unwrap_mesh(const UnwrapVerb& request, PolygonMesh polygons, LinearSolvers& solvers,
                 const Run& run, AtlasJob& job) {
  const RunRecord& record = job.record;
  job.energy = request.map.energy;
  run.make("reading " + request.map.input, [&] {
    request.unwrap.open(job, std::move(polygons), strictness_of(request));
    job.options.chart = read_options(request.map, *job.polygons, *job.surface.mesh,
                                     record.start_stop(), job.surface.welded);
    request.unwrap.layout.apply(job, record.start_stop());
  });
  request.solve.apply(job.options.chart);
  job.options.cutting_seconds = kCuttingShare * request.solve.time_limit;
  solvers.apply(job.options.chart.solve);
  job.read_seconds = record.seconds();
  run.make("unwrapping " + request.map.input, [&] { job.solve(); });
  const std::string tiled = request.unwrap.layout.needs_unit_square();
  if (request.unwrap.scale == "unit" && !job.place())
    throw Error(ErrorKind::Invalid,
                request.map.input + ": in the unit square " + problem_in_unit_square(job.atlas) +
                    "; " +
                    (tiled.empty() ? "add --scale model"
                                   : "leave out " + tiled + " and add --scale model"));
  job.options_json = request.to_json();
  job.linear_solver = solvers.section();
  job.memory = solvers.memory();
  job.prove();
}

Made unwrapped(UnwrapRun& unwrap, Run& run) {
  UnwrapVerb const& request = unwrap.request;
  PolygonMesh polygons = read(request, run);
  if (request.unwrap.bake) {
    unwrap.texture = read_texture_of(request, polygons, run);
    unwrap.baked = request.baked_outputs();
  }
  LinearSolvers solvers(request.solve.linear_solver, request.common, LinearSolvers::Runs::Several);
  unwrap_mesh(request, std::move(polygons), solvers, run, unwrap.job);
  return made_of(unwrap, run, run.has_report());
}

Made unwrapped(ObjectsRun& objects, Run& run) {
  objects.polygons = read(objects.request, run);
  LinearSolvers solvers(objects.request.solve.linear_solver, objects.request.common,
                        LinearSolvers::Runs::Several);
  return made_of(
      objects, unwrap_objects(objects.polygons, run.record(), [&](PolygonMesh mesh, AtlasJob& job) {
        const std::string file = mesh.file;
        unwrap_mesh(objects.request, std::move(mesh), solvers, run, job);
        objects.add_lines(job, file);
      }));
}

int unwrap_file(UnwrapVerb request) {
  request.require_usable();
  const RunPlan plan{.command = "unwrap",
                     .common = request.common,
                     .inputs = request.inputs(),
                     .outputs = request.output_names(),
                     .stages = {Activity::Reading, Activity::Cutting, Activity::Solving,
                                Activity::Packing, Activity::Proving, Activity::Writing},
                     .time_limit = request.solve.time_limit,
                     .max_iterations = request.solve.max_iterations,
                     .with_result = {Activity::Solving, Activity::Packing, Activity::Measuring,
                                     Activity::Proving, Activity::Writing}};
  Run run(plan);
  if (request.unwrap.layout.is_of_objects()) {
    ObjectsRun objects{request};
    return run.conclude([&](Run&) { return unwrapped(objects, run); });
  }
  UnwrapRun unwrap{request, AtlasJob(run.record())};
  return run.conclude([&](Run&) {
    request.outputs.formats.read_image(run.stop());
    return unwrapped(unwrap, run);
  });
}

}  // namespace

void add_unwrap(CLI::App& app, Action* run) {
  auto request = std::make_shared<UnwrapVerb>();
  CLI::App& verb =
      *app.add_subcommand("unwrap", "cut any mesh into charts and pack them without overlaps");
  request->add_to(verb);
  verb.footer(
      energy_help() +
      "Example: majorant unwrap bunny.obj -o unwrapped.obj --padding 8 --report bunny.json");
  verb.callback([request, run] { *run = [request] { return unwrap_file(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
