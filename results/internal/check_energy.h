// The energy of a map that is checked, and how it may be called: at the scale that the file claims,
// or at the best one; without the faces where it is infinite.
#pragma once

#include <limits>
#include <string>

#include "majorant/framework/stop_check.h"
#include "majorant/io/claims.h"
#include "majorant/parametrization/maps/map_file.h"
#include "majorant/parametrization/maps/measure.h"
#include "majorant/results/internal/findings.h"
#include "majorant/results/internal/report.h"

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
// What a report says otherwise of the energy than measures_section(), into that section.
void add_energy(const CheckedEnergy& energy, Json& measures_section);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
