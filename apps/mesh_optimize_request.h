// The options of `majorant mesh optimize`, and the file that --target names.
#pragma once

#include <CLI/App.hpp>
#include <limits>
#include <string>

#include "apps/command.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/io/volume_files.h"
#include "majorant/volumes/optimize_volume_mesh.h"

namespace majorant::app {

struct MeshOptimizeRequest {
  CommonOptions common;
  std::string input, output;
  std::string energy = "symmetric-dirichlet", target = "ideal", boundary = "fixed";
  int listed = 10;  // largest number of elements in messages and the report
  double tolerance = VolumeOptions().tolerance;
  int max_iterations = StoppingRules().max_iterations;
  double time_limit = std::numeric_limits<double>::infinity();
  std::string msh_version;  // empty: that of the input
  bool binary = false;

  void add_to(CLI::App& verb);
  // Throws Error(Usage) before any work.
  void require_usable() const;
  // Returns the file that --target names; empty if it is one of the words.
  std::string size_file() const;
  // Reads that file. Throws Error(Unreadable) if it does not fit the mesh.
  VolumeOptions options(const VolumeMesh& mesh, const StopCheck& stop) const;
  GmshChoice gmsh() const;
  Json to_json() const;  // for reports
};

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
