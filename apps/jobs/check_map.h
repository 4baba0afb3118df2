// `check`: judges a result again, from the contents of its file alone. The file's claims only
// describe; proofs use points and uv alone (certify/map_proof.h).
//
//   const MapFile file = read_map("bunny.vtu");
//   const MapCheck check(file, {.name = "bunny.vtu"}, RunRecord());
//   if (check.status() == "valid") ...
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/apps/jobs/findings.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/certify/map_proof.h"
#include "majorant/certify/overlap_extent.h"
#include "majorant/framework/run_record.h"
#include "majorant/framework/stop_check.h"
#include "majorant/io/claims.h"
#include "majorant/maps/map_file.h"
#include "majorant/maps/measure.h"

namespace majorant {

struct CheckedEnergy {
  std::string name;
  double scale = 1;  // units of the surface per unit of uv
  // True if the scale is the one with the least energy, because the file does not give one.
  bool is_best_scale = false;
  Index without_area = 0;  // faces without area, for which every energy is infinite
  // The mean over faces with an area; NaN if there are none.
  double value = std::numeric_limits<double>::quiet_NaN();
};

std::string claimed_energy(const Claims& claims);
// Returns the energy that `claims` name, else symmetric Dirichlet; an unknown name is a finding.
// Faces of the map are the cells of the file in their order. Faces without area are measured
// against the rest triangles of repair(); `measures` holds their values unless the file gives
// others.
CheckedEnergy measure_as_claimed(const MapFile& file, const BezierMap& map, const Claims& claims,
                                 const StopCheck& stop, Findings& findings, MapMeasures& measures);

// Returns "symmetric-dirichlet 4.003 at the best scale, uv times 57.6", or "... infinite, since 1
// face has no area (4.003 over the others)".
std::string describe(const CheckedEnergy& energy);
// Adds the report's further data on the energy to measures_section().
void add_energy(const CheckedEnergy& energy, Json& measures_section);

struct CheckRequest {
  std::string name;  // of the file, for messages; its extension defines what the labels mean
  const PolygonMesh* surface = nullptr;  // the surface that the file should map
  // The rule for inner edges whose sides differ. Auto: the edges that the file claims to be cut are
  // allowed; if it claims nothing, all are, and cuts are not distinguished from tears. Seams of a
  // seamless map are never cuts.
  enum class Cuts { Auto, None, Free } cuts = Cuts::Auto;
  bool certify = false;   // overlaps are violations, even if the file does not exclude them
  bool seamless = false;  // the map is seamless, even if the file does not claim it
  bool stacked = false;   // charts may lie exactly on others, even if the file does not claim it
  // See ProofRequest: the layers of objects with separate layouts.
  std::vector<Index> layers = {};
  bool reported = false;  // also find what reports show but the verdict does not need
};

struct MapCheck {
  // record: says when to stop; open questions are then undecided. Throws the errors of
  // parse_claims() and MapProof.
  MapCheck(const MapFile& file, const CheckRequest& request, const RunRecord& record);

  Claims claims;
  Findings findings;  // empty: valid
  RunReport report;   // without its options
  std::optional<MapMeasures> measures;
  CheckedEnergy energy;  // set if there are measures
  MapProof proof;

  // The places where the image overlaps itself, for maps without seams, unless the check was
  // stopped before.
  std::optional<OverlapExtent> overlap;

  std::string_view status() const;  // returns "valid", "invalid" or "undecided"
  // Returns ", 12 of 480 faces lie on others, 3.1 % of the layout"; empty if no overlap is known.
  std::string overlap_in_words() const;
  // True if there are cuts although neither file nor request says which edges may be cut.
  bool has_untold_cuts = false;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
