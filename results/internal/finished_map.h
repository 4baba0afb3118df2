// A run that has made a map, as its files and its report say it: what all that solve for one map
// (parametrize, seamless, deform) leave behind.
//
//   const ParametrizationResult result = parametrize(mesh, options);
//   FinishedMap run{"parametrize", polygons, *mesh, options.map, result, record};
//   run.boundary = prove_boundary(result, record);
//   const MapFile file = map_file(run);
//   write_map(path, file, &polygons, {}, proof_of_file(path, promise(run, path), file, {}));
//   const Json report = map_report(run);
#pragma once

#include <optional>
#include <string>

#include "majorant/certify/global_injectivity.h"
#include "majorant/certify/map_proof.h"
#include "majorant/certify/moved_layout.h"
#include "majorant/parametrization/cuts/choose_cuts.h"
#include "majorant/parametrization/drive/parametrize.h"
#include "majorant/parametrization/starts/start.h"
#include "majorant/pictures/film.h"
#include "majorant/results/internal/report.h"

namespace majorant {

// Only refers: all must outlive it.
struct FinishedMap {
  std::string command;  // the verb
  const PolygonMesh& polygons;
  const SurfaceMesh& mesh;  // of these, not cut
  const MapOptions& asked;  // vertices are those of the map
  const ParametrizationResult& result;
  const RunRecord& record;
  std::string energy = {};        // as said; empty: one without a name
  std::string init = "auto";      // likewise
  Json options = Json::object();  // likewise, all of it
  double read_seconds = 0;
  const SurfaceCuts* cuts = nullptr;               // of surfaces cut open
  const Start* start = nullptr;                    // that was made of a seamless map
  const LayoutMotion* placement = nullptr;         // how result.map was moved
  bool is_aligned = false, is_normalized = false;  // of that, what was asked for
  const Film* film = nullptr;                      // of the run, if asked for
  GlobalInjectivity boundary = {};                 // prove_boundary()
  Json linear_solver = {}, memory = {};            // sections of the report, or null
};

// Whether there is a map to write: the run did not fail, and was feasible.
bool has_result(const ParametrizationResult& result);
// Units of the surface per unit of uv in the file.
double scale_of(const FinishedMap& run);

// Whether the map is injective as a whole, as it is now: after all that moves it, which has to
// reset result.boundary. Takes milliseconds, a second or so where curves run along each other;
// limits do not end it.
GlobalInjectivity prove_boundary(const ParametrizationResult& result, const RunRecord& record);
// Of a run that has a result: with what was measured, and with its claims.
MapFile map_file(const FinishedMap& run);
// What a data file of that name must be when it is read back.
ProofRequest promise(const FinishedMap& run, const std::string& path);
// Whole but for what writing adds to it: "outputs" and their seconds.
Json map_report(const FinishedMap& run);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
