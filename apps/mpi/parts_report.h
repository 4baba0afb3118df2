// The report of a run on several ranks: the sections of apps/jobs/report.h that need no complete
// map, and the records of ranks and linear solvers ("ranks", "linear_solver").
#pragma once

#include <string>

#include "apps/mpi/mesh_part.h"
#include "majorant/apps/jobs/map_job.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/certify/global_injectivity.h"

namespace majorant::app {

// The data of a finished run on rank 0. Other ranks take part through collective calls.
struct PartsRun {
  const MapJob& job;
  const MeshPart& part;
  const ParametrizationResult& result;
  const GlobalInjectivity& boundary;  // valid on rank 0
  std::string start, file;
  double divide_seconds = 0, initialize_seconds = 0;
  Json checkpoint, resumed;  // null: none
};

// Collective. Returns the report on rank 0, an empty one elsewhere.
RunReport parts_report(const PartsRun& run);
// Returns the claims of the files, JSON.
std::string parts_claims(const PartsRun& run);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
