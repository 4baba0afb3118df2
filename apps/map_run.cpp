#include "apps/map_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/energy_option.h"
#include "apps/process.h"
#include "apps/progress.h"

namespace majorant::app {

void MapVerb::add_to(CLI::App& verb) {
  map.add_to(verb);
  outputs.add_to(verb);
  solve.add_to(verb, map.curvature);
  add_linear_solver_to(verb, solve.linear_solver);
  common.add_to(verb);
}

MapRun::MapRun(std::string verb, MapVerb& request, const std::vector<std::string>& other_inputs)
    : verb_(std::move(verb)),
      request_(request),
      progress_(request.common),
      record_(request.solve.make_record(progress_)) {
  request.outputs.require_usable(request.map);
  request.map.strictness = std::max(request.map.strictness, request.common.strictness());
  request.map.choose_degree(request.outputs.files);
  request.solve.require_usable(request.outputs, request.map);
  std::vector<std::string> inputs = request.map.inputs();
  inputs.insert(inputs.end(), other_inputs.begin(), other_inputs.end());
  inputs.push_back(request.outputs.formats.readable_image());
  require_writable(request.common,
                   {{request.outputs.files, request.outputs.extensions},
                    {{request.solve.scaffold_file}, {".vtu", ".svg"}},
                    {{request.outputs.distortion}, {".csv"}}},
                   inputs);
  solvers_.emplace(request.solve.linear_solver, request.common.petsc_options, request.common.quiet);
  threads_.emplace(start_threads(request.common.threads));
}

MapInput& MapRun::read(const StartMaker& make_start) {
  StartMaker timed;
  if (make_start)
    timed = [&](const PolygonMesh& polygons, const SurfaceMesh& mesh) {
      const double before = seconds();
      record_.begin(Activity::Starting);
      Start start = make_start(polygons, mesh);
      start_seconds_ = seconds() - before;
      return start;
    };
  record_.begin(Activity::Reading);
  in_ = read_input(request_.map, record_.start_stop(), timed);
  request_.solve.apply(in_.options);
  solvers_->apply(in_.options.solve);
  solvers_->foresee(in_.start ? in_.start->map.mesh() : *in_.mesh, in_.options);
  if (request_.solve.snapshots > 0) {
    film_.emplace(request_.solve.snapshots, request_.map.degree);
    in_.options.solve.watch = film_->watcher();
  }
  if (request_.outputs.has_report(request_.common))
    in_.options.solve.factor_cost = FactorCost::Measured;
  read_seconds_ = seconds() - start_seconds_;
  return in_;
}

int MapRun::finish(ParametrizationResult result, const Json& extra) {
  result.initialize_seconds += start_seconds_;
  solvers_->say_unused_options();
  std::optional<LayoutPlacement> placement;
  if (has_result(result) && (request_.outputs.normalize || request_.outputs.turns_map()))
    placement = place(result);
  Json options = request_.map.to_json();
  options.update(request_.solve.to_json());
  options["strict"] = request_.common.strict;
  options.update(extra);
  FinishedMap finished{verb_,   in_.polygons,        *in_.mesh,         in_.options.map,   result,
                       record_, request_.map.energy, request_.map.init, std::move(options)};
  finished.read_seconds = read_seconds_;
  finished.linear_solver = solvers_->section();
  finished.memory = solvers_->memory();
  if (in_.cuts) finished.cuts = &*in_.cuts;
  if (in_.start) finished.start = &*in_.start;
  if (placement) finished.placement = &*placement;
  finished.is_aligned =
      request_.outputs.turns_map() || (placement && placement->direction != Vector2(1, 0));
  finished.is_normalized = request_.outputs.normalize;
  if (film_) finished.film = &*film_;
  finished.boundary = prove_boundary(result, record_);
  return write_result({request_.common, request_.outputs, request_.map, in_, finished, start_,
                       request_.solve.scaffold_file, progress_});
}

// What is moved must be proven anew; where that fails there is no result.
std::optional<LayoutPlacement> MapRun::place(ParametrizationResult& result) {
  record_.begin(Activity::Measuring);
  const bool is_turned = request_.outputs.turns(*result.map, request_.map),
             is_scaled = request_.outputs.normalize;
  const Vector2 direction = is_turned ? layout_direction(*result.map) : Vector2(1, 0);
  const EnergySum& energy = in_.options.map.energy;
  auto placed = is_scaled ? into_unit_square(*result.map, direction, energy, record_.stop())
                          : turned_along(*result.map, direction, energy, record_.stop());
  if (!placed && is_scaled && !request_.outputs.turns_map())  // nobody asked for the turn
    placed = into_unit_square(*result.map, {1, 0}, energy, record_.stop());
  if (!placed) {
    result.status = Status::Failed;
    result.message = fmt::format(
        "{} its smallest triangles are too small for doubles; leave out {}",
        is_scaled ? "in the unit square" : "turned", is_scaled ? "--normalize" : "--align");
    return {};
  }
  result.map = std::move(placed->map);
  result.measures = std::move(placed->measures);
  return placed->placement;
}

double MapRun::seconds() const { return seconds_since(start_); }

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
