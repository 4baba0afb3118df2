// The parts of a run's first solve that do not depend on the start: space, shapes, terms, pattern,
// ordering, the factor's structure. They are computed in parallel with the start if there is a
// second thread.
//
//     PreparedSolve prepared(mesh, options, rules, record);
//     const Vec uv = initial_map(*mesh, options.map, record);
//     const std::shared_ptr<PreparedParts> parts = prepared.finish();   // null: there are none
//
// Internal to parametrize(). Results are the same to the last bit as without preparation. A part
// that fails here is computed again later, and fails there.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "majorant/framework/pattern_analysis.h"
#include "majorant/framework/run_record.h"
#include "majorant/framework/side_task.h"
#include "majorant/framework/sigterm_gate.h"
#include "majorant/maps/map_options.h"
#include "majorant/maps/map_problem.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/solve/solver_rules.h"

namespace majorant {

struct PreparedParts {
  std::shared_ptr<const BezierTriangleSpace> space;
  std::shared_ptr<const RestShapes> rest;  // in NormalizedStart's scale
  DensityTerms terms;
  std::shared_ptr<const LocalInjectivity> injectivity;
  MapProblem built;
  std::shared_ptr<PatternAnalysis> analysis;  // of its pattern

  // Returns whether a solve from this start, 2 normalized numbers per node, has this problem.
  bool fits(const BezierTriangleSpace& of, const Vec& start) const;
};

class PreparedSolve {
 public:
  // All arguments outlive this object. Until finish() the record's start_stop() also handles
  // signals.
  PreparedSolve(std::shared_ptr<const SurfaceMesh> mesh, const ParametrizationOptions& options,
                const SolverRules& rules, RunRecord& record);
  ~PreparedSolve();
  PreparedSolve(const PreparedSolve&) = delete;
  PreparedSolve& operator=(const PreparedSolve&) = delete;

  // Waits for the parts and returns them; null if nothing could be prepared.
  std::shared_ptr<PreparedParts> finish();

 private:
  void end();

  RunRecord& record_;
  StopCheck start_stop_;  // the record's previous one
  std::shared_ptr<PreparedParts> parts_;
  std::optional<SigtermGate> gate_;  // outlives the task
  std::optional<SideTask> task_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
