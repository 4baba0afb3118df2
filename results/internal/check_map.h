// `check`: a result judged again, from what a file holds alone. Claims of the file describe; what
// is proven is decided from points and uv (certify/map_proof.h).
//
//   const MapFile file = read_map("bunny.vtu");
//   const MapCheck check(file, {.name = "bunny.vtu"}, RunRecord());
//   if (check.status() == "valid") ...
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "majorant/certify/map_proof.h"
#include "majorant/framework/run_record.h"
#include "majorant/io/claims.h"
#include "majorant/results/internal/check_energy.h"
#include "majorant/results/internal/findings.h"
#include "majorant/results/internal/report.h"

namespace majorant {

struct CheckRequest {
  std::string name;  // of the file: for messages; its extension says what its labels mean
  const PolygonMesh* surface = nullptr;  // that it should be a map of
  // Whether inner edges may have sides that differ. Auto: those that the file claims to be cut; if
  // it claims nothing, any, which are told from tears by nobody then. Seams of a seamless map are
  // no cuts for any of these.
  enum class Cuts { Auto, None, Free } cuts = Cuts::Auto;
  bool certify = false;   // overlaps are violations, also where the file claims nothing
  bool seamless = false;  // likewise, seams are none
  bool reported = false;  // all that reports say is found out, also what decides nothing
};

struct MapCheck {
  // record: says when to stop; what is left is undecided then. Throws Error as parse_claims() and
  // MapProof.
  MapCheck(const MapFile& file, const CheckRequest& request, const RunRecord& record);

  Claims claims;
  Findings findings;  // empty: valid
  Json report;        // schema_version 1
  std::optional<MapMeasures> measures;
  CheckedEnergy energy;  // where there are measures
  MapProof proof;

  std::string_view status() const;  // "valid", "invalid", "undecided"
  // There are cuts, and neither file nor request says which edges may be cut.
  bool has_untold_cuts = false;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
