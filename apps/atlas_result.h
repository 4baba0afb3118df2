// What unwrap leaves behind: files with their claims, the report, the lines that sum up.
#pragma once

#include <chrono>

#include "apps/command.h"
#include "apps/map_request.h"
#include "apps/progress.h"
#include "apps/result_files.h"
#include "majorant/results/internal/atlas_job.h"

namespace majorant::app {

// A run of unwrap that has ended. Only refers: all must outlive it.
struct FinishedUnwrap {
  const CommonOptions& common;
  const OutputRequest& outputs;
  const MapRequest& map;
  const AtlasJob& job;
  std::chrono::steady_clock::time_point start;  // of the run
  Progress& progress;
};

// Writes the layout, unless a chart failed, each file certified, then the reports, then the lines
// on stderr; returns the exit code.
int write_atlas(const FinishedUnwrap& run);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
