// initial_map() of parametrize.h: which start is taken, and made.
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

// Faces from which on a start in many resolutions is the automatic one.
// bench/multiresolution: at 2,500 it saves 2 to 4 fe of 20 on easy disks and costs some on hard
// ones.
constexpr Index kLargeSurface = 5000;
// The relative drop of the energy, from a level to one that is not coarse, beyond which Tutte's map
// is taken after all. Where other minima wait it was 0.51, on all other public disks at most 0.07.
constexpr double kLargestDrop = 0.25;

// Returns whether an automatic start is made in many resolutions. Points that are to stay where the
// initial map has them, or are pulled, mean Tutte's: it does not depend on the energy.
bool pays(const SurfaceMesh& mesh, const MapOptions& asked) {
  return mesh.face_count() >= kLargeSurface && asked.handles.empty() &&
         std::all_of(asked.pins.begin(), asked.pins.end(),
                     [](const Pin& pin) { return pin.target.has_value(); });
}

bool tries_multiresolution(const SurfaceMesh& mesh, const MapOptions& asked) {
  if (!asked.aligned.empty()) return false;
  return asked.start == StartMethod::Multiresolution ||
         (asked.start == StartMethod::Automatic && pays(mesh, asked));
}

// A LevelSolver.
std::optional<LevelSolution> solve_without_overlaps(const std::shared_ptr<const SurfaceMesh>& level,
                                                    const MapOptions& asked, double decrease,
                                                    RunRecord& record) {
  ParametrizationOptions options;
  options.map = asked;
  options.solve.tolerance = decrease;
  SolverRules rules;
  rules.scaffold.from_the_start = true;
  try {
    const BezierMap start = BezierMap::linear(level, *asked.initial);
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

// A start of a map that is kept from overlaps: that of a free one where it has none, else one that
// is kept from them on all levels. Returns whether there is one.
bool start_without_overlaps(const SurfaceMesh& mesh, const MapOptions& asked, RunRecord& record,
                            const MultiresolutionRules& rules, ChosenStart& start) {
  MapOptions free = asked;
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
    found = multiresolution_map(mesh, asked, record, rules, nullptr, solve_without_overlaps);
    if (found && !has_no_overlaps(mesh, *found)) found.reset();
  }
  if (!found) return false;
  start.uv = *std::move(found);
  return true;
}

bool start_in_many_resolutions(const SurfaceMesh& mesh, const MapOptions& asked, RunRecord& record,
                               const MultiresolutionRules& rules, ChosenStart& start) {
  if (asked.injectivity == MapInjectivity::Global)
    return start_without_overlaps(mesh, asked, record, rules, start);
  std::optional<Vec> found = multiresolution_map(mesh, asked, record, rules);
  if (found) start.uv = *std::move(found);
  return found.has_value();
}

}  // namespace

std::string_view start_name(StartMethod method) {
  constexpr std::string_view kNames[] = {"auto", "tutte", "multiresolution", "input"};
  return kNames[static_cast<std::size_t>(method)];
}

Vec initial_map(const SurfaceMesh& mesh, const MapOptions& asked, const StopCheck& stop,
                StartMethod* taken) {
  RunRecord unseen(stop);
  return initial_map(mesh, asked, unseen, taken);
}

Vec initial_map(const SurfaceMesh& mesh, const MapOptions& asked, RunRecord& record,
                StartMethod* taken) {
  ChosenStart start = choose_start(mesh, asked, record);
  if (taken) *taken = start.method;
  return std::move(start.uv);
}

ChosenStart choose_start(const SurfaceMesh& mesh, const MapOptions& asked, RunRecord& record) {
  mesh.require_planar();
  require_face_data(mesh, asked);
  if (asked.initial && asked.initial->size() != 2 * mesh.vertex_count())
    throw InvalidArgument(
        fmt::format("{}the initial map has {} numbers, it needs 2 numbers per vertex, {}",
                    message_prefix(mesh), asked.initial->size(), 2 * mesh.vertex_count()));
  if (asked.initial) require_finite("the initial map", *asked.initial);
  if (asked.initial) return {*asked.initial};
  MultiresolutionRules rules;
  if (asked.start == StartMethod::Automatic) rules.largest_drop = kLargestDrop;
  if (tries_multiresolution(mesh, asked)) {
    ChosenStart start{.method = StartMethod::Multiresolution};
    const bool found = start_in_many_resolutions(mesh, asked, record, rules, start);
    record.telling_start({}).advance(1);
    if (found) return start;
  }
  return {tutte_map(mesh, record.start_stop()), StartMethod::Tutte};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
