// The options --seams and --max-stretch, which say where to cut a surface.
//
//   SeamRequest seams;
//   seams.add_to(verb);
//   const SurfaceCuts cuts = choose_cuts(*mesh, seams.options(polygons, record.start_stop()));
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "majorant/apps/jobs/report.h"
#include "majorant/io/read_mesh.h"
#include "majorant/parametrization/seams/choose_cuts.h"

namespace majorant::app {

struct SeamRequest {
  std::string seams;  // empty: not given
  std::optional<double> max_stretch;

  void add_to(CLI::App& verb);
  // Returns the file that --seams names; empty if it is one of the words.
  std::string file() const;
  // Returns whether charts may be cut to reduce their stretch. False if the user names the cuts.
  bool divides() const;
  // Returns the parts of a mesh file that must be intact.
  Strictness needed_of_file() const;
  // Throws Error(Usage) for malformed words, and the errors of read_seams().
  CutOptions options(const PolygonMesh& polygons, const StopCheck& stop) const;
  Json to_json() const;  // for reports and claims
};

// Returns a line about faces without texture coordinates, or none.
std::vector<std::string> untextured_in_words(const std::string& file, const SurfaceCuts& cuts);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
