// The function initial_map() of parametrize.h: chooses and computes the start.
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "majorant/certify/global_injectivity.h"
#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/parametrization/initialization/multiresolution.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/solve/internal/chosen_start.h"
#include "majorant/parametrization/solve/normalized_start.h"
#include "majorant/parametrization/solve/parametrize_by.h"

namespace majorant {
namespace {

// From this many faces on the automatic start is a multiresolution map. bench/multiresolution: at
// 2,500 faces it saves 2 to 4 of 20 factorizations on easy disks and costs some on hard ones.
constexpr Index kLargeSurface = 5000;
// Tutte's map replaces a multiresolution map whose energy drops by more than this fraction from one
// level to a finer one. The drop is 0.51 where the multiresolution map leads to another minimum,
// and at most 0.07 on all other public disks.
constexpr double kLargestDrop = 0.25;

// Returns whether an automatic start is a multiresolution map. If points stay where the initial map
// has them, or handles pull, it is Tutte's map, which does not depend on the energy.
bool pays(const SurfaceMesh& mesh, const MapOptions& options) {
  return mesh.face_count() >= kLargeSurface && options.handles.empty() &&
         std::all_of(options.pins.begin(), options.pins.end(),
                     [](const Pin& pin) { return pin.target.has_value(); });
}

// Solves a level as a LevelSolver does.
std::optional<LevelSolution> solve_without_overlaps(const std::shared_ptr<const SurfaceMesh>& level,
                                                    const MapOptions& map_options, double decrease,
                                                    RunRecord& record) {
  ParametrizationOptions options;
  options.map = map_options;
  options.solve.tolerance = decrease;
  SolverRules rules;
  rules.scaffold.from_the_start = true;
  try {
    const BezierMap start = BezierMap::linear(level, *map_options.initial);
    ParametrizationResult result = parametrize_by(rules, start, options, record);
    if (!result.map || result.status == Status::Failed) return std::nullopt;
    return LevelSolution{result.map->control_points(), result.measures.value};
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::Infeasible) throw;
    return std::nullopt;
  }
}

bool has_no_overlaps(const SurfaceMesh& mesh, const Vec& uv) {
  const auto unowned = std::shared_ptr<const SurfaceMesh>(std::shared_ptr<void>(), &mesh);
  return check_boundary(BezierMap::linear(unowned, uv)).result == ProofStatus::Proven;
}

// Computes a multiresolution start without overlaps: that of a free map if it has none, else one
// that is kept free of overlaps on all levels. Returns whether there is one.
bool start_without_overlaps(const SurfaceMesh& mesh, const MapOptions& options, RunRecord& record,
                            const MultiresolutionRules& rules, ChosenStart& start) {
  MapOptions free = options;
  free.injectivity = MapInjectivity::Local;
  const std::size_t rows = record.trace().size();
  const auto goes_on = [&start](const SurfaceMesh& level, const Vec& uv) {
    start.free_maps_overlap = !has_no_overlaps(level, uv);
    return !start.free_maps_overlap;
  };
  std::optional<Vec> found = multiresolution_map(mesh, free, record, rules, nullptr, {}, goes_on);
  if (found) start.free_maps_overlap = !has_no_overlaps(mesh, *found);
  if (start.free_maps_overlap) {
    record.take_back_to(rows);
    found = multiresolution_map(mesh, options, record, rules, nullptr, solve_without_overlaps);
    if (found && !has_no_overlaps(mesh, *found)) found.reset();
  }
  if (!found) return false;
  start.uv = *std::move(found);
  return true;
}

bool start_in_many_resolutions(const SurfaceMesh& mesh, const MapOptions& options,
                               RunRecord& record, const MultiresolutionRules& rules,
                               ChosenStart& start) {
  if (options.injectivity == MapInjectivity::Global)
    return start_without_overlaps(mesh, options, record, rules, start);
  std::optional<Vec> found = multiresolution_map(mesh, options, record, rules);
  if (found) start.uv = *std::move(found);
  return found.has_value();
}

}  // namespace

std::string_view start_name(StartMethod method) {
  constexpr std::string_view kNames[] = {"auto", "tutte", "multiresolution", "input"};
  return kNames[static_cast<std::size_t>(method)];
}

Vec initial_map(const SurfaceMesh& mesh, const MapOptions& options, const StopCheck& stop,
                StartMethod* taken) {
  RunRecord unseen(stop);
  return initial_map(mesh, options, unseen, taken);
}

Vec initial_map(const SurfaceMesh& mesh, const MapOptions& options, RunRecord& record,
                StartMethod* taken) {
  ChosenStart start = choose_start(mesh, options, record);
  if (taken) *taken = start.method;
  return std::move(start.uv);
}

bool tries_multiresolution(const SurfaceMesh& mesh, const MapOptions& options) {
  if (!options.aligned.empty()) return false;
  return options.start == StartMethod::Multiresolution ||
         (options.start == StartMethod::Automatic && pays(mesh, options));
}

ChosenStart choose_start(const SurfaceMesh& mesh, const MapOptions& options, RunRecord& record) {
  mesh.require_planar();
  require_face_data(mesh, options);
  if (options.initial && options.initial->size() != 2 * mesh.vertex_count())
    throw InvalidArgument(
        fmt::format("{}the initial map has {} numbers, it needs 2 numbers per vertex, {}",
                    message_prefix(mesh), options.initial->size(), 2 * mesh.vertex_count()));
  if (options.initial) require_finite("the initial map", *options.initial);
  if (options.initial) return {*options.initial};
  MultiresolutionRules rules;
  if (options.start == StartMethod::Automatic) rules.largest_drop = kLargestDrop;
  if (tries_multiresolution(mesh, options)) {
    ChosenStart start{.uv = {}, .method = StartMethod::Multiresolution};
    const bool found = start_in_many_resolutions(mesh, options, record, rules, start);
    record.telling_start({}).advance(1);
    if (found) return start;
  }
  return {tutte_map(mesh, record.start_stop()), StartMethod::Tutte};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
