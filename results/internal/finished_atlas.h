// What unwrap leaves behind, as its files and its report say it.
//
//   const RepairedSurface surface = repair(polygons);
//   const Atlas atlas = unwrap(surface.mesh, {}, record);
//   FinishedAtlas run{polygons, surface, atlas, record};
//   run.boundary = prove_boundary(atlas);
//   const MapFile file = atlas_file(run);
//   write_map(path, file, &polygons, {}, proof_of_file(path, promise(run, path), file, {}));
#pragma once

#include <string>

#include "majorant/certify/map_proof.h"
#include "majorant/mesh/repair.h"
#include "majorant/parametrization/atlas/unwrap.h"
#include "majorant/results/internal/report.h"

namespace majorant {

// Only refers: all must outlive it.
struct FinishedAtlas {
  const PolygonMesh& polygons;  // as with_welded_vertices() has them
  const RepairedSurface& surface;
  const Atlas& atlas;
  const RunRecord& record;
  const LayoutMotion* square = nullptr;  // what the maps were moved into
  int degree = 1;
  std::string energy = {};        // as said; empty: one without a name
  Json options = Json::object();  // likewise, all of it
  double read_seconds = 0;
  Json linear_solver = {}, memory = {};  // sections of the report, or null
  GlobalInjectivity boundary = {};       // prove_boundary()
};

// Whether charts overlap, as they lie now; each for itself does not, and packed ones do not.
GlobalInjectivity prove_boundary(const Atlas& atlas);
// Units of the surface per unit of uv in the file.
double scale_of(const FinishedAtlas& run);
// Of all cuts, those of repair() included.
double seam_length(const FinishedAtlas& run);

// All charts side by side: with what was measured, and with its claims. table (may be null)
// receives the distortion of every face, also where it is no part of the file: where it is not
// finite, and where who reads the file could not measure the same.
MapFile atlas_file(const FinishedAtlas& run, FaceDistortion* table = nullptr);
// What a data file must be when it is read back.
ProofRequest promise(const FinishedAtlas& run, const std::string& path);
// Whole but for what writing adds to it: "outputs", their seconds and the total.
Json atlas_report(const FinishedAtlas& run);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
