// What the first solve of a run needs of a surface whatever the start is: space, shapes, terms,
// pattern, ordering, the factor's structure. Made beside the start, where there is a second thread.
//
//     PreparedSolve prepared(mesh, options, rules, record);
//     const Vec uv = initial_map(*mesh, options.map, record);
//     const std::shared_ptr<PreparedParts> parts = prepared.finish();   // null: there are none
//
// Internal to parametrize(). Results are those of a solve that nothing was prepared for, to the
// last bit; what fails here is made again, and fails there.
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
  std::shared_ptr<const RestShapes> rest;  // as NormalizedStart scales them
  DensityTerms terms;
  std::shared_ptr<const LocalInjectivity> injectivity;
  MapProblem built;
  std::shared_ptr<PatternAnalysis> analysis;  // of its pattern

  // Returns whether a solve from there, 2 normalised numbers per node, has this problem.
  bool fits(const BezierTriangleSpace& of, const Vec& start) const;
};

class PreparedSolve {
 public:
  // Everything outlives this. Until finish() the record's start_stop() looks after signals, too.
  PreparedSolve(std::shared_ptr<const SurfaceMesh> mesh, const ParametrizationOptions& options,
                const SolverRules& rules, RunRecord& record);
  ~PreparedSolve();
  PreparedSolve(const PreparedSolve&) = delete;
  PreparedSolve& operator=(const PreparedSolve&) = delete;

  // Waits. Null where nothing could be prepared.
  std::shared_ptr<PreparedParts> finish();

 private:
  void end();

  RunRecord& record_;
  StopCheck start_stop_;  // of the record, before
  std::shared_ptr<PreparedParts> parts_;
  std::optional<SigtermGate> gate_;  // outlives the task
  std::optional<SideTask> task_;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
