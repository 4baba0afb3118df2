// --checkpoint, --every and --resume of majorant-mpi: what was said, and whether a file fits it.
#pragma once

#include <CLI/App.hpp>
#include <string>

#include "apps/command.h"
#include "apps/map_request.h"
#include "distributed/checkpoint.h"

namespace majorant::app {

struct CheckpointRequest {
  std::string file, resume;  // or empty
  int every = 10;            // iterations

  void add_to(CLI::App& verb);
  Json to_json() const;
};

// What decides which map a run ends at: the surface and what is asked of it, files by their
// contents. How it is looked for may change from a run to the next: tolerance, limits, solvers,
// ranks.
Json identity(const MapRequest& request, const MapJob& job);

// Points with targets, as headers of checkpoints have them.
Json points_json(const std::vector<Pin>& points);
std::vector<Pin> points_from(const Json& json);

// The file that --resume names. Throws Error(Unreadable) as read_checkpoint_file(), where it is of
// another surface, where something else was asked for, and where it says what no run has written.
CheckpointFile read_fitting(const std::string& path, const MapRequest& request, const MapJob& job);

// Of reports: what was kept, and what the run went on from.
Json checkpoint_section(const CheckpointRequest& request, const CheckpointWriter& writer);
Json resumed_section(const CheckpointRequest& request, const CheckpointFile& file);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
