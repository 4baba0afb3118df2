// The options --checkpoint, --every and --resume, and the checks whether a file fits them.
//
//     CheckpointRequest request;
//     request.add_to(verb);
//     const CheckpointFile file = request.read_fitting(map, job);   // rank 0
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "apps/map_request.h"
#include "apps/mpi/checkpoint.h"
#include "majorant/apps/jobs/map_job.h"

namespace majorant::app {

struct CheckpointRequest {
  std::string file, resume;  // or empty
  int every = 10;            // iterations

  void add_to(CLI::App& verb);
  Json to_json() const;
  // Reads the file of --resume. Throws Error(Unreadable) where read_checkpoint_file() does, if it
  // belongs to another surface or other options, and if no run can have written it.
  CheckpointFile read_fitting(const MapRequest& map, const MapJob& job) const;
  // Returns the report section about the checkpoints written.
  Json section(const CheckpointWriter& writer) const;
  // Returns the report section about the checkpoint that the run continues.
  Json resumed_section(const CheckpointFile& resumed) const;
};

// Returns the data that decide at which map a run ends: the surface and the problem, files by their
// contents. Parameters of the search may change between runs: tolerance, limits, solvers, ranks.
Json identity(const MapRequest& request, const MapJob& job);

// Convert points with targets to and from the form of checkpoint headers.
Json points_json(const std::vector<Pin>& points);
std::vector<Pin> points_from(const Json& json);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
