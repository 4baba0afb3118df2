// The JSON report of a run on several ranks: the sections of results/internal/report.h that need no
// map in one process, and what ranks and linear solvers did ("ranks", "linear_solver").
#pragma once

#include <string>

#include "distributed/parametrize_parts.h"
#include "distributed/petsc_solver.h"
#include "majorant/certify/global_injectivity.h"
#include "majorant/results/internal/map_job.h"

namespace majorant {

// What rank 0 knows of the run, all others of it through collective calls.
struct PartsRun {
  const MapJob& job;
  const MeshPart& part;
  const PartResult& result;
  const GlobalInjectivity& boundary;  // rank 0's
  std::string start, file;
  double divide_seconds = 0, initialize_seconds = 0, write_seconds = 0;
  Json checkpoint, resumed;  // null: there were none
};

// Collective; rank 0's is the report, others get null.
Json parts_report(const PartsRun& run);
// What the files promise.
std::string parts_claims(const PartsRun& run);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
