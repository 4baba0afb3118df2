// Where the user wants a surface to be cut: --seams and --max-stretch.
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
  std::string seams;  // empty: nothing was said
  std::optional<double> max_stretch;

  void add_to(CLI::App& verb);
  // The file that --seams names; empty where it is one of the words.
  std::string file() const;
  // Returns whether charts may be cut for their stretch: not where the user says where to cut.
  bool divides() const;
  // The parts of a mesh file that must not be broken.
  Strictness needed_of_file() const;
  // Throws Error(Usage) for words that make no sense and as read_seams.
  CutOptions options(const PolygonMesh& polygons, const StopCheck& stop) const;
  Json to_json() const;  // for reports and claims
};

// A line where faces had no texture coordinates to be cut along, or none.
std::vector<std::string> untextured_in_words(const std::string& file, const SurfaceCuts& cuts);

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
