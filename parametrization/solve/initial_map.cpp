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
#include "majorant/parametrization/solve/normalized_start.h"
#include "majorant/parametrization/solve/parametrize.h"

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
  try {
    ParametrizationResult result = parametrize(level, options, record);
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
  mesh.require_planar();
  require_face_data(mesh, asked);
  if (asked.initial && asked.initial->size() != 2 * mesh.vertex_count())
    throw InvalidArgument(
        fmt::format("{}the initial map has {} numbers, it needs 2 numbers per vertex, {}",
                    message_prefix(mesh), asked.initial->size(), 2 * mesh.vertex_count()));
  if (asked.initial) require_finite("the initial map", *asked.initial);
  StartMethod unused;
  StartMethod& method = taken ? *taken : unused;
  method = StartMethod::Given;
  if (asked.initial) return *asked.initial;
  method = StartMethod::Multiresolution;
  MultiresolutionRules rules;
  if (asked.start == StartMethod::Automatic) rules.largest_drop = kLargestDrop;
  if (tries_multiresolution(mesh, asked)) {
    std::optional<Vec> start =
        multiresolution_map(mesh, asked, record, rules, nullptr, solve_without_overlaps);
    record.telling_start({}).advance(1);
    if (start && (asked.injectivity == MapInjectivity::Local || has_no_overlaps(mesh, *start)))
      return *std::move(start);
  }
  method = StartMethod::Tutte;
  return tutte_map(mesh, record.start_stop());
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
