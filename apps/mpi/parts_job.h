// A run of parametrize on several ranks: its options, and the run from the file to its pieces.
//
//     PartsRequest request;
//     request.add_to(verb);
//     request.require_possible();
//     return run_parts(request, processes);   // the exit code, on all ranks
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "apps/command.h"
#include "apps/map_request.h"
#include "apps/mpi/checkpoint_request.h"
#include "apps/mpi/processes.h"
#include "apps/solve_request.h"

namespace majorant::app {

struct PartsRequest {
  CommonOptions common;
  MapRequest map;
  SolveRequest solve;
  CheckpointRequest checkpoint;
  std::vector<std::string> outputs;
  std::string linear_solver = "auto";

  void add_to(CLI::App& verb);
  // Throws Error(Usage) for an option that needs one process; the message names it.
  void require_possible() const;
};

// Collective. Rank 0 reads files and speaks. A rank that fails outside of a collective step says so
// and ends all ranks with its exit code.
int run_parts(const PartsRequest& request, const Processes& processes);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
