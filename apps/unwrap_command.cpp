// majorant unwrap IN -o OUT...: any mesh to a layout of charts without overlaps.
#include <CLI/App.hpp>
#include <memory>
#include <utility>

#include "apps/atlas_result.h"
#include "apps/energy_option.h"
#include "apps/linear_solvers.h"
#include "apps/parts.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/solve_request.h"
#include "apps/streams.h"
#include "apps/unless_stopped.h"
#include "apps/unwrap_request.h"
#include "apps/within_memory.h"
#include "majorant/framework/thread_count.h"
#include "majorant/io/read_mesh.h"

namespace majorant::app {
namespace {

struct UnwrapVerb {
  CommonOptions common;
  MapRequest map;
  OutputRequest outputs;
  SolveRequest solve;
  UnwrapRequest unwrap;
};

Json options_of(const UnwrapVerb& request) {
  Json options = request.map.to_json();
  options.update(request.solve.to_json());
  options.update(request.unwrap.to_json());
  options["strict"] = request.common.strict;
  for (const char* other : {"boundary", "init", "seamless", "bijective", "no_flips",
                            "write_scaffold", "improve_mesh", "snapshots"})
    options.erase(other);
  return options;
}

void require_usable(UnwrapVerb& request) {
  require_gpl_parts("unwrap");
  request.outputs.require_usable(request.map);
  if (request.outputs.turns_map())
    throw Error(
        ErrorKind::Usage,
        "--align: unwrap lays its charts side by side as they fit; leave it out, or ask for "
        ".svg and .png alone");
  if (request.solve.linear_solver != "auto" && request.solve.linear_solver != "direct")
    throw Error(ErrorKind::Usage,
                fmt::format("--linear-solver {}: unwrap solves charts side by side, each by the "
                            "program's own solver; leave it out",
                            request.solve.linear_solver));
  if (request.map.degree == 0) request.map.degree = 1;
  if (request.unwrap.seams.seams.empty()) request.unwrap.seams.seams = "auto";
  require_writable(request.common,
                   {{request.outputs.files, request.outputs.extensions},
                    {{request.outputs.distortion}, {".csv"}}},
                   {request.map.input, request.map.pins, request.map.handles, request.map.weights,
                    request.unwrap.seams.file(), request.outputs.formats.readable_image()});
}

int unwrap_file(UnwrapVerb request) {
  const auto start = std::chrono::steady_clock::now();
  Progress progress(request.common);
  RunRecord record = request.solve.make_record(progress);
  require_usable(request);
  const ThreadCount threads(start_threads(request.common.threads));
  AtlasJob job(record);
  job.energy = request.map.energy;
  record.begin(Activity::Reading);
  unless_stopped("reading " + request.map.input, [&] {
    const Strictness strictness = request.common.strictness(request.unwrap.seams.needed_of_file());
    PolygonMesh polygons = within_memory(request.map.input, [&] {
      return read_mesh(request.map.input, record.start_stop(), strictness);
    });
    say_warnings(polygons.warnings);
    request.unwrap.open(job, std::move(polygons), strictness);
    job.options.chart = read_options(request.map, *job.polygons, *job.surface.mesh);
  });
  request.solve.apply(job.options.chart);
  LinearSolvers solvers(request.solve.linear_solver, "", request.common.quiet,
                        LinearSolvers::Runs::Several);
  solvers.apply(job.options.chart.solve);
  job.read_seconds = record.seconds();
  unless_stopped("unwrapping " + request.map.input, [&] { job.solve(); });
  if (request.outputs.normalize && !job.place())
    throw Error(ErrorKind::Invalid,
                request.map.input +
                    ": in the unit square its smallest triangles are too small for doubles; leave "
                    "out --normalize");
  job.wishes = options_of(request);
  job.linear_solver = solvers.section();
  job.memory = solvers.memory();
  job.prove();
  return write_atlas({request.common, request.outputs, request.map, job, start, progress});
}

}  // namespace

void add_unwrap(CLI::App& app, Action* run) {
  auto request = std::make_shared<UnwrapVerb>();
  CLI::App& verb = *app.add_subcommand(
      "unwrap", "cut any mesh into charts and lay them side by side, without overlaps");
  request->map.add_to(verb, "1");
  request->outputs.extensions = map_extensions({".json"});
  request->outputs.add_to(verb);
  request->unwrap.add_to(verb);
  request->solve.add_limits_to(verb, request->map.curvature);
  add_linear_solver_to(verb, request->solve.linear_solver);
  request->common.add_to(verb);
  verb.footer(
      energy_help() +
      "Example: majorant unwrap bunny.obj -o unwrapped.obj --normalize --report bunny.json");
  verb.callback([request, run] { *run = [request] { return unwrap_file(*request); }; });
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
