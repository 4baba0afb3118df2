// `check`: a result judged again, from what a file holds alone. Claims of the file describe; what
// is proven is decided from points and uv (certify/map_proof.h).
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
  double scale = 1;  // of the surface per unit of uv
  // The file says nothing of its scale: it is the one at which the energy is least.
  bool is_best_scale = false;
  Index without_area = 0;  // faces, where the energy of every map is infinite
  // Mean over the faces that have an area; NaN if none has.
  double value = std::numeric_limits<double>::quiet_NaN();
};

std::string claimed_energy(const Claims& claims);
// The energy `claims` name, else symmetric Dirichlet; one that does not exist is a finding. Faces
// of the map are the cells of the file in their order; faces without area are measured against the
// rest triangles of repair(), for which `measures` is good where nothing else is said.
CheckedEnergy measure_as_claimed(const MapFile& file, const BezierMap& map, const Claims& claims,
                                 const StopCheck& stop, Findings& findings, MapMeasures& measures);

// "symmetric-dirichlet 4.003 at the best scale, uv times 57.6", "... infinite, since 1 face has no
// area (4.003 over the others)".
std::string describe(const CheckedEnergy& energy);
// Adds to measures_section() what a report says of the energy beyond it.
void add_energy(const CheckedEnergy& energy, Json& measures_section);

struct CheckRequest {
  std::string name;  // of the file: for messages; its extension says what its labels mean
  const PolygonMesh* surface = nullptr;  // that it should be a map of
  // The rule for inner edges whose sides differ. Auto: those that the file claims to be cut; if it
  // claims nothing, any, which are told from tears by nobody then. Seams of a seamless map are no
  // cuts for any of these.
  enum class Cuts { Auto, None, Free } cuts = Cuts::Auto;
  bool certify = false;   // overlaps are violations, also where the file claims nothing
  bool seamless = false;  // likewise, seams are none
  bool stacked = false;   // likewise, charts may lie exactly on others
  // As ProofRequest has them: where the objects of the file have layouts of their own.
  std::vector<Index> layers = {};
  bool reported = false;  // all that reports say is found out, also what decides nothing
};

struct MapCheck {
  // record: says when to stop; what is left is undecided then. Throws Error as parse_claims() and
  // MapProof.
  MapCheck(const MapFile& file, const CheckRequest& request, const RunRecord& record);

  Claims claims;
  Findings findings;  // empty: valid
  RunReport report;   // but for its options
  std::optional<MapMeasures> measures;
  CheckedEnergy energy;  // where there are measures
  MapProof proof;

  // Where the image overlaps itself, of maps without seams, unless stopped before.
  std::optional<OverlapExtent> overlap;

  std::string_view status() const;  // "valid", "invalid", "undecided"
  // ", 12 of 480 faces lie on others, 3.1 % of the layout"; empty where none is known to.
  std::string overlap_in_words() const;
  // There are cuts, and neither file nor request says which edges may be cut.
  bool has_untold_cuts = false;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
