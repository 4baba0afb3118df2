#include "apps/map_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "apps/energy_option.h"
#include "apps/or_interrupted.h"
#include "apps/process.h"
#include "apps/progress.h"
#include "apps/streams.h"

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
  if (request.solve.bijective) stages.push_back(Activity::Scaffold);
  for (const Activity a :
       {Activity::Solving, Activity::Measuring, Activity::Proving, Activity::Writing})
    stages.push_back(a);
  return stages;
}

}  // namespace

MapRun::MapRun(MapTask task, MapVerb& request, const std::vector<std::string>& other_inputs)
    : request_(request),
      progress_(request.common, stages_of(request)),
      record_(request.solve.make_record(progress_)),
      job_(task, record_) {
  request.outputs.require_usable(request.map);
  request.map.strictness = std::max(request.map.strictness, request.common.strictness());
  request.map.choose_degree(request.outputs.files);
  request.solve.require_usable(request.outputs, request.map);
  std::vector<std::string> inputs = request.map.inputs();
  inputs.insert(inputs.end(), other_inputs.begin(), other_inputs.end());
  request.outputs.formats.read_image(record_.start_stop());
  inputs.push_back(request.outputs.formats.image);
  require_writable(request.common,
                   {{request.outputs.files, request.outputs.extensions},
                    {{request.solve.scaffold_file}, {".vtu", ".svg"}},
                    {{request.outputs.distortion}, {".csv"}}},
                   inputs);
  solvers_.emplace(request.solve.linear_solver, request.common);
  threads_.emplace(usable_threads(request.common.threads));
}

void MapRun::read(const StartMaker& make_start) {
  record_.begin(Activity::Reading);
  read_input(request_.map, job_, make_start);
  request_.outputs.require_materials(*job_.polygons);
  ParametrizationOptions& options = job_.options;
  request_.solve.apply(options);
  solvers_->apply(options.solve);
  solvers_->foresee(job_.start ? job_.start->map.mesh() : *job_.mesh, options);
  if (request_.solve.snapshots > 0) job_.take_snapshots(request_.solve.snapshots);
  if (request_.outputs.has_report(request_.common))
    options.solve.factor_cost = FactorCost::Measured;
  job_.read_seconds = seconds_since(start_) - job_.start_seconds;
}

int MapRun::finish(const Json& extra) {
  or_interrupted("making the start of " + request_.map.input, [&] { job_.solve(); });
  solvers_->say_unused_options();
  if (job_.has_result() && (request_.outputs.normalize || request_.outputs.turns_map())) place();
  job_.asked = request_.map.to_json();
  job_.asked.update(request_.solve.to_json());
  job_.asked["strict"] = request_.common.strict;
  job_.asked.update(extra);
  job_.linear_solver = solvers_->section();
  job_.memory = solvers_->memory();
  job_.prove();
  return write_result({request_.common, request_.outputs, request_.map, job_, start_,
                       request_.solve.scaffold_file, progress_});
}

// Moves the map and proves it anew; where that fails there is no result.
void MapRun::place() {
  const OutputRequest& outputs = request_.outputs;
  const Turned turn = outputs.turns_map()                             ? Turned::Required
                      : outputs.turns(*job_.result.map, request_.map) ? Turned::Free
                                                                      : Turned::Held;
  if (!job_.place(turn, outputs.normalize ? LayoutSize::UnitSquare : LayoutSize::Model))
    job_.result.message +=
        fmt::format("; leave out {}", outputs.normalize ? "--normalize" : "--align");
  if (job_.is_left_unturned && !request_.common.quiet)
    say("{}: --normalize leaves the layout unturned: turned along its longer side, its smallest "
        "triangles are too small for doubles\n",
        request_.map.input);
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
