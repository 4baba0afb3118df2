// Compares the claims of a result, majorant_claims, with its contents. Claims only describe: none
// of them changes what check_command proves.
#pragma once

#include "majorant/apps/jobs/findings.h"
#include "majorant/certify/map_proof.h"
#include "majorant/io/claims.h"
#include "majorant/maps/measure.h"

namespace majorant {

// A result to be checked. Holds references only.
struct CheckedMap {
  const MapFile& file;
  const BezierMap& map;         // faces in the order of the file's cells; uv of the file
  const MapMeasures& measures;  // from measure_as_claimed() (check_map.h)
  const Claims& claims;
  const PolygonMesh* surface;  // the surface that it should map; may be null
  const CutCount& cuts;        // seams, marks and cones are not compared if there are other cuts
};

// Returns uv of the file (2 numbers a node) in the units of the run, before --align and
// --normalize.
Vec in_units_of_the_run(VecIn uv, const Claims& claims);

// Checks energy, degree, pins, boundary, seams, cones and arrays.
void check_claims(const CheckedMap& checked, Findings& findings);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
