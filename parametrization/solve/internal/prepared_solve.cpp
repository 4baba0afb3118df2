#include "majorant/parametrization/solve/internal/prepared_solve.h"

#include <exception>
#include <utility>

#include "majorant/framework/parallel.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/parametrization/solve/internal/quadrature_levels.h"
#include "majorant/parametrization/solve/normalized_start.h"

namespace majorant {
namespace {

// With fewer faces a start is computed before a thread has prepared anything.
constexpr Index kMinPreparedFaces = 5000;

// Returns whether the first problem of a run is known before the start: one of the plain map, in
// which nothing is held except a point that NormalizedStart moves to the origin. A bijective map
// begins as a plain one.
bool is_known_before(const SurfaceMesh& mesh, const ParametrizationOptions& options) {
  const MapOptions& map = options.map;
  return mesh.face_count() >= kMinPreparedFaces && !map.initial && !options.extend &&
         (map.degree == 1 || options.solve.elevation == Elevation::Incremental) &&
         (map.injectivity == MapInjectivity::Local ||
          options.solve.scaffold == ScaffoldUse::WhereMapsOverlap) &&
         map.pins.empty() && map.handles.empty() && map.aligned.empty() &&
         map.boundary == BoundaryCondition::Free && map.boundary_angles == BoundaryAngles::Free;
}

void prepare(PreparedParts& parts, const SurfaceMesh& mesh, const ParametrizationOptions& options,
             const SolverRules& rules, const StopCheck& solve_stop, const StopCheck& stop,
             SigtermGate& gate) {
  parts.space = std::make_shared<const BezierTriangleSpace>(mesh.faces(), mesh.vertex_count(), 1);
  parts.rest = std::make_shared<const RestShapes>(rest_shapes(mesh, normal_scale(mesh)));
  MapSpecification spec(options.map);
  spec.rest = parts.rest;
  const QuadratureLevels levels(
      optimizer_quadrature(1, options.solve.quadrature_points, rules.quadrature),
      parts.space->element_count());
  parts.terms = energy_terms(spec, parts.space, levels.rules());
  parts.injectivity = std::make_shared<const LocalInjectivity>(
      parts.space, 2 * parts.rest->measure, options.solve.injectivity_depth, solve_stop);
  stop.poll();
  parts.built = map_problem(spec, parts.space, Vec::Zero(2 * parts.space->node_count()),
                            parts.terms, parts.injectivity);
  stop.poll();
  gate.enter();
  parts.analysis =
      std::make_shared<PatternAnalysis>(parts.built.problem.pattern(), Ordering::Automatic);
  gate.leave();
}

}  // namespace

bool PreparedParts::fits(const BezierTriangleSpace& of, const Vec& start) const {
  if (&of != space.get()) return false;
  double residual = 0;
  built.problem.reduce(start, &residual);
  return residual == 0;
}

PreparedSolve::PreparedSolve(std::shared_ptr<const SurfaceMesh> mesh,
                             const ParametrizationOptions& options, const SolverRules& rules,
                             RunRecord& record)
    : record_(record) {
  if (ThreadCount::current() == 1 || !is_known_before(*mesh, options)) return;
  gate_.emplace();
  start_stop_ = record.replace_start_stop(gate_->polled(record.start_stop()));
  task_.emplace(
      [this, mesh = std::move(mesh), &options, rules, stop = record.stop(), before = start_stop_] {
        auto parts = std::make_shared<PreparedParts>();
        prepare(*parts, *mesh, options, rules, stop, before, *gate_);
        parts_ = std::move(parts);
      });
}

PreparedSolve::~PreparedSolve() {
  if (!task_) return;
  gate_->refuse();
  end();
}

void PreparedSolve::end() {
  task_.reset();  // waits
  record_.replace_start_stop(std::move(start_stop_));
  gate_.reset();
}

// Ignores errors: the solve meets the same error again, or has been stopped.
std::shared_ptr<PreparedParts> PreparedSolve::finish() {
  if (!task_) return nullptr;
  bool done = false;
  gate_->open();
  try {
    done = task_->finish();
  } catch (const std::exception&) {
  }
  end();
  return done ? std::move(parts_) : nullptr;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
